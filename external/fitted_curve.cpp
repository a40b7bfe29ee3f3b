#include "external/fitted_curve.h"

#include <algorithm>
#include <cmath>

namespace parity::external {

namespace {

constexpr double kStep8 = 1.0 / 255; // of a picture of 8 bits
constexpr std::size_t kLeastNodes = 4;

} // namespace

std::optional<FittedCurve> FittedCurve::fit(const std::array<Rgb, kRampSteps>& seen) {
  constexpr double kRounding = 1.5 * kStep8, kSame = 0.25 * kStep8;
  FittedCurve curve;
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<Node>& nodes = curve.m_channels[c];
    double most = seen[0][c];
    for (std::size_t i = 0; i < kRampSteps; ++i) {
      const double value = seen[i][c];
      if (!(value >= most - kRounding)) return std::nullopt; // NaN, too
      most = std::max(most, value);
      // Where the curve is flat the darkest grey stands for all.
      if (nodes.empty() || value > nodes.back().value + kSame)
        nodes.push_back({value, static_cast<double>(i) / (kRampSteps - 1), 0});
    }
    if (nodes.size() < kLeastNodes) return std::nullopt;
    const auto secant = [&](std::size_t i) {
      return (nodes[i + 1].step - nodes[i].step) / (nodes[i + 1].value - nodes[i].value);
    };
    nodes.front().slope = secant(0), nodes.back().slope = secant(nodes.size() - 2);
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
      const double before = nodes[i].value - nodes[i - 1].value, after = nodes[i + 1].value - nodes[i].value;
      const double share = (before + 2 * after) / (3 * (before + after));
      nodes[i].slope = 1 / (share / secant(i - 1) + (1 - share) / secant(i));
    }
  }
  return curve;
}

double FittedCurve::stepAt(const std::vector<Node>& nodes, double value) {
  if (!(value > nodes.front().value)) return nodes.front().step;
  if (value >= nodes.back().value) return nodes.back().step;
  const auto next = std::ranges::upper_bound(nodes, value, {}, &Node::value);
  const Node &a = *(next - 1), &b = *next;
  const double width = b.value - a.value, t = (value - a.value) / width;
  const double h = t * t * (3 - 2 * t);
  return (1 - h) * a.step + h * b.step + width * t * (1 - t) * ((1 - t) * a.slope - t * b.slope);
}

Rgb FittedCurve::light(const Rgb& value) const {
  Rgb light{};
  for (std::size_t c = 0; c < 3; ++c)
    light[c] = std::isnan(value[c]) ? value[c] : rampLight(stepAt(m_channels[c], value[c]));
  return light;
}

bool FittedCurve::isClipped(const Rgb& value) const {
  for (std::size_t c = 0; c < 3; ++c)
    if (value[c] >= m_channels[c].back().value) return true;
  return false;
}

} // namespace parity::external
