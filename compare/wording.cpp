// The sentences that an art lead reads.
#include "compare/wording.h"

#include <cmath>

#include <fmt/format.h>

#include "compare/budget.h"

namespace parity::compare {

bool isLowerBound(const CheckResult& check) { return metricByName(check.metric) == Metric::psnr; }

std::string formatFigure(const std::string& metric, double value) {
  if (std::isnan(value)) return "not a number";
  if (metricByName(metric) != Metric::psnr) return fmt::format("{:.3f}", value);
  return std::isinf(value) ? "identical" : fmt::format("{:.1f} dB", value);
}

std::string describeCheck(const CheckResult& check) {
  const std::optional<Metric> metric = metricByName(check.metric);
  const std::string what = fmt::format("{} {} over {} pixels", metric ? labelOf(*metric) : check.metric,
                                       formatFigure(check.metric, check.value), check.region);
  const bool beyond = check.verdict == Verdict::fail || check.verdict == Verdict::warn;
  const std::optional<double>& limit = check.verdict == Verdict::fail                      ? check.failAbove
                                       : check.verdict == Verdict::warn || check.warnAbove ? check.warnAbove
                                                                                           : check.failAbove;
  if (std::isnan(check.value) || !limit) return what;
  const char* relation = !beyond ? "is within" : isLowerBound(check) ? "is below" : "is above";
  return fmt::format("{} {} {}", what, relation, formatFigure(check.metric, *limit));
}

const Figures& mainFigures(const RegionFigures& figures) {
  return figures.interior.pixels > 0 ? figures.interior : figures.all;
}

std::string describeBrightness(const Figures& figures) {
  constexpr double kBlack = 0.5 / 255; // shown as 0
  if (figures.referenceLuma < kBlack)
    return figures.testLuma < kBlack ? "both are black" : "the reference is black there";
  const double percent = 100 * (figures.testLuma / figures.referenceLuma - 1);
  if (std::abs(percent) < 0.5) return "equally bright";
  return fmt::format("mobile is {:.1f} % {}", std::abs(percent), percent < 0 ? "darker" : "brighter");
}

} // namespace parity::compare
