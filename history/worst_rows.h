// The worst material of each run, and the mean over all of them.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "history/database.h"

namespace parity::history {

struct WorstRow {
  std::string row;            // its path; empty: none has the figure
  double value = 0, mean = 0; // mean: over the materials that have it
};

// By run: of the whole runs of the suite and branch. metric: a figure of which less is better.
std::map<std::int64_t, WorstRow> worstRows(const Database& index, const std::string& suite, const std::string& branch,
                                           const std::string& metric);

} // namespace parity::history
