// Limits from observed figures: how far beyond what was seen a figure may be.
#pragma once

#include <string>
#include <vector>

#include "compare/pooling/statistic.h"

namespace parity::report {

// How far from the best a value is, so that more is worse; infinite ones too.
double errorOf(const compare::Statistic& statistic, double value);
double valueOf(const compare::Statistic& statistic, double error);

// The value below which 95 % of them lie: the one of rank ceil(0.95 n), which is the largest of fewer than 20.
double percentile95(std::vector<double> values);

// "warn = 0.120, fail = 0.140" from the errors of runs, of which at least one is finite. `warn` is the 95th percentile
// worsened by the margin, `fail` by twice the margin, and always beyond the worst run. The margin is a share of the
// error: of the figure where 0 is best, of its distance to the best where there is one (ssim), 20 log10(1 + margin) for
// dB. Rounded away from the best to the digits that people read. Without what nothing could be beyond; empty where
// neither is left.
std::string suggestLimits(const compare::Statistic& figure, const std::vector<double>& errors, double margin);

// The same for a regression: the margin's distance and the spread of the runs, so that each passes with any other as
// its baseline.
std::string suggestRegression(const compare::Statistic& figure, const std::vector<double>& errors, double margin);

} // namespace parity::report
