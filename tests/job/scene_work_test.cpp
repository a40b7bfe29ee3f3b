// In which order scenes are begun, and when the driver compiles quickly.
#include "job/scene_work.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>

#include <sys/stat.h>

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
  const std::string pipe = (m_folder / "pipe.gltf").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(promisedWork(request(pipe)), 1) << "nobody writes to it: opening it would wait for ever";
}

TEST_F(SceneWork, TheLongestIsBegunFirst) {
  const std::string plain = write("plain.gltf", "{}"), lobes = write("lobes.gltf", R"("KHR_materials_sheen")");
  EXPECT_EQ(orderOfBlock(m_cache, {request(plain), request(lobes), request(plain), request(lobes)}, 0),
            (Order{1, 3, 0, 2}));
  EXPECT_EQ(orderOfBlock(base::Cache::disabled(), {request(plain), request(lobes)}, 0), (Order{1, 0}));
  EXPECT_TRUE(orderOfBlock(m_cache, {}, 0).empty());
}

TEST_F(SceneWork, WhatAnEarlierRunTookCountsRatherThanThePromise) {
  std::vector<SceneRequest> scenes = {request(write("lobes.gltf", R"("KHR_materials_sheen")")),
                                      request("builtin:spheres"), request("builtin:lamps")};
  keepSceneTime(m_cache, scenes[0], 1);
  keepSceneTime(m_cache, scenes[1], 2);
  keepSceneTime(m_cache, scenes[2], 3);
  EXPECT_EQ(orderOfBlock(m_cache, scenes, 0), (Order{2, 1, 0}));
}

TEST_F(SceneWork, PromisesAreScaledToWhatIsKnown) {
  const std::string lobes = write("lobes.gltf", R"("KHR_materials_sheen", "KHR_materials_clearcoat")");
  const std::vector<SceneRequest> scenes = {request("builtin:room"), request("builtin:spheres"), request(lobes)};
  keepSceneTime(m_cache, scenes[1], 10); // promised 1: the others take ten times their promises
  EXPECT_EQ(orderOfBlock(m_cache, scenes, 0), (Order{2, 0, 1})) << "22, 10 and 10";
  keepSceneTime(m_cache, scenes[0], 50);
  EXPECT_EQ(orderOfBlock(m_cache, scenes, 0), (Order{2, 0, 1})) << "66, 50 and 10";
  keepSceneTime(m_cache, scenes[2], 20);
  EXPECT_EQ(orderOfBlock(m_cache, scenes, 0), (Order{0, 2, 1}));
}

TEST_F(SceneWork, ScenesUnderOneEnvironmentStayTogether) {
  const std::string plain = write("plain.gltf", "{}"), lobes = write("lobes.gltf", R"("KHR_materials_sheen")");
  std::vector<SceneRequest> scenes = {request(plain, "a.hdr"), request(lobes, "b.hdr"), request(lobes, "a.hdr"),
                                      request(plain, "b.hdr")};
  EXPECT_EQ(orderOfBlock(m_cache, scenes, 0), (Order{2, 0, 1, 3}));
  scenes[2].settings.scene.environmentRotationDeg = 90;
  EXPECT_EQ(orderOfBlock(m_cache, scenes, 0), (Order{0, 1, 3, 2})) << "a turned one is another";
}

TEST_F(SceneWork, AllScenesAreInOneBlockAndTheLastIsWhole) {
  const std::string plain = write("plain.gltf", "{}"), lobes = write("lobes.gltf", R"("KHR_materials_sheen")");
  for (const std::size_t count : {std::size_t{1}, kScenesInBlock, kScenesInBlock + 3, 2 * kScenesInBlock}) {
    std::vector<SceneRequest> scenes(count, request(plain));
    scenes.back() = request(lobes);
    std::size_t begin = 0;
    std::vector<std::size_t> block;
    for (; begin < count; begin += block.size()) {
      block = orderOfBlock(m_cache, scenes, begin);
      ASSERT_FALSE(block.empty());
      EXPECT_EQ(block.front(), begin + block.size() == count ? count - 1 : begin);
      std::ranges::sort(block);
      for (std::size_t i = 0; i < block.size(); ++i) EXPECT_EQ(block[i], begin + i);
    }
    EXPECT_EQ(begin, count);
    EXPECT_EQ(block.size(), std::min(count, kScenesInBlock));
  }
}

TEST_F(SceneWork, SamplesAreThoseOfAllViewsOnAverage) {
  std::vector<SceneRequest> scenes = {request("builtin:room"), request("builtin:room")};
  for (SceneRequest& scene : scenes) scene.settings.width = 100, scene.settings.height = 10;
  EXPECT_EQ(samplesOfAScene(scenes), 1000u);
  scenes[1].views.resize(3);
  EXPECT_EQ(samplesOfAScene(scenes), 2000u);
  scenes[0].settings.samples = 4;
  EXPECT_EQ(samplesOfAScene(scenes), 3500u);
  scenes[1].partOf = {.views = 5}; // of which --only has left three
  EXPECT_EQ(samplesOfAScene(scenes), 4500u);
  EXPECT_EQ(samplesOfAScene({}), 0u);
}

const char* const kEffort = "GALLIVM_PERF";

std::optional<std::string> effort() {
  const char* const value = std::getenv(kEffort);
  return value ? std::optional<std::string>(value) : std::nullopt;
}

void setEffort(const std::optional<std::string>& value) {
  if (value)
    setenv(kEffort, value->c_str(), 1);
  else
    unsetenv(kEffort);
}

// What it is after the choice, if it was `before`.
std::optional<std::string> effortFor(const std::optional<std::string>& before, int width, int height) {
  const std::optional<std::string> ofTester = effort();
  setEffort(before);
  SceneRequest scene = request("builtin:room");
  scene.settings.width = width, scene.settings.height = height;
  chooseCompilerEffort({scene});
  std::optional<std::string> found = effort();
  setEffort(ofTester);
  return found;
}

TEST_F(SceneWork, TheDriverCompilesQuicklyForSmallPictures) {
  EXPECT_EQ(effortFor(std::nullopt, 512, 512), "nopt");
  EXPECT_EQ(effortFor(std::nullopt, 64, 64), "nopt");
  EXPECT_EQ(effortFor(std::nullopt, 512, 513), std::nullopt);
}

TEST_F(SceneWork, WhatTheEnvironmentTellsTheDriverStays) {
  EXPECT_EQ(effortFor("", 64, 64), "");
  EXPECT_EQ(effortFor("no_quad_lod", 64, 64), "no_quad_lod");
}

} // namespace
} // namespace parity::job
