// The greatest value of a function that is costly, has many peaks and no slope: points spread evenly, the best refined.
#pragma once

#include <functional>
#include <vector>

namespace parity::explain {

struct SearchOptions {
  int points = 256; // spread over the box
  int refined = 6;  // of them, the best
  int steps = 50;   // of each, at most
};

struct Peak {
  std::vector<double> at; // in [0, 1)^d; periodic dimensions wrapped
  double value = 0;
};

// Over [0, 1]^d. The points are an additive recurrence by the powers of the root of x^(d+1) = x + 1 (Roberts 2018, "The
// Unreasonable Effectiveness of Quasirandom Sequences"); the refinement is NLopt's subplex method (Rowan 1990).
// periodic: of each dimension whether 0 and 1 are the same place. Deterministic. Returns the refined peaks, the
// greatest first.
std::vector<Peak> findPeaks(const std::function<double(const std::vector<double>&)>& value,
                            const std::vector<bool>& periodic, const SearchOptions& options);

} // namespace parity::explain
