#include "lighting/environment/lamp_steps.h"

#include <algorithm>
#include <cmath>

namespace parity::lighting {

namespace {

// A ball around directions.
struct Ball {
  glm::dvec3 center{0.0};
  double radius = 0;
};

Ball ballAround(std::span<const glm::vec3> directions) {
  Ball ball;
  for (const glm::vec3& direction : directions) ball.center += glm::dvec3(direction);
  ball.center /= static_cast<double>(directions.size());
  for (const glm::vec3& direction : directions)
    ball.radius = std::max(ball.radius, glm::distance(glm::dvec3(direction), ball.center));
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
  const auto scale = [](double ofLobe, double cosine) {
    return 4 * std::min(ofLobe, cosine * cosine + double{kLampHorizonScale});
  };
  return {scale(t.least, least), scale(t.most, most)};
}

// Whether all of a node is below the horizon, at a cosine of its direction. The middles of its cells are within 2
// sqrt(spread) of their centroid, which lies at least sqrt(1 - spread) along the direction: they are below where
// sqrt(1 - spread) |cosine| is above 2 sqrt(spread). The 4.001 is for rounding.
bool isBelow(double cosine, double spread) {
  return cosine < 0 && cosine * cosine > spread * (cosine * cosine + 4.001);
}

// Whether the horizon may cut a node, with a twentieth to spare.
bool isCut(double cosine, double spread) {
  const double width = 1.05 * double{kLampHorizon};
  return cosine < 0 || cosine * cosine < width * width * spread;
}

// A node is far where its distance or the lobe's width, 2 alpha, is this many times the radius of the directions. A
// polynomial of degree 4 then errs by less than 1e-3 of the node's light at the brightest of them; errors of many nodes
// cancel in part (tests/lighting/lamp_sums_test.cpp).
constexpr double kFar = 4;

} // namespace

LampSteps findLampSteps(const LampTree& tree, float a2, std::span<const glm::vec3> directions) {
  constexpr double kRounding = 1e-4; // relative; that of addLamps is below 1e-5
  const Ball ball = ballAround(directions);
  const double lobe = 4 * static_cast<double>(a2), far = kFar * ball.radius;
  LampSteps steps;
  for (std::uint32_t i = 0; i < tree.nodes.size();) {
    const LampNode& node = tree.nodes[i];
    const double distance = glm::distance(glm::dvec3(node.direction), ball.center), spread{node.spread};
    const Range distances{std::max(0.0, distance - ball.radius), distance + ball.radius};
    const Range cosines{1 - distances.most * distances.most / 2, 1 - distances.least * distances.least / 2};
    if (isBelow(cosines.most, spread)) {
      i = node.next;
      continue;
    }
    const Range scale = scaleOf(distances, static_cast<double>(a2));
    const double limit = double{kLampOpening} * spread;
    const bool isFar = distance * distance + lobe > far * far;
    const bool isTaken = tree.isLeaf(i) || scale.least > limit * (1 + kRounding);
    if (!isTaken && (isFar || scale.most < limit * (1 - kRounding))) {
      ++i;
      continue;
    }
    const bool isSmooth = isFar && !isCut(cosines.least, spread);
    (!isTaken ? steps.walked : isSmooth ? steps.smooth : steps.taken).push_back(i);
    i = node.next;
  }
  return steps;
}

} // namespace parity::lighting
