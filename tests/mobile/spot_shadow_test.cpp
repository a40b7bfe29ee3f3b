// The one spot light that casts a shadow on mobile: where similar triangles put it.
#include "support/device.h"
#include "support/small_scenes.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/shadows/shadow_maps.h"
#include "gpu/surface/surface_pass.h"
#include "mobile/presets.h"
#include "mobile/renderer.h"

namespace parity::mobile {
namespace {

constexpr std::uint32_t kSize = 96;

scenes::Light makeSpot(float intensity) {
  scenes::Light light;
  light.kind = scenes::LightKind::spot;
  light.color = glm::vec3(intensity);
  light.position = {0, 0, 3};
  light.direction = {0, 0, -1};
  light.outerConeAngle = glm::radians(50.f);
  light.innerConeAngle = glm::radians(49.f);
  return light;
}

class SpotShadowTest : public tests::DeviceTest {
protected:
  // A floor of 4 m in z = 0 under a square of 1 m in z = 1, seen from between the two.
  std::vector<float> floor(const std::vector<scenes::Light>& lights, Options options, std::uint32_t mapSize = 2048) {
    scenes::Scene scene;
    scene.name = "square";
    scene.meshes = {tests::makeQuad(0), tests::makeQuad(0)};
    scene.materials.resize(1);
    scene.materials[0].metallic = 0;
    scene.materials[0].doubleSided = true;
    scene.instances = {{0, glm::scale(glm::mat4(1.f), glm::vec3(2, 2, 1)), "floor"},
                       {1, glm::scale(tests::translation(0, 0, 1), glm::vec3(0.5f, 0.5f, 1)), "square"}};
    scenes::Camera camera = tests::makeFrontCamera(2, 0.5f, true);
    camera.zNear = 0.1f;
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, kSize, kSize);
    const auto surface = std::move(pass.render(camera, {0, kSize}, glm::vec2(0.5f)).front());
    std::optional<gpu::ShadowMaps> maps;
    if (const auto casting = Renderer::needsShadowMaps(lights, options); !casting.empty()) {
      maps.emplace(device(), buffers, casting, gpu::ShadowOptions{.mapSize = mapSize});
      EXPECT_EQ(maps->mapCount(), 1u);
    }
    Inputs inputs;
    inputs.lights = lights;
    inputs.shadows = maps ? &*maps : nullptr;
    const Renderer renderer(device(), buffers, pass.binKinds(), inputs, options);
    m_notes = renderer.notes();
    const gpu::ShadedSurface shaded = renderer.shade(surface, camera);
    std::vector<float> picture(kSize * kSize);
    for (std::size_t i = 0; i < surface.size(); ++i) picture[surface.pixels[i]] = shaded.color[i].x;
    return picture;
  }
  std::vector<std::string> m_notes;
};

TEST_F(SpotShadowTest, LiesWhereTheSquareHidesTheLight) {
  for (const Precision precision : {Precision::fp16, Precision::fp32}) {
    Options options;
    options.precision = precision;
    const std::vector<float> open = floor({makeSpot(5)}, options);
    options.spotShadow = true;
    const std::vector<float> shadowed = floor({makeSpot(5)}, options);
    int dark = 0, lit = 0;
    for (std::size_t p = 0; p < open.size(); ++p) {
      const float x = std::abs((static_cast<float>(p % kSize) + 0.5f) / kSize * 4 - 2);
      const float y = std::abs((static_cast<float>(p / kSize) + 0.5f) / kSize * 4 - 2);
      const float r = std::max(x, y);
      if (open[p] <= 0) continue;
      if (r < 0.72f) {
        EXPECT_EQ(shadowed[p], 0) << x << " " << y;
        ++dark;
      } else if (r > 0.78f) {
        EXPECT_EQ(shadowed[p], open[p]) << x << " " << y;
        ++lit;
      }
    }
    EXPECT_GT(dark, 800);
    EXPECT_GT(lit, 2000);
  }
}

TEST_F(SpotShadowTest, FadeLetsLightThroughAndSharpenNarrowsTheEdge) {
  constexpr std::uint32_t kCoarse = 64; // texels as wide as two pixels, so that there is an edge to be seen
  Options options = tests::inFp32("ue4-2020");
  const std::vector<float> open = floor({makeSpot(5)}, options, kCoarse);
  options.spotShadow = true;
  const std::vector<float> plain = floor({makeSpot(5)}, options, kCoarse);
  options.spotShadowFade = 0.25f;
  const std::vector<float> faded = floor({makeSpot(5)}, options, kCoarse);
  options.spotShadowFade = 1;
  options.spotShadowSharpen = 8;
  const std::vector<float> sharp = floor({makeSpot(5)}, options, kCoarse);
  int partly = 0, partlySharp = 0;
  for (std::size_t p = 0; p < open.size(); ++p) {
    // lerp(1, S^2, .25), with S^2 from the picture whose fade is 1.
    EXPECT_NEAR(faded[p], open[p] + 0.25f * (plain[p] - open[p]), 1e-5f * open[p]);
    partly += plain[p] > 0.02f * open[p] && plain[p] < 0.98f * open[p];
    partlySharp += sharp[p] > 0.02f * open[p] && sharp[p] < 0.98f * open[p];
  }
  EXPECT_GT(partly, 0);
  EXPECT_LT(partlySharp, partly);
}

TEST_F(SpotShadowTest, OfSeveralSpotsTheBrightestHasOne) {
  Options options;
  options.spotShadow = true;
  const std::size_t middle = kSize * kSize / 2 + kSize / 2;
  const float faint = floor({makeSpot(2)}, Options{})[middle];
  EXPECT_EQ(floor({makeSpot(2), makeSpot(5)}, options)[middle], faint);
  EXPECT_EQ(m_notes,
            (std::vector<std::string>{"1 of 2 spot lights cast no shadow: the path has one that does, the brightest"}));
  options.localLights = false;
  EXPECT_TRUE(Renderer::needsShadowMaps({makeSpot(2)}, options).empty()) << "all are baked";
  EXPECT_EQ(floor({makeSpot(2), makeSpot(5)}, options)[middle], 0);
}

} // namespace
} // namespace parity::mobile
