// Which term makes a material look different: each swapped for the reference path's, displayed and compared again.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/metrics/measure_swaps.h"

namespace parity::compare {

// What a material's FLIP becomes once one of the test's terms is the reference's: its colour less the one, plus the
// other, displayed and compared again (compare/metrics/attribution.h).
struct TermEffect {
  std::string term;
  double flip = 0; // mean
};

// Which term makes a material differ.
struct Attribution {
  double flip = 0;               // mean, as it is
  std::vector<TermEffect> terms; // those that are not the same in both paths there, in the order of shading::Term
};

// A material's swapped picture in which one of the test's terms is the reference's.
struct TermSwap {
  std::string term;
  Swap swap;
};

struct AttributionInput {
  Swap swap;                   // with all of the test's terms: what the material is judged by
  std::vector<TermSwap> terms; // those that are not the same in both paths, in the order of shading::Term
};

// For each material what its mean FLIP is, and what it becomes by each of its terms: figures of measureSwaps. Throws
// Error as measureSwaps does.
std::vector<Attribution> attributeTerms(const SwapReference& reference, std::span<const AttributionInput> materials);

} // namespace parity::compare
