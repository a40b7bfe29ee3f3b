#include "report/budget_limits.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace parity::report {
namespace {

constexpr double kTiny = 1e-6; // 0.123 is no more than 123 steps of 0.001

double stepOf(const compare::Statistic& statistic) { return std::pow(10, -statistic.digits); }

// `value` worsened by a share of its error.
double worsen(const compare::Statistic& statistic, double value, double share) {
  if (statistic.better != compare::Better::higher) return value * (1 + share);
  if (statistic.unit == "dB") return value - 20 * std::log10(1 + share);
  return std::isfinite(statistic.most) ? statistic.most - (statistic.most - value) * (1 + share) : value / (1 + share);
}

// Away from the best, to the digits that people read; at least `steps` of the last of them away from `value`.
double roundWorse(const compare::Statistic& statistic, double value, double limit, int steps) {
  const double step = stepOf(statistic);
  const bool up = statistic.better != compare::Better::higher;
  const double rounded = up ? std::max(std::ceil(limit / step - kTiny), std::ceil(value / step - kTiny) + steps)
                            : std::min(std::floor(limit / step + kTiny), std::floor(value / step + kTiny) - steps);
  return std::clamp(rounded * step, statistic.least, statistic.most);
}

std::string joinLimits(const std::string& warn, const std::string& fail) {
  std::string text = warn.empty() ? "" : "warn = " + warn;
  if (!fail.empty()) text += (text.empty() ? "fail = " : ", fail = ") + fail;
  return text;
}

} // namespace

double errorOf(const compare::Statistic& statistic, double value) {
  return statistic.better == compare::Better::higher ? -value : std::abs(value);
}

double valueOf(const compare::Statistic& statistic, double error) {
  return statistic.better == compare::Better::higher ? -error : error;
}

double percentile95(std::vector<double> values) {
  std::ranges::sort(values);
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size())));
  return values[rank - 1];
}

std::string suggestLimits(const compare::Statistic& figure, const std::vector<double>& errors, double margin) {
  const double worst = valueOf(figure, std::ranges::max(errors));
  double usual = valueOf(figure, percentile95(errors));
  if (!std::isfinite(usual)) usual = worst; // most runs were identical
  const auto format = [&](double value, int steps) {
    std::string text =
        fmt::format("{:.{}f}", roundWorse(figure, value, worsen(figure, usual, steps * margin), steps), figure.digits);
    return compare::canBeBeyond(figure, std::stod(text)) ? text : std::string();
  };
  return joinLimits(format(usual, 1), format(worst, 2));
}

std::string suggestRegression(const compare::Statistic& figure, const std::vector<double>& errors, double margin) {
  std::vector<double> finite;
  std::ranges::copy_if(errors, std::back_inserter(finite), [](double error) { return std::isfinite(error); });
  const auto [least, most] = std::ranges::minmax(finite);
  const double usual = valueOf(figure, percentile95(finite)), spread = most - least, step = stepOf(figure);
  const auto format = [&](int steps) {
    const double distance = std::abs(worsen(figure, usual, steps * margin) - usual) + spread;
    const double limit = std::max<double>(std::ceil(distance / step - kTiny), steps) * step;
    return limit < figure.most - figure.least ? fmt::format("{:.{}f}", limit, figure.digits) : std::string();
  };
  return joinLimits(format(1), format(2));
}

} // namespace parity::report
