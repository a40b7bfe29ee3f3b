// The tree of an environment's lamps: what it takes and what it keeps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lighting/environment/lamp_tree.h"
#include "scenes/load.h"

namespace parity::lighting {
namespace {

using std::numbers::pi;

scenes::Environment makeGrey(int width, int height, float value) {
  scenes::Environment environment;
  environment.name = "grey";
  environment.radiance = base::Image(width, height, 3);
  std::fill(environment.radiance.pixels.begin(), environment.radiance.pixels.end(), value);
  return environment;
}

// A grey sky of 1 with a lamp of `cells` squared.
Panorama makeLamp(int cells, const glm::vec3& radiance) {
  scenes::Environment environment = makeGrey(512, 256, 1.f);
  for (int y = 90; y < 90 + cells; ++y)
    for (int x = 200; x < 200 + cells; ++x)
      for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = radiance[c];
  return makePanorama(environment, 64);
}

double solidAngle(const Panorama& p, int y) { return (p.rowY[y] - p.rowY[y + 1]) * 2 * pi / p.width; }

glm::dvec3 lightOf(const Panorama& p) {
  glm::dvec3 sum(0.0);
  for (int x = 0; x < p.width; ++x)
    for (int y = 0; y < p.height; ++y) sum += solidAngle(p, y) * glm::dvec3(p.column(x)[y]);
  return sum;
}

TEST(LampTree, KeepsTheLightPerChannel) {
  Panorama p = makeLamp(7, {900, 500, 100});
  const glm::dvec3 before = lightOf(p);
  const LampTree tree = takeLamps(p).wide;
  ASSERT_EQ(tree.nodes.size(), 2u * 49 - 1);
  const glm::dvec3 after = lightOf(p) + glm::dvec3(tree.nodes[0].light);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-6) << c;
}

TEST(LampTree, HasParentsThatAreTheSumOfTheirChildren) {
  Panorama p = makeLamp(6, {300, 500, 700});
  const LampTree whole = takeLamps(p).wide;
  const LampTree few = pruneLamps(whole, 10);
  for (const LampTree* each : {&whole, &few}) {
    const LampTree& tree = *each;
    std::size_t leaves = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      const LampNode& node = tree.nodes[i];
      EXPECT_NEAR(glm::length(node.direction), 1, 1e-6);
      EXPECT_GT(node.spread, 0);
      if (tree.isLeaf(i)) {
        ++leaves;
        continue;
      }
      glm::vec3 light(0);
      std::uint32_t child = static_cast<std::uint32_t>(i) + 1;
      int children = 0;
      for (; child < node.next; child = tree.nodes[child].next, ++children) {
        light += tree.nodes[child].light;
        if (&tree != &whole && !tree.isLeaf(child)) {
          EXPECT_LT(4 * tree.nodes[child].spread, node.spread);
        }
      }
      EXPECT_EQ(child, node.next);
      EXPECT_GE(children, 2);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(node.light[c], light[c], 1e-5 * node.light[c]);
    }
    EXPECT_EQ(leaves, &tree == &whole ? 36u : 10u);
    EXPECT_EQ(tree.nodes[0].next, tree.nodes.size());
    EXPECT_EQ(tree.nodes[0].light, whole.nodes[0].light);
  }
  EXPECT_LT(few.nodes.size(), 19u);
  EXPECT_TRUE(pruneLamps(LampTree(), 10).nodes.empty());
}

// A disc of angular radius r has a mean square distance of r^2 / 2 from its middle; a square of side s s^2 / 6.
TEST(LampTree, KnowsHowFarALampSpreads) {
  scenes::Environment environment = makeGrey(1024, 512, 0.f);
  const double height = pi / 512;
  for (int y = 246; y < 266; ++y)
    for (int x = 502; x < 522; ++x)
      for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = 5;
  Panorama p = makePanorama(environment, 256);
  const LampTree tree = takeLamps(p).wide;
  EXPECT_NEAR(tree.nodes[0].spread / (std::pow(20 * height, 2) / 6), 1, 0.01);
  EXPECT_NEAR(tree.nodes[0].direction.y, 0, 1e-4);
}

TEST(LampTree, TakesNothingWhereNothingStandsOut) {
  for (const float value : {0.f, 1.f, 1e30f}) {
    Panorama p = makePanorama(makeGrey(64, 32, value), 32);
    const Lamps lamps = takeLamps(p);
    EXPECT_TRUE(lamps.wide.nodes.empty() && lamps.compact.nodes.empty()) << value;
    EXPECT_EQ(p.column(0)[3], glm::vec3(value));
  }
}

TEST(LampTree, TakesOneTexelNearTheFloatLimit) {
  scenes::Environment environment = makeGrey(1024, 512, 0.f);
  for (int c = 0; c < 3; ++c) environment.radiance.at(3, 200)[c] = 3e38f;
  Panorama p = makePanorama(environment, 256);
  const LampTree tree = takeLamps(p).compact;
  ASSERT_EQ(tree.nodes.size(), 1u);
  EXPECT_TRUE(std::isfinite(tree.nodes[0].light.x));
  EXPECT_NEAR(tree.nodes[0].light.x / (1e30 * solidAngle(p, 200)), 1, 1e-3);
}

// Their centroid is the middle of the sphere, which is no direction.
TEST(LampTree, HoldsLampsThatFaceEachOther) {
  scenes::Environment environment = makeGrey(1024, 512, 0.f);
  for (const int x : {200, 712})
    for (const int y : {255, 256})
      for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = 1;
  Panorama p = makePanorama(environment, 256);
  const Lamps lamps = takeLamps(p);
  ASSERT_EQ(lamps.compact.nodes.size(), 3u);
  for (const LampNode& node : lamps.compact.nodes) EXPECT_NEAR(glm::length(node.direction), 1, 1e-6);
}

// Three lamps of one and two cells and a softbox that is brighter than one of them.
TEST(LampTree, TellsCompactLampsFromSoftboxes) {
  scenes::Environment environment = makeGrey(1024, 512, 0.1f);
  const auto light = [&](int x0, int y0, int width, int height, float value) {
    for (int y = y0; y < y0 + height; ++y)
      for (int x = x0; x < x0 + width; ++x)
        for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = value;
  };
  light(100, 250, 1, 1, 5000);
  light(300, 200, 2, 1, 300);
  light(310, 200, 1, 2, 300); // three degrees from the one before
  light(600, 240, 60, 40, 500);
  Panorama p = makePanorama(environment, 256);
  const glm::dvec3 before = lightOf(p);
  const Lamps lamps = takeLamps(p);
  EXPECT_EQ(lamps.compact.nodes.size(), 2u * 3 - 1);
  EXPECT_EQ(lamps.wide.nodes.size(), 2u * 2400 - 1);
  const glm::dvec3 after =
      lightOf(p) + glm::dvec3(lamps.compact.nodes[0].light) + glm::dvec3(lamps.wide.nodes[0].light);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-6) << c;
}

// Stars: the brightest are apart, the others stay in the levels.
// A tube of one cell's height: each part of it has neighbours.
TEST(LampTree, TakesNoPartOfALineForACompactLamp) {
  scenes::Environment environment = makeGrey(1024, 512, 0.1f);
  for (int x = 300; x < 430; ++x)
    for (int c = 0; c < 3; ++c) environment.radiance.at(x, 200)[c] = 500;
  for (int c = 0; c < 3; ++c) environment.radiance.at(700, 200)[c] = 500; // a bulb beside it
  Panorama p = makePanorama(environment, 256);
  const Lamps lamps = takeLamps(p);
  ASSERT_EQ(lamps.compact.nodes.size(), 1u);
  EXPECT_NEAR(lamps.compact.nodes[0].light.y / lamps.wide.nodes[0].light.y, 1.0 / 130, 2e-4);
}

TEST(LampTree, BoundsTheNumberOfCompactLamps) {
  scenes::Environment environment = makeGrey(1024, 512, 0.f);
  for (int i = 0; i < 400; ++i) environment.radiance.at(50 * (i % 20) + 7, 100 + 15 * (i / 20))[1] = 1 + 0.01f * i;
  Panorama p = makePanorama(environment, 256);
  const Lamps lamps = takeLamps(p);
  EXPECT_EQ(lamps.compact.nodes.size(), 2u * 64 - 1);
  EXPECT_EQ(lamps.wide.nodes.size(), 2u * 336 - 1);
}

} // namespace
} // namespace parity::lighting
