// parity plot env-brdf: the numbers behind the picture, as CSV and in words.
#pragma once

#include <string>
#include <vector>

#include "study/plot/env_brdf.h"
#include "study/plot/material_deviation.h"

namespace parity::plot {

// A line each for roughness and NoV at multiples of 1/64, roughness first: table_A, mobile_A, table_B, mobile_B, then
// of F0 = .04 and 1 light scattered once and more than once, each with mobile less table.
std::string envBrdfCsv(const TableBrdf& table, const ApproximateBrdf& approximate);

// A line each, in their order, with MaterialDeviation's members; names are quoted.
std::string materialsCsv(const std::vector<MaterialDeviation>& materials);

// For the terminal: errors over the core at F0 = .04 and 1, then a table of the materials.
std::string describe(const TableBrdf& table, const ApproximateBrdf& approximate,
                     const std::vector<MaterialDeviation>& materials);

} // namespace parity::plot
