// The atlas by properties that every lightmap needs, over built-in scenes, generated shapes and random triangles.
#include "bake/atlas/atlas.h"

#include <iostream>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "bake/atlas_truth.h"
#include "base/error.h"
#include "scenes/builtin/builtin.h"
#include "scenes/builtin/shapes.h"
#include "support/small_scenes.h"

namespace parity::tests {
namespace {

using bake::Atlas;
using bake::AtlasOptions;
using bake::makeAtlas;
using scenes::Mesh;
using scenes::Scene;

std::string refusalOf(const Scene& scene, const AtlasOptions& options) {
  try {
    makeAtlas(scene, options);
  } catch (const base::Error& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

void expectSoundAtlas(const Scene& scene, const AtlasOptions& options, const std::string& what, double leastCoverage) {
  const Atlas atlas = makeAtlas(scene, options);
  EXPECT_EQ(atlas.pageSide % 4, 0) << what;
  EXPECT_LE(atlas.pageSide, options.maxPageSide) << what;
  const AtlasFacts facts = measureAtlas(scene, atlas);
  expectSound(facts, options, what);
  EXPECT_GE(facts.coverage, leastCoverage) << what;
  std::cout << fmt::format("{}: {} x {}^2 texels, {} charts, {:.1f} % covered, density at least {:.2f} of that asked\n",
                           what, atlas.pageCount, atlas.pageSide, facts.charts, 100 * facts.coverage,
                           facts.leastChartDensity / options.texelsPerMetre);
}

TEST(Atlas, IsSoundForBuiltinScenes) {
  for (const std::string& name : scenes::builtinSceneNames()) {
    const Scene scene = scenes::makeBuiltinScene(name);
    expectSoundAtlas(scene, {}, name, 0.25);
  }
}

TEST(Atlas, IsSoundForGeneratedShapes) {
  const std::vector<std::pair<std::string, Mesh>> shapes = {
      {"sphere", scenes::makeSphere(1, 48, 24)},
      {"ring", scenes::makeRing({0, 1, 0}, 1, 0.3, 48, 24)},
      {"knot", scenes::makeTorusKnot(2, 3, 1, 0.3, 128, 16)},
      {"rounded box", scenes::makeRoundedBox({1, 0.5, 0.25}, 0.1, 3)},
      {"rod", scenes::makeRod({0, 0, 0}, {3, 4, 5}, 0.1, 12)},
      {"teapot", scenes::makeTeapot()},
      {"floor", scenes::makeFloor(2, 1, 9)},
      // A ramp that winds over itself three times, within 45 degrees of level: overlaps when seen from above.
      {"helix", scenes::makeSurface(90, 2, [](double u, double v) {
         const double angle = 6 * 3.14159265358979 * u;
         return glm::dvec3((2 - v) * std::cos(angle), 2 * u, (2 - v) * std::sin(angle));
       })}};
  for (const auto& [name, mesh] : shapes)
    for (const double density : {3.0, 40.0}) expectSoundAtlas(sceneOf(mesh), {density, 2048, 2}, name, 0.05);
}

TEST(Atlas, IsSoundForRandomTriangles) {
  for (unsigned seed = 1; seed <= 3; ++seed)
    expectSoundAtlas(sceneOf(makeSoup(400, 0.5f, seed)), {30, 2048, 2}, fmt::format("soup {}", seed), 0.1);
  // All vertices anew at the corners of a coarse grid: edges of many faces, duplicates, flipped ones, none with area.
  for (unsigned seed = 4; seed <= 6; ++seed) {
    Mesh mesh = makeSoup(600, 1, seed);
    for (glm::vec3& p : mesh.positions) p = glm::round(p * 2.f);
    expectSoundAtlas(sceneOf(mesh), {8, 2048, 2}, fmt::format("grid soup {}", seed), 0.1);
  }
}

// The same quad over and over, and its back: each has texels of its own, and the time is not quadratic.
TEST(Atlas, GivesDuplicatesTexelsOfTheirOwn) {
  Mesh mesh = makeQuad(0);
  const std::vector<std::uint32_t> quad = mesh.indices;
  for (int i = 0; i < 2000; ++i) {
    mesh.indices.insert(mesh.indices.end(), quad.begin(), quad.end());
    mesh.indices.insert(mesh.indices.end(), quad.rbegin(), quad.rend());
  }
  expectSoundAtlas(sceneOf(mesh), {2, 2048, 2}, "duplicates", 0.2);
}

TEST(Atlas, KeepsThePadding) {
  for (const int padding : {0, 1, 3, 4})
    expectSoundAtlas(sceneOf(scenes::makeTeapot()), {20, 2048, padding}, fmt::format("padding {}", padding), 0.05);
}

TEST(Atlas, CoversARectanglesTexelsWholly) {
  Scene scene = sceneOf(scenes::makeFloor(1, 1, 4));
  scene.instances[0].toWorld = glm::rotate(glm::mat4(1.f), 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
  const Atlas atlas = makeAtlas(scene, {16, 2048, 2});
  EXPECT_EQ(atlas.pageSide, 36); // 2 m of 16 texels, 2 of padding, the next multiple of 4
  glm::vec2 lower(1), upper(0);
  for (const glm::vec2& corner : atlas.uvs.corners) {
    lower = glm::min(lower, corner * 36.f);
    upper = glm::max(upper, corner * 36.f);
  }
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(lower[axis], 1, 1e-4);
    EXPECT_NEAR(upper[axis], 33, 1e-4);
  }
}

TEST(Atlas, KeepsFloorsAndWallsInOneChart) {
  const Atlas floor = makeAtlas(sceneOf(scenes::makeFloor(3, 1, 20)), {});
  EXPECT_TRUE(contains(floor.notes.at(0), "mesh: unwrapped into 1 chart (no TEXCOORD_1)")) << floor.notes[0];
  Scene box = sceneOf(scenes::makeRoundedBox({1, 1, 1}, 0.05, 2));
  const Atlas atlas = makeAtlas(box, {});
  EXPECT_LE(measureAtlas(box, atlas).charts, 12u);
}

TEST(Atlas, SharesALayoutWhereScalesAreAlike) {
  Scene scene = sceneOf(scenes::makeSphere(1, 24, 12));
  scene.instances.clear();
  for (const float scale : {1.f, 1.5f, 30.f, -1.9f, 18.f, 0.1f})
    scene.instances.push_back({0, glm::scale(glm::mat4(1.f), glm::vec3(scale)), "ball"});
  const AtlasOptions options{4, 2048, 2};
  const Atlas atlas = makeAtlas(scene, options);
  expectSound(measureAtlas(scene, atlas), options, "spheres");
  const auto first = [&](std::size_t i) { return atlas.uvs.places[i].firstCorner; };
  EXPECT_EQ(first(0), first(1));
  EXPECT_EQ(first(0), first(3));
  EXPECT_EQ(first(2), first(4));
  EXPECT_NE(first(0), first(2));
  EXPECT_NE(first(0), first(5));
  EXPECT_EQ(atlas.notes.size(), 3u);
  EXPECT_TRUE(contains(atlas.notes[0], "mesh at scale 30: ")) << atlas.notes[0];
}

TEST(Atlas, GoesByTheMostStretchedDirection) {
  Scene scene = sceneOf(makeQuad(0)); // 2 x 2 m
  // Turned by 45 degrees before it is stretched by 8: no column of the matrix is as long as that.
  scene.instances[0].toWorld = glm::rotate(glm::scale(glm::mat4(1.f), glm::vec3(8, 1, 1)), 0.7853982f, {0, 0, 1});
  EXPECT_EQ(makeAtlas(scene, {4, 2048, 2}).pageSide, 2 * 8 * 4 + 4);
}

TEST(Atlas, TakesSeveralPagesWhereOneIsNotEnough) {
  Scene scene = sceneOf(makeQuad(0));
  for (int i = 1; i < 11; ++i) scene.instances.push_back({0, translation(3.f * static_cast<float>(i), 0, 0), "quad"});
  const AtlasOptions options{15, 128, 2}; // 32 texels a quad: 16 to a page of 128
  EXPECT_EQ(makeAtlas(scene, options).pageCount, 1);
  for (int i = 11; i < 40; ++i) scene.instances.push_back({0, translation(3.f * static_cast<float>(i), 0, 0), "quad"});
  const Atlas atlas = makeAtlas(scene, options);
  EXPECT_EQ(atlas.pageCount, 3);
  EXPECT_EQ(atlas.pageSide, 128);
  expectSound(measureAtlas(scene, atlas), options, "quads");
}

TEST(Atlas, IsTheSameEachTime) {
  const Scene scene = scenes::makeBuiltinScene("shadows");
  const Atlas first = makeAtlas(scene, {}), second = makeAtlas(scene, {});
  EXPECT_EQ(first.pageSide, second.pageSide);
  EXPECT_EQ(first.uvs.corners, second.uvs.corners);
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
    EXPECT_EQ(first.uvs.places[i].offset, second.uvs.places[i].offset);
}

TEST(Atlas, PlacesAHundredThousandObjects) {
  Scene scene = sceneOf(scenes::makeRoundedBox({0.5, 0.5, 0.5}, 0.1, 1));
  scene.instances.clear();
  std::mt19937 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const float scale = std::exp2(static_cast<float>(random() % 1000) / 250.f - 4.f);
    scene.instances.push_back({0, glm::scale(glm::mat4(1.f), glm::vec3(scale)), "box"});
  }
  const Atlas atlas = makeAtlas(scene, {1, 2048, 2});
  for (const scenes::LightmapUvs::Place& place : atlas.uvs.places) EXPECT_GE(place.page, 0);
  EXPECT_LE(static_cast<std::size_t>(atlas.pageCount) * atlas.pageSide * atlas.pageSide, bake::kMaxTexels);
  const std::string refusal = refusalOf(scene, {40, 2048, 2});
  EXPECT_TRUE(contains(refusal, "million; lower --texels-per-metre")) << refusal;
}

TEST(Atlas, SaysWhereALowerDensityWouldNotHelp) {
  const std::string refusal = refusalOf(sceneOf(makeSoup(16'000, 0.01f, 3)), {1, 2048, 64});
  EXPECT_EQ(refusal, "scene: its lightmap needs 68 million texels, expected at most 67 million; its 16000 charts are "
                     "too many for any --texels-per-metre");
}

TEST(Atlas, LeavesOutWhatHasNoAreaOrNoLight) {
  Scene scene = sceneOf(makeQuad(0));
  Mesh line = makeQuad(0), sky = makeQuad(1);
  line.name = "line";
  for (glm::vec3& p : line.positions) p.y = 0;
  scene.materials.emplace_back().unlit = true;
  scene.meshes.push_back(line);
  scene.meshes.push_back(sky);
  scene.instances.push_back({1, glm::mat4(1.f), "line"});
  scene.instances.push_back({2, glm::mat4(1.f), "sky"});
  scene.instances.push_back({0, glm::scale(glm::mat4(1.f), glm::vec3(0)), "nothing"});
  const Atlas atlas = makeAtlas(scene, {});
  EXPECT_EQ(atlas.uvs.places[0].page, 0);
  for (int i = 1; i < 4; ++i) EXPECT_EQ(atlas.uvs.places[i].page, -1) << i;
  ASSERT_EQ(atlas.notes.size(), 2u);
  EXPECT_EQ(atlas.notes[1], "line: no lightmap (no triangle has an area)");
  scene.instances.erase(scene.instances.begin());
  EXPECT_EQ(refusalOf(scene, {}), "scene: has nothing to bake: no lit object has an area");
}

TEST(Atlas, SkipsTrianglesWithoutArea) {
  Mesh mesh = makeQuad(0);
  mesh.indices.insert(mesh.indices.end(), {0, 0, 1, 0, 2, 2, 1, 1, 1});
  const Scene scene = sceneOf(mesh);
  expectSoundAtlas(scene, {}, "quad and points", 0.5);
  EXPECT_EQ(makeAtlas(scene, {}).uvs.corners.size(), mesh.indices.size());
}

TEST(Atlas, RefusesInWords) {
  Scene broken = sceneOf(makeQuad(0));
  broken.meshes[0].positions[2].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusalOf(broken, {}), "quad: the position of vertex 2 is not finite, so it gets no lightmap");
  Scene beyond = sceneOf(makeQuad(0));
  beyond.meshes[0].indices[4] = 9;
  EXPECT_EQ(refusalOf(beyond, {}), "quad: its index 9 is out of range of its vertices");
  Scene moved = sceneOf(makeQuad(0));
  moved.instances[0].toWorld[0][0] = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(contains(refusalOf(moved, {}), "quad: node: its transform is not finite"));

  EXPECT_EQ(refusalOf(sceneOf(makeQuad(0)), {100, 128, 2}),
            "quad: a part of its surface needs 200 x 200 texels, but a lightmap page has at most 126 a side; lower "
            "--texels-per-metre or split the mesh");
  const std::string tooLarge = refusalOf(sceneOf(scenes::makeRoundedBox({1, 1, 1}, 0.01, 1)), {60, 128, 2});
  EXPECT_TRUE(contains(tooLarge, "mesh: needs a lightmap page of ")) << tooLarge;
  EXPECT_TRUE(contains(tooLarge, "lower --texels-per-metre or split the mesh")) << tooLarge;

  EXPECT_TRUE(contains(refusalOf(sceneOf(makeQuad(0)), {0, 128, 2}), "--texels-per-metre: must be above 0"));
  EXPECT_TRUE(contains(refusalOf(sceneOf(makeQuad(0)), {1, 130, 2}), "multiple of 4"));
  EXPECT_TRUE(contains(refusalOf(sceneOf(makeQuad(0)), {1, 128, -1}), "0 to 64 texels"));
}

} // namespace
} // namespace parity::tests
