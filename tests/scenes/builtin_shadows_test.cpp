// builtin:shadows: each object is the case that its name promises.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "scenes/builtin/builtin.h"

namespace parity::tests {
namespace {

using scenes::AlphaMode;
using scenes::Bounds;
using scenes::Light;
using scenes::LightKind;
using scenes::Scene;

struct BuiltinShadows : testing::Test {
  const Scene scene = scenes::makeBuiltinScene("shadows");

  const scenes::Instance& find(const std::string& name) const {
    for (const scenes::Instance& instance : scene.instances)
      if (instance.node == name) return instance;
    throw std::runtime_error("no object '" + name + "'");
  }
  const scenes::Material& materialOf(const std::string& name) const {
    return scene.materials[scene.meshes[find(name).mesh].material];
  }
  std::vector<glm::vec3> cornersOf(const scenes::Instance& instance) const {
    std::vector<glm::vec3> corners;
    const scenes::Mesh& mesh = scene.meshes[instance.mesh];
    for (const std::uint32_t i : mesh.indices) corners.emplace_back(instance.toWorld * glm::vec4(mesh.positions[i], 1));
    return corners;
  }
  Bounds boundsOf(const std::string& name) const {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    Bounds bounds{glm::vec3(kFar), glm::vec3(-kFar)};
    for (const glm::vec3& p : cornersOf(find(name))) bounds = {glm::min(bounds.lower, p), glm::max(bounds.upper, p)};
    return bounds;
  }
  const Light& lightOf(LightKind kind) const {
    return *std::find_if(scene.lights.begin(), scene.lights.end(), [&](const Light& l) { return l.kind == kind; });
  }
};

// How often a surface goes around a point: 1 within a closed one, 0 outside. Solid angles of triangles by van Oosterom
// and Strackee 1983, eq. 8.
double windingNumber(const std::vector<glm::vec3>& corners, const glm::vec3& point) {
  double angle = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const glm::dvec3 a(corners[i] - point), b(corners[i + 1] - point), c(corners[i + 2] - point);
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    angle += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

TEST_F(BuiltinShadows, AreOfOneSunOnePointAndOneSpot) {
  ASSERT_EQ(scene.lights.size(), 3u);
  for (const LightKind kind : {LightKind::directional, LightKind::point, LightKind::spot})
    EXPECT_EQ(std::count_if(scene.lights.begin(), scene.lights.end(), [&](const Light& l) { return l.kind == kind; }),
              1);
  for (const Light& light : scene.lights) EXPECT_NEAR(glm::length(light.direction), 1.f, 1e-6f);
  EXPECT_LT(lightOf(LightKind::directional).direction.y, -0.5f);
  EXPECT_EQ(scene.environment->name, "night");
  EXPECT_LT(scene.triangleCount(), 200000u);
  EXPECT_EQ(scene.materials.size(), 12u);
}

TEST_F(BuiltinShadows, LightsAreWithinNoClosedObject) {
  for (const scenes::Instance& instance : scene.instances) {
    if (materialOf(instance.node).doubleSided || instance.node == "floor") continue; // not closed
    const std::vector<glm::vec3> corners = cornersOf(instance);
    EXPECT_NEAR(windingNumber(corners, {50, 60, 70}), 0, 1e-3) << instance.node;
    for (const Light& light : scene.lights)
      if (light.kind != LightKind::directional) {
        EXPECT_NEAR(windingNumber(corners, light.position), 0, 1e-3) << instance.node << ", " << light.name;
      }
  }
  EXPECT_NEAR(windingNumber(cornersOf(find("resting ball")), boundsOf("resting ball").center()), 1, 1e-3);
}

TEST_F(BuiltinShadows, WhatRestsTouchesTheFloorAndWhatFloatsDoesNot) {
  EXPECT_EQ(boundsOf("floor").lower.y, 0.f);
  EXPECT_EQ(boundsOf("floor").upper.y, 0.f);
  for (const char* name : {"resting ball", "thin columns", "box behind the wall", "leaves", "blended pane"})
    EXPECT_EQ(boundsOf(name).lower.y, 0.f) << name;
  EXPECT_NEAR(boundsOf("plinth").lower.y, 0.f, 1e-7f);
  EXPECT_EQ(boundsOf("lantern").lower.y, 0.f);
  EXPECT_LT(boundsOf("thin wall").lower.y, -0.005f); // goes through it, round edges and all
  EXPECT_NEAR(boundsOf("floating box").lower.y, 0.01f, 1e-6f);
  EXPECT_NEAR(boundsOf("torus knot").lower.y, 0.f, 0.01f);
  for (const auto& instance : scene.instances) { // the floor is under everything
    const Bounds bounds = boundsOf(instance.node), floor = boundsOf("floor");
    EXPECT_GE(bounds.lower.x, floor.lower.x) << instance.node;
    EXPECT_GE(bounds.lower.z, floor.lower.z) << instance.node;
    EXPECT_LE(bounds.upper.x, floor.upper.x) << instance.node;
    EXPECT_LE(bounds.upper.z, floor.upper.z) << instance.node;
  }
}

TEST_F(BuiltinShadows, PlankLeavesAGapThatClosesToACentimetre) {
  const Bounds plank = boundsOf("leaning plank"), plinth = boundsOf("plinth");
  EXPECT_GT(plank.lower.y, 0.005f);
  EXPECT_LT(plank.lower.y, 0.015f);
  EXPECT_NEAR(plank.upper.y, plinth.upper.y + 0.012f, 0.01f);
  EXPECT_GT(plank.upper.x - plinth.upper.x, 0.8f); // hangs over
  EXPECT_LT(plank.lower.x, plinth.upper.x);
}

// Whatever shadow the sun casts there is the wall's; light that leaks under it falls on the box.
TEST_F(BuiltinShadows, BoxStandsInTheWallsShadowRightBehindIt) {
  const Bounds wall = boundsOf("thin wall"), box = boundsOf("box behind the wall");
  EXPECT_LT(wall.upper.x - wall.lower.x, 0.04f);
  EXPECT_GT(box.lower.x, wall.upper.x);
  EXPECT_LT(box.lower.x - wall.upper.x, 0.01f);
  const glm::vec3 towardsSun = -lightOf(LightKind::directional).direction;
  for (int i = 0; i < 8; ++i) { // from each corner of the box towards the sun
    const glm::vec3 corner(i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                           i & 4 ? box.upper.z : box.lower.z);
    const glm::vec3 met = corner + towardsSun * ((wall.upper.x - corner.x) / towardsSun.x);
    EXPECT_LT(met.y, wall.upper.y - 0.01f);
    EXPECT_GT(met.z, wall.lower.z + 0.01f);
    EXPECT_LT(met.z, wall.upper.z - 0.01f);
  }
}

TEST_F(BuiltinShadows, ColumnsAreTwoCentimetresInRadius) {
  const Bounds columns = boundsOf("thin columns");
  EXPECT_NEAR(columns.upper.z - columns.lower.z, 0.04f, 1e-4f);
  EXPECT_GT(columns.upper.y, 0.8f);
}

TEST_F(BuiltinShadows, LeavesAreMaskedWithHolesAndThePaneIsBlended) {
  const scenes::Material& leaves = materialOf("leaves");
  EXPECT_EQ(leaves.alphaMode, AlphaMode::mask);
  EXPECT_TRUE(leaves.doubleSided);
  ASSERT_TRUE(leaves.baseColorTexture.present());
  const base::Image8& pixels = scene.images[static_cast<std::size_t>(leaves.baseColorTexture.image)].pixels;
  std::size_t covered = 0;
  for (int y = 0; y < pixels.height; ++y)
    for (int x = 0; x < pixels.width; ++x)
      covered += static_cast<float>(pixels.at(x, y)[3]) >= 255 * leaves.alphaCutoff;
  const double share = static_cast<double>(covered) / (static_cast<double>(pixels.width) * pixels.height);
  EXPECT_GT(share, 0.25);
  EXPECT_LT(share, 0.75);

  const scenes::Material& pane = materialOf("blended pane");
  EXPECT_EQ(pane.alphaMode, AlphaMode::blend);
  EXPECT_GT(pane.baseColor.a, 0.2f);
  EXPECT_LT(pane.baseColor.a, 0.8f);
  EXPECT_EQ(std::count_if(scene.materials.begin(), scene.materials.end(),
                          [](const auto& m) { return m.alphaMode != AlphaMode::opaque; }),
            2);
}

TEST_F(BuiltinShadows, KnotIsOfManyTriangles) {
  EXPECT_GT(scene.meshes[find("torus knot").mesh].indices.size() / 3, 50000u);
}

// The six faces of a cube map about the lamp: each sees bars, none nearer than the near plane may be, and gaps.
TEST_F(BuiltinShadows, LanternHasBarsAndGapsInEveryFaceOfItsCube) {
  const Light& lamp = lightOf(LightKind::point);
  const std::vector<glm::vec3> corners = cornersOf(find("lantern"));
  std::array<double, 6> covered{}; // solid angle; bars have a front and a back
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const glm::vec3 towards = (corners[i] + corners[i + 1] + corners[i + 2]) / 3.f - lamp.position;
    EXPECT_GT(glm::length(towards), 0.1f);
    const glm::vec3 size = glm::abs(towards);
    const int axis = size.x > std::max(size.y, size.z) ? 0 : size.y > size.z ? 1 : 2;
    const glm::vec3 area = 0.5f * glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]);
    covered[static_cast<std::size_t>(2 * axis + (towards[axis] < 0))] +=
        0.5 * std::abs(glm::dot(area, towards)) / std::pow(glm::length(towards), 3.0);
  }
  constexpr double kFace = 4 * std::numbers::pi / 6;
  for (std::size_t face = 0; face < 6; ++face) {
    EXPECT_GT(covered[face], 0.2 * kFace) << face;
    EXPECT_LT(covered[face], 0.5 * kFace) << face;
  }
}

} // namespace
} // namespace parity::tests
