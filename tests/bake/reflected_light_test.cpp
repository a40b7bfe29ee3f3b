// What a ray finds of known irradiance where it ends.
#include "bake/light/reflected_light.h"

#include <gtest/gtest.h>

#include <random>

#include "bake/bake_scenes.h"

namespace parity::bake {
namespace {

using namespace tests;

struct Floor {
  scenes::Scene scene;
  Atlas atlas;
  TexelGrid grid;
  Floor() : scene(make()), atlas(makeAtlas(scene, {.texelsPerMetre = 8})), grid(scene, atlas, 4) {}
  static scenes::Scene make() {
    scenes::Scene scene;
    addObject(scene, square(1), matte("floor", 0.5f));
    addObject(scene, square(1), matte("sign", 0.5f), glm::translate(glm::mat4(1.f), glm::vec3(0, 3, 0)));
    scene.materials[1].unlit = true;
    return scene;
  }
  // Where a texel's middle lies.
  glm::vec3 middleOf(const Texel& t) const {
    glm::vec3 sum(0);
    int count = 0;
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x)
        if (const auto point = grid.at(t.page, 4 * t.x + x, 4 * t.y + y)) {
          sum += point->position;
          ++count;
        }
    return sum / static_cast<float>(count);
  }
};

glm::vec3 ramp(const glm::vec3& at) { return {2 + at.x, 2 + at.z, 1}; }

glm::vec3 placeOf(const scenes::Mesh& mesh, const lighting::Visibility::Hit& hit) {
  const auto corner = [&](std::uint32_t k) { return mesh.positions[mesh.indices[3 * hit.triangle + k]]; };
  const glm::vec2 b = hit.barycentric;
  return (1 - b.x - b.y) * corner(0) + b.x * corner(1) + b.y * corner(2);
}

TEST(ReflectedLight, IsBilinearBetweenTexelsAndBlackWithoutALightmap) {
  const Floor floor;
  std::vector<glm::vec3> irradiance;
  for (const Texel& t : floor.grid.texels()) irradiance.push_back(ramp(floor.middleOf(t)));
  const ReflectedLight light(floor.atlas, floor.grid, irradiance, std::vector<bool>(irradiance.size(), true));
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0.02f, 0.48f);
  for (std::uint32_t i = 0; i < 200; ++i) {
    lighting::Visibility::Hit hit{.instance = 0, .triangle = i % 2};
    hit.barycentric.x = uniform(random);
    hit.barycentric.y = uniform(random);
    const glm::vec3 at = placeOf(floor.scene.meshes[0], hit);
    // Of a ramp it is exact, but at the rim: there what is beside the chart is the mean of its neighbours.
    const bool isInner = std::max(std::abs(at.x), std::abs(at.z)) < 1 - 1.5f / 8;
    const float slack = isInner ? 1e-4f : 1.5f / 8;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.irradiance(hit)[c], ramp(at)[c], slack) << at.x << ", " << at.z;
    hit.instance = 1;
    EXPECT_EQ(light.irradiance(hit), glm::vec3(0)) << "unlit";
  }
}

TEST(ReflectedLight, TakesWhatIsNotKnownFromItsNeighbours) {
  const Floor floor;
  const std::size_t count = floor.grid.texels().size();
  std::vector<glm::vec3> irradiance(count, glm::vec3(3));
  std::vector<bool> isValid(count, true);
  for (std::size_t i = 0; i < count; i += 3) {
    irradiance[i] = glm::vec3(1e6f);
    isValid[i] = false;
  }
  const ReflectedLight light(floor.atlas, floor.grid, irradiance, isValid);
  for (const glm::vec2 b : {glm::vec2(0.1f, 0.1f), {0.3f, 0.5f}, {0, 0}, {1, 0}, {0, 1}})
    for (const std::uint32_t triangle : {0u, 1u})
      EXPECT_EQ(light.irradiance({.instance = 0, .triangle = triangle, .barycentric = b}), glm::vec3(3));
}

} // namespace
} // namespace parity::bake
