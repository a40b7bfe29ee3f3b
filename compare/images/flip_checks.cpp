#include "compare/images/flip_checks.h"

#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "compare/metrics/metric.h"

namespace parity::compare {

namespace {

base::Error misuse(const std::string& option, const std::string& place, const std::string& reason) {
  return base::Error(base::ExitCode::usage, option, place, reason);
}

std::string joinFigures(const Metric& metric) {
  std::vector<std::string> names;
  for (const Statistic& statistic : metric.statistics) names.push_back(statistic.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// The metrics that have limits for single pixels.
std::string joinPixelwise() {
  std::vector<std::string> names;
  for (const Metric& metric : metricRegistry())
    if (metric.hasFractionOver) names.push_back(metric.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void requireInRange(const std::string& option, const Statistic& statistic, double limit) {
  if (!(limit >= statistic.least && limit <= statistic.most))
    throw misuse(
        option, fmt::format("{}", limit),
        fmt::format("is not a limit for {}, which is from {} to {}", statistic.name, statistic.least, statistic.most));
  if (!canBeBeyond(statistic, limit))
    throw misuse(option, fmt::format("{}", limit),
                 fmt::format("would always pass: {} is from {} to {}, so it is never {} this limit", statistic.name,
                             statistic.least, statistic.most, statistic.better == Better::higher ? "below" : "above"));
}

// A warning beyond the failure would never be seen.
void requireWarnFirst(const std::string& warnOption, const Statistic& statistic, const std::optional<double>& warn,
                      const std::optional<double>& fail) {
  const bool higher = statistic.better == Better::higher;
  if (warn && fail && (higher ? *warn < *fail : *warn > *fail))
    throw misuse(warnOption, fmt::format("{}", *warn),
                 fmt::format("would never warn: it is beyond the limit that fails, {}", *fail));
}

// warn and fail limits on one figure, where there are any.
void addLimits(std::vector<BudgetCheck>& checks, const Statistic& statistic, const std::optional<double>& warn,
               const std::optional<double>& fail, const char* prefix) {
  if (!warn && !fail) return;
  if (warn) requireInRange(fmt::format("--{}warn", prefix), statistic, *warn);
  if (fail) requireInRange(fmt::format("--{}fail", prefix), statistic, *fail);
  requireWarnFirst(fmt::format("--{}warn", prefix), statistic, warn, fail);
  BudgetCheck check;
  check.statistic = statistic;
  check.warn = warn;
  check.fail = fail;
  checks.push_back(check);
}

// At most `percent` of the pixels may be beyond `limit`.
void addPixelwise(std::vector<BudgetCheck>& checks, const Metric& metric, const std::string& level,
                  const std::optional<double>& limit, const std::optional<double>& percent) {
  if (!limit) return;
  const std::string name = fmt::format("{}.fraction_over({})", metric.name, *limit);
  const auto statistic = statisticByName(name);
  if (!statistic || !std::isfinite(*limit)) {
    const Statistic& ranged = metric.statistics.front();
    throw misuse("--" + level, fmt::format("{}", *limit),
                 fmt::format("is not a limit for a pixel's {}, which is from {} to {}: {}", metric.label, ranged.least,
                             ranged.most,
                             *limit >= ranged.most ? "no pixel can be above it" : "every pixel is above it"));
  }
  const double share = percent.value_or(0) / 100;
  if (!(share >= 0 && share <= 1))
    throw misuse(fmt::format("--{}percent", level), fmt::format("{}", *percent), "is not a percentage from 0 to 100");
  if (share == 1)
    throw misuse(fmt::format("--{}percent", level), fmt::format("{}", *percent),
                 "would always pass; give less than 100");
  const bool fails = level == "fail";
  addLimits(checks, *statistic, fails ? std::nullopt : std::optional(share),
            fails ? std::optional(share) : std::nullopt, "");
}

// No pixel may be beyond: a limit on the extreme that is worst.
void addHard(std::vector<BudgetCheck>& checks, const Metric& metric, const Threshold& threshold) {
  if (!threshold.hardFail && !threshold.hardWarn) return;
  for (const Statistic& statistic : metric.statistics)
    if (statistic.name == metric.name + ".max" || statistic.name == metric.name + ".min" || statistic.name == "maxabs")
      return addLimits(checks, statistic, threshold.hardWarn, threshold.hardFail, "hard");
  throw misuse(threshold.hardFail ? "--hardfail" : "--hardwarn", metric.name, "has no limits for single pixels");
}

void requireSense(const std::string& name, const Threshold& t) {
  if (t.failPercent && !t.fail)
    throw misuse("--failpercent", name, "needs --fail, the limit that the pixels may exceed");
  if (t.warnPercent && !t.warn)
    throw misuse("--warnpercent", name, "needs --warn, the limit that the pixels may exceed");
  if (!t.fail && !t.warn && !t.hardFail && !t.hardWarn)
    throw misuse("--metric", name, "no limit follows it; add --fail, --warn, --hardfail or --hardwarn");
}

// Of limits on pixels: a warning that needs more pixels, each further beyond, than a failure does.
void requireWarnFirst(const Threshold& t) {
  if (!t.warn || !t.fail) return;
  const double warnPercent = t.warnPercent.value_or(0), failPercent = t.failPercent.value_or(0);
  if (*t.warn >= *t.fail && warnPercent >= failPercent && (*t.warn > *t.fail || warnPercent > failPercent))
    throw misuse("--warn", fmt::format("{}", *t.warn),
                 fmt::format("for {} % of the pixels would never warn: it is beyond the limit that fails, {} for {} %",
                             warnPercent, *t.fail, failPercent));
}

} // namespace

std::string figureOfAlpha(const std::string& figure) {
  constexpr std::string_view kHdr = "hdrflip.";
  return figure.starts_with(kHdr) ? "flip." + figure.substr(kHdr.size()) : figure;
}

std::vector<BudgetCheck> checksOfAlpha(std::vector<BudgetCheck> checks) {
  for (BudgetCheck& check : checks) check.statistic = requireStatistic(figureOfAlpha(check.statistic.name), "limit");
  return checks;
}

std::vector<BudgetCheck> makeChecks(const std::vector<Threshold>& thresholds, bool hdr) {
  std::vector<BudgetCheck> checks;
  for (const Threshold& threshold : thresholds) {
    const std::string name = !threshold.metric.empty() ? threshold.metric : hdr ? "hdrflip" : "flip";
    const Metric* metric = findMetric(name);
    // "maxabs" is both a figure and what each pixel has: percents tell which is meant.
    const bool percents = threshold.failPercent || threshold.warnPercent;
    const bool pixelwise = metric && metric->hasFractionOver && (percents || !statisticByName(name));
    if (metric && !pixelwise && !statisticByName(name))
      throw misuse("--metric", name, fmt::format("has several figures; give one of {}", joinFigures(*metric)));
    requireSense(name, threshold);
    if (pixelwise) {
      requireWarnFirst(threshold);
      addPixelwise(checks, *metric, "fail", threshold.fail, threshold.failPercent);
      addPixelwise(checks, *metric, "warn", threshold.warn, threshold.warnPercent);
    } else {
      const Statistic statistic = requireStatistic(name, "--metric");
      if (threshold.failPercent || threshold.warnPercent)
        throw misuse(threshold.failPercent ? "--failpercent" : "--warnpercent", name,
                     "is one figure of the whole region; percentages need a metric with pixel values: " +
                         joinPixelwise());
      addLimits(checks, statistic, threshold.warn, threshold.fail, "");
      metric = &requireMetric(statistic.metric, "--metric");
    }
    addHard(checks, *metric, threshold);
  }
  return checks;
}

} // namespace parity::compare
