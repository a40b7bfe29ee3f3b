// The sentences that an art lead reads.
#include "compare/wording.h"

#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "compare/statistic.h"

namespace parity::compare {
namespace {

constexpr double kLeastEv = 0.05, kLeastLab = 1; // wording.h says why

Better betterOf(const CheckResult& check) {
  const std::optional<Statistic> statistic = statisticByName(check.metric);
  return statistic && !check.regress ? statistic->better : Better::lower;
}

std::string formatNumber(const std::string& metric, double value, bool sign) {
  const std::optional<Statistic> statistic = statisticByName(metric);
  const int digits = statistic ? statistic->digits : 3;
  if (value == 0) value = 0; // no "-0.000"
  const std::string number = sign ? fmt::format("{:+.{}f}", value, digits) : fmt::format("{:.{}f}", value, digits);
  return statistic && !statistic->unit.empty() ? number + " " + statistic->unit : number;
}

std::string describeRegression(const CheckResult& check, const std::string& what) {
  if (!check.judged()) return fmt::format("regression of {} over {} pixels: {}", what, check.region, check.unjudged);
  if (std::isnan(check.value)) return fmt::format("{} over {} pixels: {}", what, check.region, check.note);
  const std::string found = fmt::format("{} over {} pixels is {}", what, check.region, formatCheckValue(check));
  const bool beyond = check.verdict == Verdict::fail || check.verdict == Verdict::warn;
  const std::optional<double>& limit = check.verdict == Verdict::fail ? check.failAbove : check.warnAbove;
  if (!beyond || !limit) return found;
  return fmt::format("{}, {}", found, formatLimit(check, *limit));
}

std::string describeLight(const Figures& figures, double ev) {
  if (std::abs(ev) >= kLeastEv)
    return fmt::format("{:.{}f} EV {}", std::abs(ev), std::abs(ev) < 0.1 ? 2 : 1, ev < 0 ? "darker" : "brighter");
  const double lightness = figures.find("bias.dl").value_or(0);
  if (std::abs(lightness) < kLeastLab) return {};
  return fmt::format("{:.0f} L* {}", std::abs(lightness), lightness < 0 ? "darker" : "brighter");
}

std::string describeLuma(const Figures& figures, std::string_view test) {
  const double percent = 100 * (figures.testLuma / figures.referenceLuma - 1);
  if (std::abs(percent) < 0.5) return "equally bright";
  return fmt::format("{} is {:.1f} % {}", test, std::abs(percent), percent < 0 ? "darker" : "brighter");
}

} // namespace

bool isLowerBound(const CheckResult& check) { return betterOf(check) == Better::higher; }

std::string labelOf(const CheckResult& check) {
  const std::optional<Statistic> statistic = statisticByName(check.metric);
  return statistic ? statistic->label : check.metric;
}

std::string formatFigure(const std::string& metric, double value) {
  if (std::isnan(value)) return "not a number";
  const std::optional<Statistic> statistic = statisticByName(metric);
  if (std::isinf(value))
    return statistic && statistic->better == Better::higher && value > 0 ? "identical" : "infinite";
  return formatNumber(metric, value, statistic && statistic->better == Better::nearZero);
}

std::string formatChange(const std::string& metric, double change) {
  if (std::isnan(change)) return "not a number";
  if (std::isinf(change)) return change > 0 ? "now identical" : "no longer identical";
  return formatNumber(metric, change, true);
}

std::string formatCheckValue(const CheckResult& check) {
  if (!check.regress) return formatFigure(check.metric, check.value);
  if (!check.judged()) return "not judged";
  if (std::isnan(check.value)) return "not known";
  if (std::isinf(check.value)) return check.value > 0 ? "no longer identical" : "now identical";
  if (check.value == 0) return "as in the baseline";
  return fmt::format("{} {} than in the baseline", formatNumber(check.metric, std::abs(check.value), false),
                     check.value > 0 ? "worse" : "better");
}

std::string formatLimit(const CheckResult& check, double limit) {
  const std::string number = formatNumber(check.metric, limit, false);
  if (check.regress) return "above " + number;
  switch (betterOf(check)) {
  case Better::lower:
    return "above " + number;
  case Better::higher:
    return "below " + number;
  case Better::nearZero:
    return "beyond ±" + number;
  }
  return number;
}

std::string describeCheck(const CheckResult& check) {
  const std::string what = labelOf(check);
  if (check.regress) return describeRegression(check, what);
  if (std::isnan(check.value) && !check.note.empty())
    return fmt::format("{} over {} pixels: {}", what, check.region, check.note);
  const std::string found =
      fmt::format("{} {} over {} pixels", what, formatFigure(check.metric, check.value), check.region);
  const bool beyond = check.verdict == Verdict::fail || check.verdict == Verdict::warn;
  const std::optional<double>& limit = check.verdict == Verdict::fail                      ? check.failAbove
                                       : check.verdict == Verdict::warn || check.warnAbove ? check.warnAbove
                                                                                           : check.failAbove;
  if (std::isnan(check.value) || !limit) return found;
  if (beyond) return fmt::format("{} is {}", found, formatLimit(check, *limit));
  return fmt::format("{} is within {}{}", found, betterOf(check) == Better::nearZero ? "±" : "",
                     formatNumber(check.metric, *limit, false));
}

std::string describeGone(const GoneRow& row) {
  const std::string what = !row.material.empty()
                               ? fmt::format("material '{}', scene {}, view {}", row.material, row.scene, row.view)
                           : !row.view.empty() ? fmt::format("view {} of scene {}", row.view, row.scene)
                                               : "scene " + row.scene;
  return fmt::format("gone: {}: the baseline has it, this run does not", what);
}

const Figures& mainFigures(const RegionFigures& figures) {
  return figures.interior.pixels > 0 ? figures.interior : figures.all;
}

std::string describeBias(const Figures& figures, std::string_view test) {
  constexpr double kBlack = 0.5 / 255; // shown as 0
  if (figures.referenceLuma < kBlack)
    return figures.testLuma < kBlack ? "both are black" : "the reference is black there";
  const std::optional<double> ev = figures.find("bias.ev");
  if (!ev || !std::isfinite(*ev)) return describeLuma(figures, test);

  std::vector<std::string> parts;
  if (std::string light = describeLight(figures, *ev); !light.empty()) parts.push_back(std::move(light));
  const auto addTint = [&](const char* figure, const char* more, const char* less) {
    const double bias = figures.find(figure).value_or(0);
    if (std::abs(bias) >= kLeastLab) parts.emplace_back(bias > 0 ? more : less);
  };
  addTint("bias.db", "warmer", "cooler");
  addTint("bias.da", "redder", "greener");
  if (parts.empty()) return "equally bright, same tint";
  std::string text = fmt::format("{} is {}", test, parts.front());
  for (std::size_t i = 1; i < parts.size(); ++i) text += (i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

} // namespace parity::compare
