// TEXCOORD_1 is taken where it serves, and what is wrong with it is said where it does not.
#include "bake/atlas/uv_check.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "bake/atlas/atlas.h"
#include "bake/atlas_truth.h"
#include "scenes/builtin/shapes.h"
#include "support/small_scenes.h"

namespace parity::tests {
namespace {

using scenes::Mesh;

// Two upright squares of 1 m side by side, 1 m apart, uvs of their own: each `size` wide, the second from `second` on.
Mesh twoCards(float size, const glm::vec2& second) {
  Mesh mesh;
  mesh.name = "cards";
  for (int card = 0; card < 2; ++card) {
    const Mesh part = scenes::makeCard(1, 1);
    scenes::appendMesh(mesh, part, translation(2.f * static_cast<float>(card), 0, 0));
    for (const glm::vec2& uv : part.uv0) mesh.uv1.push_back(uv * size + (card == 1 ? second : glm::vec2(0)));
  }
  return mesh;
}

std::string noteOf(const Mesh& mesh, const bake::AtlasOptions& options = {}) {
  return bake::makeAtlas(sceneOf(mesh), options).notes.at(0);
}

TEST(LightmapUvs, AreTakenWhereTheyServe) {
  const Mesh mesh = twoCards(0.4f, {0.6f, 0});
  EXPECT_EQ(noteOf(mesh), "cards: TEXCOORD_1");
  const scenes::Scene scene = sceneOf(mesh);
  const bake::Atlas atlas = bake::makeAtlas(scene, {});
  expectSound(measureAtlas(scene, atlas), {}, "cards");
  // 1 m is 16 texels and .4 of uv: from the first's left to the second's right 40 of them.
  float right = 0;
  for (const glm::vec2& corner : atlas.uvs.corners)
    right = std::max(right, corner.x * static_cast<float>(atlas.pageSide));
  EXPECT_NEAR(right, 41, 1e-3); // 1 of padding before them
}

TEST(LightmapUvs, MayBeMirroredAndAnywhere) {
  Mesh mesh = twoCards(0.4f, {0.6f, 0});
  for (glm::vec2& uv : mesh.uv1) uv = glm::vec2(5 - uv.x, uv.y - 7);
  EXPECT_EQ(noteOf(mesh), "cards: TEXCOORD_1");
}

TEST(LightmapUvs, AreRefusedWithTheReason) {
  const std::string own = "cards: unwrapped into 2 charts (";
  EXPECT_EQ(noteOf(twoCards(0.4f, {0.2f, 0.1f})), own + "TEXCOORD_1 has triangles that overlap)");
  EXPECT_EQ(noteOf(twoCards(0.4f, {0, 0})), own + "TEXCOORD_1 has triangles that overlap)");
  EXPECT_EQ(noteOf(twoCards(0.4f, {0.42f, 0})), own + "TEXCOORD_1 has charts less than 2 texels apart)");
  EXPECT_EQ(noteOf(twoCards(0, {1, 0})), own + "TEXCOORD_1 has no area)");

  Mesh infinite = twoCards(0.4f, {0.6f, 0});
  infinite.uv1[5].y = std::numeric_limits<float>::infinity();
  EXPECT_EQ(noteOf(infinite), own + "TEXCOORD_1 is not finite)");
  Mesh pinched = twoCards(0.4f, {0.6f, 0});
  for (std::size_t i = 4; i < 8; ++i) pinched.uv1[i] = {0.9f, 0.9f};
  EXPECT_EQ(noteOf(pinched), own + "TEXCOORD_1 has triangles with almost no area)");
  Mesh uneven = twoCards(0.4f, {0.6f, 0});
  for (std::size_t i = 4; i < 8; ++i) uneven.uv1[i] = glm::vec2(0.6f, 0) + 0.15f * (uneven.uv1[i] - glm::vec2(0.6f, 0));
  EXPECT_EQ(noteOf(uneven), own + "TEXCOORD_1 is uneven: a chart has 0.21 of the requested density)");
  Mesh wide = twoCards(0.4f, {100, 0});
  EXPECT_EQ(noteOf(wide, {16, 2048, 2}), own + "TEXCOORD_1 needs 4016 x 16 texels, more than a page)");
}

// Both triangles of a quad share an edge, a fan's many share a vertex, at any angle to the grid.
TEST(LightmapUvs, OfTrianglesThatTouchDoNotOverlap) {
  for (int turn = 0; turn < 24; ++turn) {
    Mesh mesh = scenes::makeRod({0, 0, 0}, {0, 1, 0}, 0.5, 37);
    // Its lower cap alone, seen from below.
    std::vector<std::uint32_t> cap;
    for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
      bool isLow = true;
      for (std::size_t k = 0; k < 3; ++k) isLow = isLow && mesh.positions[mesh.indices[3 * t + k]].y == 0;
      if (isLow) cap.insert(cap.end(), mesh.indices.begin() + 3 * t, mesh.indices.begin() + 3 * t + 3);
    }
    ASSERT_FALSE(cap.empty());
    mesh.indices = cap;
    const float angle = 0.1f * static_cast<float>(turn);
    for (const glm::vec3& p : mesh.positions)
      mesh.uv1.emplace_back(std::cos(angle) * p.x - std::sin(angle) * p.z,
                            std::sin(angle) * p.x + std::cos(angle) * p.z);
    EXPECT_EQ(noteOf(mesh, {100, 2048, 2}), "mesh: TEXCOORD_1") << turn;
  }
}

} // namespace
} // namespace parity::tests
