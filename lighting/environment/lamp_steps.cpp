#include "lighting/environment/lamp_steps.h"

#include <algorithm>
#include <cmath>

namespace parity::lighting {

namespace {

glm::dvec3 directionOf(const FourLampSums& four, int lane) {
  return {four.direction[0][lane], four.direction[1][lane], four.direction[2][lane]};
}

// A ball around directions.
struct Ball {
  glm::dvec3 center{0.0};
  double radius = 0;
};

Ball ballAround(std::span<const FourLampSums> fours) {
  Ball ball;
  for (const FourLampSums& four : fours)
    for (int lane = 0; lane < 4; ++lane) ball.center += directionOf(four, lane);
  ball.center /= 4.0 * static_cast<double>(fours.size());
  for (const FourLampSums& four : fours)
    for (int lane = 0; lane < 4; ++lane)
      ball.radius = std::max(ball.radius, glm::distance(directionOf(four, lane), ball.center));
  return ball;
}

struct Range {
  double least, most;
};

// What addLamps compares with a node's spread, at any distance (chord) of a range.
Range scaleOf(const Range& distance, double a2) {
  const Range u{distance.least * distance.least / 4, distance.most * distance.most / 4},
      t{u.least + a2 * (1 - u.least), u.most + a2 * (1 - u.most)};
  const double first = std::abs(1 - 2 * u.least), last = std::abs(1 - 2 * u.most);
  const bool isAcross = 2 * u.least < 1 && 2 * u.most > 1;
  const double least = isAcross ? 0 : std::min(first, last), most = std::max(first, last);
  return {4 * std::min(t.least, least * least + 0.02), 4 * std::min(t.most, most * most + 0.02)};
}

} // namespace

std::vector<LampStep> findLampSteps(const LampTree& tree, float a2, std::span<const FourLampSums> fours) {
  constexpr double kRounding = 1e-4; // relative; that of addLamps is below 1e-5
  const Ball ball = ballAround(fours);
  std::vector<LampStep> steps;
  for (std::uint32_t i = 0; i < tree.nodes.size();) {
    const LampNode& node = tree.nodes[i];
    bool isTaken = node.next == i + 1;
    if (!isTaken) {
      const double distance = glm::distance(glm::dvec3(node.direction), ball.center),
                   limit = static_cast<double>(kLampOpening) * static_cast<double>(node.spread);
      const Range scale =
          scaleOf({std::max(0.0, distance - ball.radius), distance + ball.radius}, static_cast<double>(a2));
      if (scale.most < limit * (1 - kRounding)) {
        ++i;
        continue;
      }
      isTaken = scale.least > limit * (1 + kRounding);
    }
    steps.push_back({.node = i, .isTaken = isTaken});
    i = node.next;
  }
  return steps;
}

} // namespace parity::lighting
