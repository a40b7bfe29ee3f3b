// parity plot env-brdf: the numbers behind the picture, as CSV and in words.
#pragma once

#include <string>
#include <vector>

#include "study/plot/env_brdf.h"
#include "study/plot/material_deviation.h"

namespace parity::plot {

// A line each for roughness and NoV at multiples of 1/64, roughness first: A, B, then of F0 = .04 and 1 light scattered
// once and more than once; of each the reference's, the test's and the difference, test minus reference. The columns
// are called by EnvBrdfWords::label: table_A, mobile_A, difference_A.
std::string envBrdfCsv(const PlottedPair& pair);

// A line each, in their order, with MaterialDeviation's members; names are quoted.
std::string materialsCsv(const PlottedPair& pair, const std::vector<MaterialDeviation>& materials);

// For the terminal: errors over the core at F0 = .04 and 1, then a table of the materials.
std::string describe(const PlottedPair& pair, const std::vector<MaterialDeviation>& materials);

} // namespace parity::plot
