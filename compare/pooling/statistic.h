// The names of figures: "metric.statistic", what each means, which way is better, and in what range it lies.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace parity::compare {

// Which way a figure is better, so which side of a limit is beyond it.
enum class Better { lower, higher, nearZero }; // nearZero: a signed figure; a limit bounds its absolute value

struct Statistic {
  std::string name;   // "flip.mean", "flip.fraction_over(0.1)", "psnr": canonical spelling
  std::string metric; // "flip"
  std::string label;  // in a sentence: "mean FLIP", "share of pixels with FLIP over 0.1", "PSNR"
  std::string unit;   // "", "dB", "EV", "%"
  Better better = Better::lower;
  double least = 0, most = 1; // the range a limit may have; +infinity where there is no bound
  int digits = 3;             // after the point, where people read it
};

// Parses a figure's name against the registry (compare/metrics/metric.h). "flip.fraction_over(0.10)" is canonicalised
// to "flip.fraction_over(0.1)". Null for a name that is not known.
// Those of the registry are not copied: they stay as long as the program.
std::shared_ptr<const Statistic> statisticByName(std::string_view name);

// Whether any value of the figure's range could be beyond the limit. One that none could be can never trip: a check
// that always passes.
bool canBeBeyond(const Statistic& statistic, double limit);

// The share of pixels above a threshold, "flip.fraction_over(0.1)": read best as a percentage.
bool isShare(std::string_view name);

// All names without parameters, in the registry's order, and "M.fraction_over(X)" for metrics that have it: for
// messages and the nearest known name.
std::vector<std::string> knownStatistics();

// As statisticByName, but throws Error (usage) naming `subject` and the nearest known name, or all where none is near.
Statistic requireStatistic(std::string_view name, const std::string& subject);

} // namespace parity::compare
