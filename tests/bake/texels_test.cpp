// What stands behind texels: places and normals of known surfaces, and that no surface is lost.
#include "bake/atlas/texels.h"

#include <map>
#include <random>
#include <set>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "bake/atlas_truth.h"
#include "scenes/builtin/builtin.h"
#include "scenes/builtin/shapes.h"
#include "support/small_scenes.h"

namespace parity::tests {
namespace {

using bake::Atlas;
using bake::makeAtlas;
using bake::SurfacePoint;
using bake::TexelGrid;
using scenes::Scene;

template <typename Body> void forEachPoint(const Atlas& atlas, const TexelGrid& grid, const Body& body) {
  const int factor = grid.factor();
  for (int page = 0; page < atlas.pageCount; ++page)
    for (int y = 0; y < atlas.pageSide * factor; ++y)
      for (int x = 0; x < atlas.pageSide * factor; ++x)
        if (const auto point = grid.at(static_cast<std::uint32_t>(page), x, y)) body(page, x, y, *point);
}

TEST(TexelGrid, KnowsAQuadsPlaces) {
  Scene scene = sceneOf(makeQuad(0));
  scene.instances[0].toWorld = glm::rotate(translation(1, 2, 3), 1.f, glm::vec3(0, 1, 0));
  const Atlas atlas = makeAtlas(scene, {8, 2048, 2});
  const TexelGrid grid(scene, atlas, 4);
  EXPECT_EQ(grid.texels().size(), 16u * 16);
  const glm::mat4 toObject = glm::inverse(scene.instances[0].toWorld);
  std::set<std::pair<int, int>> places; // in sub-texels of the quad
  forEachPoint(atlas, grid, [&](int, int, int, const SurfacePoint& point) {
    const glm::vec3 p(toObject * glm::vec4(point.position, 1));
    EXPECT_NEAR(p.z, 0, 1e-5);
    EXPECT_LT(glm::length(point.normal - glm::vec3(scene.instances[0].toWorld[2])), 1e-5f);
    EXPECT_LT(glm::length(point.geometric - point.normal), 1e-5f);
    const glm::vec2 cell = (glm::vec2(p) + 1.f) * 32.f - 0.5f; // 64 sub-texels over 2 m, at their middles
    EXPECT_LT(glm::length(cell - glm::round(cell)), 2e-3f);
    places.emplace(static_cast<int>(std::lround(cell.x)), static_cast<int>(std::lround(cell.y)));
  });
  EXPECT_EQ(places.size(), 64u * 64);
}

// Sphere and its mirror image, stretched: of the implicit surface x^2/a^2 + y^2/b^2 + z^2/c^2 = 1.
TEST(TexelGrid, TurnsNormalsRightly) {
  for (const glm::vec3& stretch : {glm::vec3(1), glm::vec3(-1, 1, 1), glm::vec3(3, 1, 0.5f), glm::vec3(3, 1, -0.5f)}) {
    Scene scene = sceneOf(scenes::makeSphere(1, 64, 32));
    scene.instances[0].toWorld = glm::scale(glm::mat4(1.f), stretch);
    const Atlas atlas = makeAtlas(scene, {10, 2048, 2});
    const TexelGrid grid(scene, atlas, 2);
    std::size_t count = 0;
    forEachPoint(atlas, grid, [&](int, int, int, const SurfacePoint& point) {
      const glm::vec3 expected = glm::normalize(point.position / (stretch * stretch));
      EXPECT_GT(glm::dot(point.normal, expected), 0.995f);
      EXPECT_GT(glm::dot(point.geometric, expected), 0.95f); // of a facet
      EXPECT_NEAR(glm::length(point.normal), 1, 1e-5);
      EXPECT_NEAR(glm::length(point.geometric), 1, 1e-5);
      ++count;
    });
    EXPECT_GT(count, 1000u);
  }
}

// Flattened to a sheet, and too small for the squares of its sizes.
TEST(TexelGrid, HasUnitNormalsUnderAnyTransform) {
  for (const glm::vec3& scale : {glm::vec3(1, 1, 0), glm::vec3(1, 0, 0), glm::vec3(1e-18f), glm::vec3(1e12f)}) {
    Scene scene = sceneOf(scenes::makeSphere(1, 16, 8));
    scene.instances[0].toWorld = glm::scale(glm::mat4(1.f), scale);
    const Atlas atlas = makeAtlas(scene, {10 / static_cast<double>(scale.x), 2048, 2});
    const TexelGrid grid(scene, atlas, 2);
    EXPECT_GT(grid.texels().size(), 100u);
    forEachPoint(atlas, grid, [&](int, int, int, const SurfacePoint& point) {
      EXPECT_NEAR(glm::length(point.normal), 1, 1e-5);
      EXPECT_NEAR(glm::length(point.geometric), 1, 1e-5);
    });
  }
}

// Wherever a point of the surface lies, its texel is of its object: also in tips that hold no sub-texel's middle.
TEST(TexelGrid, HasATexelUnderEveryPointOfTheSurface) {
  Scene scene = sceneOf(makeSoup(300, 0.5f, 5));
  scene.meshes.push_back(scenes::makeTeapot());
  scene.instances.push_back({1, glm::mat4(1.f), "teapot"});
  const Atlas atlas = makeAtlas(scene, {40, 2048, 2});
  const TexelGrid grid(scene, atlas, 4);
  std::map<std::pair<int, int>, std::uint32_t> owners;
  for (const bake::Texel& texel : grid.texels()) owners.emplace(std::pair(texel.x, texel.y), texel.instance);
  std::mt19937 random(1);
  std::size_t missed = 0, points = 0;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    for (std::uint32_t t = 0; t < scene.meshes[i].indices.size() / 3; ++t)
      for (int k = 0; k < 8; ++k, ++points) {
        // Half of them at the tips.
        float u = static_cast<float>(random() % 1000) / 1000.f, v = static_cast<float>(random() % 1000) / 1000.f;
        if (u + v > 1) u = 1 - u, v = 1 - v;
        if (k % 2 == 0) u *= 0.01f, v *= 0.01f;
        const glm::vec2 texel = bake::texelPosition(atlas, i, t, u, v);
        // As near to a border as this it may be rounding.
        const glm::vec2 inside = glm::abs(texel - glm::round(texel));
        if (std::min(inside.x, inside.y) < 0.01f) continue;
        const auto owner = owners.find({static_cast<int>(texel.x), static_cast<int>(texel.y)});
        missed += owner == owners.end() || owner->second != i;
      }
  EXPECT_GT(points, 10'000u);
  EXPECT_EQ(missed, 0u);
}

// From a point's texel to its triangle and back: every point lies on a triangle of its instance whose uv at that point
// is the sub-texel.
void expectRoundTrip(const Scene& scene, const Atlas& atlas, const std::string& what) {
  const int factor = 4;
  const TexelGrid grid(scene, atlas, factor);
  std::map<std::tuple<int, int, int>, SurfacePoint> points;
  forEachPoint(atlas, grid, [&](int page, int x, int y, const SurfacePoint& point) {
    points.emplace(std::tuple(page, x, y), point);
  });
  std::size_t found = 0, lost = 0;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const scenes::LightmapUvs::Place& place = atlas.uvs.places[i];
    if (place.page < 0) continue;
    const scenes::Mesh& mesh = scene.meshes[scene.instances[i].mesh];
    const glm::dmat4 toWorld(scene.instances[i].toWorld);
    for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
      std::array<glm::dvec3, 3> p;
      std::array<glm::dvec2, 3> corners; // in sub-texels
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = glm::dvec3(toWorld * glm::dvec4(mesh.positions[mesh.indices[3 * t + k]], 1));
        corners[k] = static_cast<double>(factor) * glm::dvec2(bake::texelPosition(atlas, i, t, k == 1, k == 2));
      }
      const glm::dvec3 doubled = glm::cross(p[1] - p[0], p[2] - p[0]);
      if (glm::dot(doubled, doubled) == 0) continue;
      const auto pointAt = [&](const glm::ivec2& cell) { return points.find({place.page, cell.x, cell.y}); };
      const auto isLost = [&](const glm::ivec2& cell) {
        return pointAt(cell) == points.end() || pointAt(cell)->second.instance != i;
      };
      const glm::ivec2 middleCell((corners[0] + corners[1] + corners[2]) / 3.0);
      for (const glm::ivec2& cell : cellsHeld(corners, 0)) lost += isLost(cell);
      if (cellsHeld(corners, -2e-3).empty()) lost += isLost(middleCell);
      if (isLost(middleCell)) continue; // its middle lies in a sub-texel whose own is beside the chart
      const auto point = pointAt(middleCell);
      const glm::dvec3 offset = glm::dvec3(point->second.position) - p[0];
      const glm::dvec3 normal = glm::normalize(doubled);
      // Another triangle may have the sub-texel; of this one, the point lies in its plane, and its weights give the
      // sub-texel's middle back.
      const double u = glm::dot(glm::cross(offset, p[2] - p[0]), doubled) / glm::dot(doubled, doubled);
      const double v = glm::dot(glm::cross(p[1] - p[0], offset), doubled) / glm::dot(doubled, doubled);
      if (u < 1e-3 || v < 1e-3 || u + v > 1 - 1e-3) continue;
      const double extent = std::max({glm::length(p[0]), glm::length(p[1]), glm::length(p[2])});
      if (std::abs(glm::dot(offset, normal)) > 1e-5 * extent) continue;
      const glm::vec2 back = bake::texelPosition(atlas, i, t, static_cast<float>(u), static_cast<float>(v));
      const glm::dvec2 middle(std::get<1>(point->first) + 0.5, std::get<2>(point->first) + 0.5);
      EXPECT_LT(glm::length(glm::dvec2(back) * static_cast<double>(factor) - middle), 0.05) << what;
      ++found;
    }
  }
  EXPECT_EQ(lost, 0u) << what; // each sub-texel that a triangle holds is its, or another's of its object
  EXPECT_GT(found, 0u) << what;
}

TEST(TexelGrid, GoesToTheSurfaceAndBack) {
  Scene scene = sceneOf(scenes::makeTeapot());
  scene.instances.push_back({0, glm::scale(translation(4, 0, 0), glm::vec3(-1.5f, 1, 1)), "mirrored"});
  expectRoundTrip(scene, makeAtlas(scene, {40, 2048, 2}), "teapots");
  expectRoundTrip(scene, makeAtlas(scene, {4, 2048, 2}), "small teapots");
  const Scene soup = sceneOf(makeSoup(300, 0.5f, 9));
  expectRoundTrip(soup, makeAtlas(soup, {30, 2048, 2}), "soup");
  for (const char* name : {"materials", "shadows", "lamps"}) {
    const Scene builtin = scenes::makeBuiltinScene(name);
    expectRoundTrip(builtin, makeAtlas(builtin, {8, 2048, 2}), name);
  }
}

// A needle of 1/20 of a sub-texel's height between two sub-texels' middles.
TEST(TexelGrid, LosesNoSliver) {
  scenes::Mesh mesh = makeQuad(0);
  mesh.positions = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {6, 0, 0}, {10, 0, 0}, {8, 0.003f, 0}};
  mesh.normals.assign(7, {0, 0, 1});
  mesh.uv1 = {};
  for (const glm::vec3& p : mesh.positions) mesh.uv1.emplace_back(p.x, p.y);
  mesh.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6};
  mesh.uv1[6].y = 0.02f; // enough to be taken
  const Scene scene = sceneOf(mesh);
  const Atlas atlas = makeAtlas(scene, {4, 2048, 2});
  ASSERT_EQ(atlas.notes[0], "quad: TEXCOORD_1");
  const TexelGrid grid(scene, atlas, 4);
  std::size_t ofSliver = 0;
  forEachPoint(atlas, grid, [&](int, int, int, const SurfacePoint& point) {
    if (point.position.x <= 5) return;
    ++ofSliver;
    EXPECT_GE(point.position.y, 0.f);
    EXPECT_LE(point.position.y, 0.003f);
  });
  EXPECT_EQ(ofSliver, 16u); // one in each texel along its 4 m
}

TEST(TexelGrid, ListsEachCoveredTexelOnceWithItsInstance) {
  const Scene scene = scenes::makeBuiltinScene("materials");
  const Atlas atlas = makeAtlas(scene, {32, 256, 2}); // several pages
  ASSERT_GT(atlas.pageCount, 1);
  const TexelGrid grid(scene, atlas, 3);
  std::set<std::tuple<std::uint32_t, int, int>> covered;
  forEachPoint(atlas, grid, [&](int page, int x, int y, const SurfacePoint&) { covered.emplace(page, y / 3, x / 3); });
  ASSERT_EQ(grid.texels().size(), covered.size());
  auto next = covered.begin();
  for (const bake::Texel& texel : grid.texels()) {
    EXPECT_EQ(std::tuple(texel.page, int{texel.y}, int{texel.x}), *next++);
    for (int k = 0; k < 9; ++k)
      if (const auto point = grid.at(texel.page, texel.x * 3 + k % 3, texel.y * 3 + k / 3)) {
        EXPECT_EQ(point->instance, texel.instance);
        EXPECT_EQ(atlas.uvs.places[point->instance].page, static_cast<int>(texel.page));
      }
  }
}

TEST(TexelGrid, TakesLittleMemory) {
  const Scene fine = sceneOf(scenes::makeSphere(1, 500, 250)), coarse = sceneOf(makeQuad(0));
  for (const Scene* scene : {&fine, &coarse}) {
    const Atlas atlas = makeAtlas(*scene, {150, 2048, 2});
    const TexelGrid grid(*scene, atlas, 4);
    EXPECT_LE(static_cast<double>(grid.bytes()), 70.0 * atlas.pageSide * atlas.pageSide * atlas.pageCount);
  }
}

} // namespace
} // namespace parity::tests
