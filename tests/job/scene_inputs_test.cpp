// Each part of a scene's inputs changes with what it is made of, and with nothing else.
#include "job/scene_inputs.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/temp_folder.h"

namespace parity::job {
namespace {

class SceneInputsTest : public testing::Test {
protected:
  SceneInputsTest() {
    m_request.name = "Hero", m_request.scene = "assets/hero.gltf";
    m_request.views.emplace_back().name = "front";
  }
  report::SceneInputs inputs() const {
    gpu::DeviceReport device;
    device.name = "device";
    return inputsOf(m_request, conditionsOf(m_run, m_request, device), m_sources);
  }
  const base::TempFolder m_folder;
  Settings m_run;
  SceneRequest m_request;
  std::vector<scenes::SourceFile> m_sources = {{"assets/hero.gltf", "1"}, {"assets/hero.bin", "2"}};
};

void expectSameBut(const report::SceneInputs& a, const report::SceneInputs& b, const std::string& part) {
  EXPECT_EQ(a.asset == b.asset, part != "asset") << part;
  EXPECT_EQ(a.environment == b.environment, part != "environment") << part;
  EXPECT_EQ(a.request == b.request, part != "request") << part;
  EXPECT_EQ(a.bake == b.bake, part != "bake") << part;
}

TEST_F(SceneInputsTest, EachPartChangesAlone) {
  const report::SceneInputs first = inputs();
  EXPECT_EQ(first.asset.size(), 32u);
  EXPECT_EQ(first.environment, "");
  EXPECT_EQ(first.bake, "");
  m_sources[1].hash = "3";
  expectSameBut(inputs(), first, "asset");
  m_sources[1].hash = "2";
  m_request.settings.scene.sun.emplace();
  expectSameBut(inputs(), first, "request");
  m_request.settings.scene.sun.reset();
  m_request.views[0].fovYDeg += 1;
  expectSameBut(inputs(), first, "request");
  m_request.views[0].fovYDeg -= 1;
  expectSameBut(inputs(), first, "");
}

TEST_F(SceneInputsTest, FilesCountByTheirContentAndNotByTheirFolder) {
  const std::string file = (m_folder / "sky.hdr").string();
  base::writeText(file, "one");
  m_request.settings.scene.environment = file;
  const report::SceneInputs one = inputs();
  base::writeText(file, "two");
  expectSameBut(inputs(), one, "environment");
  base::writeText(file, "one");
  expectSameBut(inputs(), one, "");
  m_request.scene = "moved/hero.gltf";
  m_sources = {{"moved/hero.gltf", "1"}, {"moved/hero.bin", "2"}};
  expectSameBut(inputs(), one, "");
  std::filesystem::create_directories(m_folder / "baked");
  base::writeText(m_folder / "baked" / "manifest.json", "{}");
  m_request.settings.scene.baked = (m_folder / "baked").string();
  EXPECT_NE(inputs().bake, "");
}

TEST_F(SceneInputsTest, ASceneThatWasNotReadHasNoAssetAndABuiltInOneHasItsName) {
  m_sources.clear();
  EXPECT_EQ(inputs().asset, "");
  m_request.scene = "builtin:spheres";
  const std::string spheres = inputs().asset;
  EXPECT_NE(spheres, "");
  m_request.scene = "builtin:lamps";
  EXPECT_NE(inputs().asset, spheres);
}

} // namespace
} // namespace parity::job
