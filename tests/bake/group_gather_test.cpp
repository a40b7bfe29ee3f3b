// Guided samples of a window far away against its closed form, and what the told error is worth.
#include "bake/light/group_gather.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/bake_scenes.h"

namespace parity::bake {
namespace {

using namespace tests;

// The inside of a box whose ceiling has a square window.
scenes::Mesh boxWithWindow(float half, float window) {
  scenes::Mesh mesh;
  const glm::mat4 one(1.f), down = glm::translate(one, glm::vec3(0, -half, 0));
  const auto add = [&](float degrees, const glm::vec3& axis) {
    scenes::appendMesh(mesh, square(half), glm::rotate(one, glm::radians(degrees), axis) * down);
  };
  add(0, {1, 0, 0});
  for (const float degrees : {90.f, 270.f}) {
    add(degrees, {1, 0, 0});
    add(degrees, {0, 0, 1});
  }
  const float middle = (half + window) / 2, rim = (half - window) / 2;
  const auto addStrip = [&](float x, float z, float halfX, float halfZ) {
    const glm::mat4 above = glm::rotate(glm::translate(one, glm::vec3(x, half, z)), glm::radians(180.f), {1, 0, 0});
    scenes::appendMesh(mesh, square(1), glm::scale(above, glm::vec3(halfX, 1, halfZ)));
  };
  for (const float side : {-1.f, 1.f}) {
    addStrip(0, side * middle, half, rim);
    addStrip(side * middle, 0, rim, window);
  }
  return mesh;
}

TEST(GroupGather, TellsTheErrorOfWhatComesThroughAWindow) {
  scenes::Scene scene;
  addObject(scene, boxWithWindow(1, 0.4f), matte("walls", 0));
  const std::vector<glm::dvec3> window = {{-0.4, 1, -0.4}, {0.4, 1, -0.4}, {0.4, 1, 0.4}, {-0.4, 1, 0.4}};
  int count = 0, within = 0;
  double samples = 0, bias = 0;
  for (const std::uint32_t seed : {0u, 1u, 2u, 3u}) {
    const Baked baked(scene, {{}, {}, evenSky(glm::vec3(1))}, {.bounces = 0, .seed = seed}, 6);
    for (std::size_t i = 0; i < baked.grid.texels().size(); ++i) {
      const Texel& t = baked.grid.texels()[i];
      const auto a = baked.grid.at(t.page, 4 * t.x + 1, 4 * t.y + 1),
                 b = baked.grid.at(t.page, 4 * t.x + 2, 4 * t.y + 2);
      if (baked.light.valid[i] != 0xffff || !a || !b || a->normal.y < 0.9f) continue; // the floor
      const double E = lambert(window, 0.5f * (a->position + b->position), {0, 1, 0});
      const double error = baked.light.gathered[i].irradiance.y / E - 1;
      ++count;
      bias += error;
      samples += baked.light.samples[i];
      within += std::abs(error) <= baked.light.error[i];
    }
  }
  ASSERT_GE(count, 4 * 100);
  EXPECT_GE(within, 0.93 * count);
  EXPECT_NEAR(bias / count, 0, 1e-3);
  EXPECT_LE(samples / count, 4096);
}

TEST(GroupGather, TakesNoMoreThanTheSamplesOfAllTexelsTogether) {
  scenes::Scene scene;
  addObject(scene, boxWithWindow(1, 0.1f), matte("walls", 0.5f));
  for (const double error : {1e-9, 0.03}) {
    const Baked baked(scene, {{}, {}, evenSky(glm::vec3(1))}, {.bounces = 1, .error = error, .maxSamples = 512}, 6);
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < baked.light.samples.size(); ++i) {
      if (baked.light.valid[i] == 0) continue;
      sum += baked.light.samples[i];
      ++count;
    }
    EXPECT_LE(sum, 512 * count);
    EXPECT_GE(sum, 0.1 * 512 * count);
  }
}

// Tables of Student's distribution, two-sided 95 %.
TEST(GroupGather, KnowsStudentsDistribution) {
  const std::pair<double, double> table[] = {{3, 3.182}, {4, 2.776}, {7, 2.365}, {24, 2.064}, {1e9, 1.960}};
  for (const auto& [freedom, factor] : table) EXPECT_NEAR(studentOf95Percent(freedom), factor, 0.01 * factor);
}

} // namespace
} // namespace parity::bake
