// The program that takes the knobs as data shows what the one that is specialised to them shows, bit for bit, and is
// compiled once.
#include <cmath>
#include <random>

#include "support/baked_quads.h"

#include "gpu/device/pipeline.h"
#include "mobile/presets.h"
#include "mobile/renderer.h"
#include "scenes/builtin/builtin.h"
#include "scenes/view.h"

namespace parity::mobile {
namespace {

using MobileWideTest = tests::DeviceTest;

template <typename Enum> Enum oneOf(std::mt19937& random, int count) {
  return static_cast<Enum>(std::uniform_int_distribution(0, count - 1)(random));
}

// A set of knobs that a user may choose.
Options randomOptions(std::mt19937& random) {
  Options o = presetByName(presetNames()[std::uniform_int_distribution<std::size_t>(0, 2)(random)]);
  if (o.environmentBrdf != EnvironmentBrdf::refit) {
    o.environmentBrdf = oneOf<EnvironmentBrdf>(random, 2);
    o.directLobe = oneOf<DirectLobe>(random, 2);
  }
  o.captureScale = oneOf<CaptureScale>(random, 5);
  o.capture = oneOf<CaptureEncoding>(random, 3);
  o.sky = oneOf<SkyForm>(random, 3);
  o.coat = oneOf<CoatForm>(random, 3);
  o.sheen = oneOf<SheenForm>(random, 2);
  o.anisotropy = oneOf<AnisotropyForm>(random, 2);
  o.iridescence = oneOf<IridescenceForm>(random, 2);
  o.transmission = oneOf<TransmissionForm>(random, 4);
  o.diffuseTransmission = oneOf<DiffuseTransmissionForm>(random, 2);
  o.localLights = oneOf<bool>(random, 2);
  o.fullyRough = oneOf<int>(random, 5) == 0;
  o.nonmetal = oneOf<int>(random, 3) == 0;
  o.precision = oneOf<Precision>(random, 2);
  return o;
}

TEST_F(MobileWideTest, ShowsWhatTheSpecialisedProgramShowsWhateverTheKnobs) {
  constexpr std::uint32_t kWidth = 40, kHeight = 30;
  std::mt19937 random(7);
  gpu::PipelineStore store;
  for (const char* name : {"lobes", "lights"}) {
    scenes::Scene scene = scenes::makeBuiltinScene(name);
    scene.fog = scenes::Fog{.density = 0.02f, .heightFalloff = 0.1f, .color = {0.5f, 0.7f, 1}};
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, kWidth, kHeight);
    const scenes::Camera camera = scenes::makeCamera(scene, {}, float{kWidth} / kHeight);
    const std::vector<gpu::Surface> layers = pass.render(camera, {0, kHeight}, glm::vec2(0.5f));
    std::vector<scenes::Light> lights = scene.lights;
    lights.push_back(tests::makeDirectional({1, 1, 1}, glm::vec3(1)));
    const gpu::EnvironmentMaps sky = tests::makeRedTowardsX(device());
    for (int k = 0; k < 5; ++k) {
      Options options = randomOptions(random);
      options.lightCap = k % 2 == 0; // both of them, whatever is drawn
      options.localLights |= !options.lightCap;
      options.pixelFog = k % 3 != 0;
      Inputs inputs{.environment = k % 3 == 2 ? nullptr : &sky, .lights = lights};
      const Renderer specialised(device(), buffers, pass.binKinds(), inputs, options);
      inputs.wide = true;
      inputs.compilation = {{.own = 1}, &store};
      const Renderer wide(device(), buffers, pass.binKinds(), inputs, options);
      for (const gpu::Surface& layer : layers) {
        const gpu::ShadedPlane a = specialised.shade(layer, camera).color, b = wide.shade(layer, camera).color;
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
          for (int c = 0; c < 4; ++c)
            if (std::isfinite(a[i][c]) || std::isfinite(b[i][c])) {
              ASSERT_EQ(a[i][c], b[i][c]) << name << ", set " << k << ", entry " << i;
            }
      }
      EXPECT_EQ(wide.pass().compiled().size(), 1u);
    }
  }
  // A program for each scene's textures, vertex data and precision, whatever else the options say.
  EXPECT_LE(store.keys().size(), 4u);
}

TEST_F(MobileWideTest, ReadsEitherFormOfTheLightmapAsTheSpecialisedProgramDoes) {
  const auto texelOf = [](std::uint32_t, bool lower, std::uint32_t x, std::uint32_t y) {
    return lower ? glm::vec4(0.5f, 0.25f, 0.625f, 0.5f)
                 : glm::vec4(0.25f + 0.125f * static_cast<float>(x), 0.5f, 0.125f * static_cast<float>(y), 1);
  };
  const gpu::GpuLightmapScales scales{
      {0.5f, 0.55f, 0.45f, 0}, {0.125f, 0.1f, 0.05f, 0}, {2, 2, 2, 0}, {-1, -1, -1, 0.282095f}};
  const scenes::LightmapUvs uvs = tests::wholePage();
  scenes::Scene scene = tests::makeQuadScene();
  scene.materials[0].metallic = 0.25f;
  tests::leanByNormalMap(scene, 204, 150, 230);
  std::vector<glm::vec3> ofForm[2];
  for (const auto form : {LightmapForm::lq, LightmapForm::hq})
    for (const auto precision : {Precision::fp32, Precision::fp16}) {
      const tests::HostPages pages = tests::makeLightmapPages(
          form == LightmapForm::hq ? vk::Format::eR16G16B16A16Sfloat : vk::Format::eR8G8B8A8Unorm, 4, 1, texelOf);
      const gpu::BakedMaps maps = gpu::makeBakedMaps(device(), {.lightmap = pages.view(), .scales = {&scales, 1}});
      Options options = presetByName("ue4-2020");
      options.precision = precision;
      options.lightmap = form;
      const auto shade = [&](bool wide) {
        return tests::shadeQuads(device(), scene, &uvs, [&](const auto& buffers, const auto& kinds) {
          return Renderer(device(), buffers, kinds, {.baked = &maps, .terms = true, .wide = wide}, options);
        });
      };
      const std::vector<tests::ShadedPixel> a = shade(false), b = shade(true);
      for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_GT(a[i].color.y, 0);
        EXPECT_EQ(a[i].color, b[i].color);
        EXPECT_EQ(a[i].terms, b[i].terms);
        ofForm[form == LightmapForm::hq].push_back(a[i].color);
      }
    }
  EXPECT_NE(ofForm[0], ofForm[1]);
}

} // namespace
} // namespace parity::mobile
