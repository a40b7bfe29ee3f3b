// Shadow maps against rays: mean absolute error of visibility outside of a band of 2 texels about the edges <= 0.002.
#include "study/shadows/shadow_error.h"

#include "support/device.h"

#include <filesystem>

#include <fmt/format.h>

#include "scenes/load.h"
#include "scenes/view.h"
#include "support/shared_assets.h"

namespace parity::shadows {
namespace {

constexpr double kMost = 0.002;

scenes::Light sun(float azimuth, float elevation) {
  return scenes::makeSun({.azimuthDeg = azimuth, .elevationDeg = elevation, .lux = 3});
}

class ShadowErrorTest : public tests::DeviceTest {
protected:
  void expectSmall(const scenes::Scene& scene, const scenes::Light& light, const scenes::ViewRequest& view = {}) {
    SCOPED_TRACE(fmt::format("{}, {}", scene.name, light.name));
    const scenes::Camera camera = scenes::makeCamera(scene, view, 1);
    const VisibilityError error =
        measureVisibility(device(), {.scene = scene, .camera = camera, .width = 256, .height = 256}, light);
    EXPECT_LE(error.outsideMean, kMost);
    EXPECT_LE(error.insideMean, 0.3);
    m_outside += error.outside;
    m_inside += error.inside;
    for (std::size_t i = 0; i < error.exact.size(); ++i) m_dark += error.exact[i] == 0 && error.map[i] == 0;
  }
  std::size_t m_outside = 0, m_inside = 0, m_dark = 0;
};

TEST_F(ShadowErrorTest, IsSmallInTheShippedScenes) {
  for (const char* name : {"builtin:shadows", "builtin:lamps", "builtin:materials"}) {
    const scenes::Scene scene = scenes::loadScene(name, {});
    for (const scenes::Light& light : scene.lights) expectSmall(scene, light);
    for (const float elevation : {8.f, 30.f, 75.f}) expectSmall(scene, sun(50, elevation));
  }
  EXPECT_GT(m_outside, 300'000u);
  EXPECT_GT(m_inside, 10'000u);
}

TEST_F(ShadowErrorTest, IsSmallInRealAssets) {
  const std::filesystem::path assets = tests::sharedAssets();
  if (assets.empty()) GTEST_SKIP() << "no shared assets";
  for (const char* file : {"ToyCar/ToyCar.gltf", "LightsPunctualLamp/LightsPunctualLamp.gltf", "Suzanne/Suzanne.gltf",
                           "AlphaBlendModeTest/AlphaBlendModeTest.glb"}) {
    const scenes::Scene scene = scenes::loadScene((assets / file).string(), {});
    for (const scenes::Light& light : scene.lights) expectSmall(scene, light);
    expectSmall(scene, sun(40, 50));
    expectSmall(scene, sun(-60, 25));
  }
  EXPECT_GT(m_outside, 50'000u);
}

// Many maps in few layers, those of local lights shrunk; and the other filters whose reach is within the band.
TEST_F(ShadowErrorTest, IsSmallWhereMapsShareTheImage) {
  const scenes::Scene scene = scenes::loadScene("builtin:lamps", {});
  const scenes::Camera camera = scenes::makeCamera(scene, {}, 1);
  for (const std::uint32_t filter : {0u, 1u, 3u})
    for (std::size_t k = 0; k < scene.lights.size(); k += 3) {
      SCOPED_TRACE(fmt::format("light {}, filter {}", k, filter));
      const VisibilityError error =
          measureVisibility(device(),
                            {.scene = scene,
                             .camera = camera,
                             .width = 200,
                             .height = 200,
                             .options = {.mapSize = 1024, .filter = filter, .maxBytes = 8 << 20},
                             .others = scene.lights},
                            scene.lights[k]);
      EXPECT_LE(error.outsideMean, kMost);
      EXPECT_GT(error.outside, 4000u);
    }
}

// A map that is drawn wrong is found: as the measure itself is to be trusted.
TEST_F(ShadowErrorTest, FindsAMapThatIsTooCoarseForItsFilter) {
  const scenes::Scene scene = scenes::loadScene("builtin:lamps", {});
  const scenes::Camera camera = scenes::makeCamera(scene, {}, 1);
  const VisibilityError fine =
      measureVisibility(device(), {.scene = scene, .camera = camera, .width = 128, .height = 128}, sun(50, 30));
  const VisibilityError coarse = measureVisibility(
      device(),
      {.scene = scene, .camera = camera, .width = 128, .height = 128, .options = {.mapSize = 64, .filter = 7}},
      sun(50, 30));
  EXPECT_GT(coarse.inside, 3 * fine.inside) << "the band is of texels";
  EXPECT_GT(coarse.outsideMean, 5 * fine.outsideMean) << "a filter that reaches 4 texels";
}

} // namespace
} // namespace parity::shadows
