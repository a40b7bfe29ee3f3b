// In which order scenes are begun, and when the driver compiles quickly.
#include "job/scene_work.h"

#include <cstdlib>
#include <fstream>
#include <optional>

#include <gtest/gtest.h>

#include "base/temp_folder.h"
#include "job/scene_times.h"

namespace parity::job {
namespace {

using Order = std::vector<std::size_t>;

SceneRequest request(const std::string& file, const std::string& environment = "") {
  SceneRequest scene;
  scene.scene = file;
  scene.settings.scene.environment = environment;
  scene.views.resize(1);
  return scene;
}

class SceneWork : public ::testing::Test {
protected:
  base::TempFolder m_folder;
  base::Cache m_cache{m_folder / "cache"};

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(m_folder / name, std::ios::binary) << text;
    return (m_folder / name).string();
  }
};

TEST_F(SceneWork, AFilePromisesMoreByLobesLightsAndTextures) {
  const double none = promisedWork(request(write("none.gltf", R"({"materials": [{}]})")));
  const double texture =
      promisedWork(request(write("texture.gltf", R"({"materials": [{"normalTexture": {}}, {"normalTexture": {}}]})")));
  const double lobe = promisedWork(request(write("lobe.glb", "glTF....JSON"
                                                             R"({"extensionsUsed": ["KHR_materials_sheen"]})" +
                                                                 std::string(100, '\0'))));
  const double lights = promisedWork(request(write("lights.gltf", R"({"extensionsUsed": ["KHR_lights_punctual"]})")));
  EXPECT_EQ(none, 1);
  EXPECT_GT(texture, none);
  EXPECT_GT(lobe, texture);
  EXPECT_GT(lights, texture);
}

TEST_F(SceneWork, WhatCannotBeReadPromisesWhatAnyFileDoes) {
  EXPECT_EQ(promisedWork(request("builtin:lobes")), 1);
  EXPECT_EQ(promisedWork(request((m_folder / "missing.gltf").string())), 1);
  EXPECT_EQ(promisedWork(request(m_folder.path().string())), 1) << "a folder";
  EXPECT_EQ(promisedWork(request(write("empty.gltf", ""))), 1);
}

TEST_F(SceneWork, TheLongestIsBegunFirst) {
  const std::string plain = write("plain.gltf", "{}"), lobes = write("lobes.gltf", R"("KHR_materials_sheen")");
  EXPECT_EQ(orderOfWork(m_cache, {request(plain), request(lobes), request(plain), request(lobes)}),
            (Order{1, 3, 0, 2}));
  EXPECT_EQ(orderOfWork(base::Cache::disabled(), {request(plain), request(lobes)}), (Order{1, 0}));
  EXPECT_TRUE(orderOfWork(m_cache, {}).empty());
}

TEST_F(SceneWork, WhatAnEarlierRunTookCountsRatherThanThePromise) {
  const std::vector<SceneRequest> scenes = {request(write("lobes.gltf", R"("KHR_materials_sheen")")),
                                            request("builtin:spheres"), request("builtin:room"),
                                            request("builtin:lamps")};
  keepSceneTime(m_cache, scenes[0], 1);
  keepSceneTime(m_cache, scenes[1], 2);
  keepSceneTime(m_cache, scenes[3], 3);
  EXPECT_EQ(orderOfWork(m_cache, scenes), (Order{3, 1, 2, 0})) << "the one that is not known counts as the median";
}

TEST_F(SceneWork, ScenesUnderOneEnvironmentStayTogether) {
  const std::string plain = write("plain.gltf", "{}"), lobes = write("lobes.gltf", R"("KHR_materials_sheen")");
  std::vector<SceneRequest> scenes = {request(plain, "a.hdr"), request(lobes, "b.hdr"), request(lobes, "a.hdr"),
                                      request(plain, "b.hdr")};
  EXPECT_EQ(orderOfWork(m_cache, scenes), (Order{2, 0, 1, 3}));
  scenes[2].settings.scene.environmentRotationDeg = 90;
  EXPECT_EQ(orderOfWork(m_cache, scenes), (Order{0, 1, 3, 2})) << "a turned one is another";
}

TEST_F(SceneWork, OnlyNeighboursChangePlaces) {
  const std::string plain = write("plain.gltf", "{}"), lobes = write("lobes.gltf", R"("KHR_materials_sheen")");
  std::vector<SceneRequest> scenes(kScenesInOrder + 3, request(plain));
  scenes.back() = scenes[2] = request(lobes);
  Order expected = {2, 0, 1, kScenesInOrder + 2}; // three, then all others
  for (std::size_t i = 3; i < kScenesInOrder + 2; ++i) expected.push_back(i);
  EXPECT_EQ(orderOfWork(m_cache, scenes), expected);
}

TEST_F(SceneWork, SamplesAreThoseOfAllViewsOnAverage) {
  std::vector<SceneRequest> scenes = {request("builtin:room"), request("builtin:room")};
  for (SceneRequest& scene : scenes) scene.settings.width = 100, scene.settings.height = 10;
  EXPECT_EQ(samplesOfAScene(scenes), 1000u);
  scenes[1].views.resize(3);
  EXPECT_EQ(samplesOfAScene(scenes), 2000u);
  scenes[0].settings.samples = 4;
  EXPECT_EQ(samplesOfAScene(scenes), 3500u);
  EXPECT_EQ(samplesOfAScene({}), 0u);
}

// What GALLIVM_PERF is afterwards; nothing where it is not set.
std::optional<std::string> effortFor(const std::optional<std::string>& before, int width, int height) {
  const char* const name = "GALLIVM_PERF";
  if (before)
    setenv(name, before->c_str(), 1);
  else
    unsetenv(name);
  SceneRequest scene = request("builtin:room");
  scene.settings.width = width, scene.settings.height = height;
  chooseCompilerEffort({scene});
  const char* const after = std::getenv(name);
  const std::optional<std::string> found = after ? std::optional<std::string>(after) : std::nullopt;
  unsetenv(name);
  return found;
}

TEST_F(SceneWork, TheDriverCompilesQuicklyForSmallPictures) {
  EXPECT_EQ(effortFor(std::nullopt, 512, 512), "nopt");
  EXPECT_EQ(effortFor(std::nullopt, 1024, 512), "nopt");
  EXPECT_EQ(effortFor(std::nullopt, 1024, 513), std::nullopt);
}

TEST_F(SceneWork, WhatTheEnvironmentTellsTheDriverStays) {
  EXPECT_EQ(effortFor("", 64, 64), "");
  EXPECT_EQ(effortFor("no_quad_lod", 64, 64), "no_quad_lod");
}

} // namespace
} // namespace parity::job
