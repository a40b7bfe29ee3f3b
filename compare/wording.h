// Figures in words and digits, the same in every report.
#pragma once

#include <string>

#include "compare/report.h"

namespace parity::compare {

// Whether more of it is better (psnr), so that its limits are lower bounds.
bool isLowerBound(const CheckResult& check);

// A figure as people read it: psnr "31.4 dB" or "identical", all else "0.142"; "not a number" for NaN. metric: as in
// CheckResult.
std::string formatFigure(const std::string& metric, double value);

// What a check found, without its verdict: "mean FLIP 0.142 over interior pixels is above 0.100", "... is within
// 0.200".
std::string describeCheck(const CheckResult& check);

// The interior's figures, or all where there is no interior.
const Figures& mainFigures(const RegionFigures& figures);

// On screen: "mobile is 4.2 % darker", "... brighter", "equally bright" (below 0.5 %), "the reference is black there"
// or "both are black". Of displayed luma.
std::string describeBrightness(const Figures& figures);

} // namespace parity::compare
