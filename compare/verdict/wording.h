// Figures and checks in words and digits, the same everywhere.
#pragma once

#include <string>
#include <string_view>

#include "compare/pooling/figures.h"
#include "compare/verdict/check.h"

namespace parity::compare {

// What a sentence calls the figure of a check: "mean FLIP", "PSNR, against the baseline".
std::string labelOf(const CheckResult& check);

// A figure as people read it, with its unit and its statistic's digits: "0.142", "31.4 dB", "+0.31 EV" (signed ones),
// "32.5 %" (shares of pixels); "identical" for an infinite psnr, "not a number" for NaN. metric: as in CheckResult.
std::string formatFigure(const std::string& metric, double value);

// A relMSE with two significant digits, as it may be very small: "0.012", "3.1e-05", "under 1e-06";
// "not known" for NaN.
std::string formatRelMse(double value);

// A difference of two figures, always signed: "+0.012", "-1.4 dB".
std::string formatChange(const std::string& metric, double change);

// The value of a check: a figure, or for a regression "0.012 worse than in the baseline", "0.3 dB better than ...",
// "0.10 EV further from 0 than ..." (signed figures), "as in the baseline". With as many digits as tell it from the
// check's limits.
std::string formatCheckValue(const CheckResult& check);

// A limit of a check: "above 0.200", "below 28.0 dB", "beyond ±0.30 EV", "above 10.0 %". With as many digits as tell it
// from the check's value.
std::string formatLimit(const CheckResult& check, double limit);

// What a check found, without its verdict: "mean FLIP 0.142 is above 0.100", "... is within 0.200", "32.5 % of
// the pixels have FLIP over 0.2, more than 10.0 %".
std::string describeCheck(const CheckResult& check);

// How much is clipped in both pictures and what would help, from kNotableClipping on: "12.0 % of the pixels are white
// in both pictures; lower --exposure". Empty below.
std::string describeClipping(const Figures& figures);

// What artists ask first: "mobile is 0.3 EV darker and warmer", by bias.ev, bias.dl, bias.da, bias.db (test minus
// reference, means over the region). Said is what most see where the two stand side by side: 0.05 EV of light (0.8 L*
// at mid grey; 4 %), else 1 of L*; 1 of a* ("redder", "greener") and 1 of b* ("warmer" is yellower, "cooler" is bluer):
// a dE*ab of 1 is about the least that is seen, of 2.3 what is seen without looking for it (Mahy et al. 1994). "same
// brightness and tint on average" below all of these: single pixels may differ all the same. Few bright
// highlights may hold more light than all else: where light and mean lightness disagree, both are said ("mobile has 0.4
// EV more light in total, but is darker on average (dL* -4.0)"). Where the bias was not measured: by displayed luma,
// "mobile is 4.2 % darker", "equally bright" (below 0.5 %). Both: "the reference is nearly black", "both are black"
// (every pixel of both), "both are nearly black on average" (unless the light in them differs). Of a region with NaN or
// infinite pixels nothing is said. test: what "mobile" is called.
std::string describeBias(const Figures& figures, std::string_view test);

} // namespace parity::compare
