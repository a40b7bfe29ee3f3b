// The sentences that an art lead reads.
#include "compare/verdict/wording.h"

#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "compare/pooling/statistic.h"

namespace parity::compare {
namespace {

constexpr double kLeastEv = 0.05, kLeastLab = 1; // wording.h says why
constexpr double kLeastRelMse = 1e-6;            // of rounding in fp32, not of shading
constexpr int kShareDigits = 1;                  // of a percentage
constexpr int kMostDigits = 8;                   // after the point

Better betterOf(const CheckResult& check) {
  const std::shared_ptr<const Statistic> statistic = statisticByName(check.metric);
  return statistic && !check.regress ? statistic->better : Better::lower;
}

constexpr int kFewDigits = -1; // as many as the statistic has

std::string formatNumber(const std::string& metric, double value, bool sign, int digits = kFewDigits) {
  const std::shared_ptr<const Statistic> statistic = statisticByName(metric);
  const bool share = isShare(metric);
  if (share) value *= 100;
  if (digits == kFewDigits) digits = share ? kShareDigits : statistic ? statistic->digits : 3;
  std::string number = digits > kMostDigits ? fmt::format("{}", value) : fmt::format("{:.{}f}", value, digits);
  if (number.find_first_not_of("-0.") == std::string::npos && number.starts_with('-'))
    number.erase(0, 1); // no "-0.000"
  if (sign && !number.starts_with('-')) number.insert(0, 1, '+');
  if (share) return number + " %";
  return statistic && !statistic->unit.empty() ? number + " " + statistic->unit : number;
}

// As few digits as tell the check's value from its limits, so that nothing is said to be "below 20.9" at 20.9; beyond
// kMostDigits the shortest text that reads back as the very number.
int digitsOf(const CheckResult& check) {
  const std::shared_ptr<const Statistic> statistic = statisticByName(check.metric);
  int digits = isShare(check.metric) ? kShareDigits : statistic ? statistic->digits : 3;
  if (!std::isfinite(check.value)) return digits;
  const double held = betterOf(check) == Better::nearZero ? std::abs(check.value) : check.value; // what limits bound
  const auto text = [&](double value) { return formatNumber(check.metric, value, false, digits); };
  for (const std::optional<double>& limit : {check.warnAbove, check.failAbove})
    while (limit && *limit != held && digits <= kMostDigits && text(*limit) == text(held)) ++digits;
  return digits;
}

bool isSigned(const std::string& metric) {
  const std::shared_ptr<const Statistic> statistic = statisticByName(metric);
  return statistic && statistic->better == Better::nearZero;
}

// "FLIP over 0.2", of a share.
std::string overThreshold(const CheckResult& check) {
  const std::string label = labelOf(check);
  constexpr std::string_view kWith = " with ";
  const std::size_t at = label.find(kWith);
  return at == std::string::npos ? label : label.substr(at + kWith.size());
}

std::string describeRegression(const CheckResult& check, const std::string& what) {
  if (!check.judged()) return fmt::format("regression of {}: {}", what, check.unjudged);
  if (std::isnan(check.value)) return fmt::format("{}: {}", what, check.note);
  const std::string found = fmt::format("{} is {}", what, formatCheckValue(check));
  const bool beyond = check.verdict == Verdict::fail || check.verdict == Verdict::warn;
  const std::optional<double>& limit = check.verdict == Verdict::fail ? check.failAbove : check.warnAbove;
  if (!beyond || !limit) return found;
  return fmt::format("{}, {}", found, formatLimit(check, *limit));
}

// By how much the test is darker or brighter, with its verb; empty where nobody sees it. A few bright highlights may
// hold more light than all else: where light and lightness disagree, both are said.
std::string describeLight(const Figures& figures, double ev) {
  const double lightness = figures.find("bias.dl").value_or(0);
  if (std::abs(ev) >= kLeastEv) {
    const std::string size = fmt::format("{:.{}f} EV", std::abs(ev), std::abs(ev) < 0.1 ? 2 : 1);
    if (ev * lightness >= 0) return fmt::format("is {} {}", size, ev < 0 ? "darker" : "brighter");
    const char* seen = std::abs(lightness) < kLeastLab ? "equally bright" : lightness < 0 ? "darker" : "brighter";
    return fmt::format("has {} {} light in total, but is {} on average (dL* {:+.1f})", size, ev < 0 ? "less" : "more",
                       seen, lightness);
  }
  if (std::abs(lightness) < kLeastLab) return {};
  return fmt::format("is {:.0f} L* {}", std::abs(lightness), lightness < 0 ? "darker" : "brighter");
}

std::string describeLuma(const Figures& figures, std::string_view test) {
  const double percent = 100 * (figures.testLuma / figures.referenceLuma - 1);
  if (std::abs(percent) < 0.5) return "same brightness on average";
  return fmt::format("{} is {:.1f} % {}", test, std::abs(percent), percent < 0 ? "darker" : "brighter");
}

} // namespace

std::string labelOf(const CheckResult& check) {
  const std::shared_ptr<const Statistic> statistic = statisticByName(check.metric);
  return statistic ? statistic->label : check.metric;
}

std::string formatFigure(const std::string& metric, double value) {
  if (std::isnan(value)) return "not a number";
  const std::shared_ptr<const Statistic> statistic = statisticByName(metric);
  if (std::isinf(value))
    return statistic && statistic->better == Better::higher && value > 0 ? "identical" : "infinite";
  return formatNumber(metric, value, isSigned(metric));
}

std::string formatRelMse(double value) {
  if (std::isnan(value)) return "not known";
  return value > 0 && value < kLeastRelMse ? "under 1e-06" : fmt::format("{:.2g}", value);
}

std::string formatChange(const std::string& metric, double change) {
  if (std::isnan(change)) return "not a number";
  if (std::isinf(change)) return change > 0 ? "now identical" : "no longer identical";
  return formatNumber(metric, change, true);
}

std::string formatCheckValue(const CheckResult& check) {
  if (!check.regress)
    return std::isfinite(check.value) ? formatNumber(check.metric, check.value, isSigned(check.metric), digitsOf(check))
                                      : formatFigure(check.metric, check.value);
  if (!check.judged()) return "not judged";
  if (std::isnan(check.value)) return "not known";
  if (std::isinf(check.value)) return check.value > 0 ? "no longer identical" : "now identical";
  if (check.value == 0) return "as in the baseline";
  const std::string size = formatNumber(check.metric, std::abs(check.value), false, digitsOf(check));
  if (isSigned(check.metric))
    return fmt::format("{} {} 0 than in the baseline", size, check.value > 0 ? "further from" : "nearer to");
  return fmt::format("{} {} than in the baseline", size, check.value > 0 ? "worse" : "better");
}

std::string formatLimit(const CheckResult& check, double limit) {
  const std::string number = formatNumber(check.metric, limit, false, digitsOf(check));
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
  if (std::isnan(check.value) && !check.note.empty()) return fmt::format("{}: {}", what, check.note);
  if (!check.judged()) return fmt::format("{} {} is not judged: {}", what, formatCheckValue(check), check.unjudged);
  const bool beyond = check.verdict == Verdict::fail || check.verdict == Verdict::warn;
  const std::optional<double>& limit = check.verdict == Verdict::fail                      ? check.failAbove
                                       : check.verdict == Verdict::warn || check.warnAbove ? check.warnAbove
                                                                                           : check.failAbove;
  const bool share = isShare(check.metric) && !std::isnan(check.value);
  const std::string found = share
                                ? fmt::format("{} of the pixels have {}", formatCheckValue(check), overThreshold(check))
                                : fmt::format("{} {}", what, formatCheckValue(check));
  if (std::isnan(check.value) || !limit) return found;
  const std::string number = formatNumber(check.metric, *limit, false, digitsOf(check));
  if (share) return fmt::format("{}, {} {}", found, beyond ? "more than" : "within", number);
  if (beyond) return fmt::format("{} is {}", found, formatLimit(check, *limit));
  return fmt::format("{} is within {}{}", found, betterOf(check) == Better::nearZero ? "±" : "", number);
}

std::string describeClipping(const Figures& figures) {
  if (figures.pixels == 0 || figures.clipped() < kNotableClipping) return {};
  const auto share = [](double value) { return fmt::format("{:.1f} %", 100 * value); };
  if (figures.clippedBlack == 1 && figures.referenceLuminance == 0 && figures.testLuminance == 0)
    return "all pixels are black in both pictures, because neither path renders any light there";
  constexpr double kSaid = 0.0005; // less would be said to be 0.0 %
  const bool isBlack = figures.clippedBlack >= kSaid, isWhite = figures.clippedWhite >= kSaid;
  if (isBlack && isWhite)
    return fmt::format("{} of the pixels are black in both pictures and {} are white; {} --exposure shows more of them",
                       share(figures.clippedBlack), share(figures.clippedWhite),
                       figures.clippedBlack > figures.clippedWhite ? "a higher" : "a lower");
  return fmt::format("{} of the pixels are {} in both pictures; {} --exposure", share(figures.clipped()),
                     isBlack ? "black" : "white", isBlack ? "raise" : "lower");
}

std::string describeBias(const Figures& figures, std::string_view test) {
  if (figures.nonFinite > 0) return "bias is unknown: some pixels are NaN or infinite";
  constexpr double kBlack = 0.5 / 255; // shown as 0
  const std::optional<double> ev = figures.find("bias.ev");
  if (figures.referenceLuma < kBlack && figures.testLuma >= kBlack) return "the reference is nearly black";
  if (figures.referenceLuma < kBlack && (!ev || std::abs(*ev) < kLeastEv))
    return figures.clippedBlack < 1 ? "both are nearly black on average" : "both are black";
  if (!ev || !std::isfinite(*ev)) return describeLuma(figures, test);

  std::string text(test), light = describeLight(figures, *ev);
  std::vector<std::string> tints;
  const auto addTint = [&](const char* figure, const char* more, const char* less) {
    const double bias = figures.find(figure).value_or(0);
    if (std::abs(bias) >= kLeastLab) tints.emplace_back(bias > 0 ? more : less);
  };
  addTint("bias.db", "warmer", "cooler");
  addTint("bias.da", "redder", "greener");
  if (light.empty() && tints.empty()) {
    if (figures.clipped() > kMostClipping) return "equal light before clipping, but most of it is clipped";
    return "same brightness and tint on average";
  }
  text += " " + (light.empty() ? "is " + tints.front() : light);
  for (std::size_t i = light.empty() ? 1 : 0; i < tints.size(); ++i)
    text += (i + 1 == tints.size() ? " and " : ", ") + tints[i];
  return text;
}

} // namespace parity::compare
