// Material AO other than 1 in both paths: which light it takes from, and how much.
#include "support/baked_quads.h"

#include "highend/renderer.h"
#include "mobile/presets.h"
#include "mobile/renderer.h"
#include "shading/shading.h"

namespace parity::mobile {
namespace {

using shading::Term;
using tests::ShadedPixel;
namespace f64 = shading::f64;

// A texel of 102/255 in a strength of .75: 1 + .75 (.4 - 1).
constexpr float kOcclusion = 0.55f;
constexpr float kSky = 0.7f; // radiance from everywhere
const glm::vec3 kOccludedBase(0.8f, 0.5f, 0.2f);
constexpr float kOccludedMetallic = 0.25f, kOccludedRoughness = 0.5f;

class OcclusionTest : public tests::DeviceTest {
protected:
  static scenes::Scene makeScene(bool occluded) {
    scenes::Scene scene = tests::makeQuadScene();
    scenes::Material& material = scene.materials[0];
    material.baseColor = glm::vec4(kOccludedBase, 1);
    material.metallic = kOccludedMetallic;
    material.roughness = kOccludedRoughness;
    material.emissive = {0.1f, 0.2f, 0.3f};
    if (!occluded) return scene;
    scene.images = {{"occlusion", base::Image8(1, 1, 4, 102)}};
    material.occlusionTexture.image = 0;
    material.occlusionStrength = 0.75f;
    return scene;
  }
  static std::vector<scenes::Light> makeLights() {
    scenes::Light lamp;
    lamp.position = {0, 0, 1.5f};
    return {tests::makeDirectional({0.2f, 0.3f, 1}, glm::vec3(2)), lamp};
  }
  // F0 A + B of the high-end path's table: the same for all cosines.
  static constexpr float kA = 0.5f, kB = 0.1f;
  ShadedPixel shadeHighend(bool occluded, const scenes::LightmapUvs* uvs = nullptr,
                           const gpu::BakedMaps* baked = nullptr) {
    const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), kSky);
    base::Image lut(2, 2, 4);
    for (int i = 0; i < 4; ++i) std::copy_n(std::array{kA, kB, kA + kB, 1.f}.data(), 4, lut.pixels.data() + 4 * i);
    const highend::Options plain{.model = {.diffuse = highend::DiffuseLobe::lambert},
                                 .compensation = highend::Compensation::none,
                                 .offSpecular = highend::OffSpecular::none};
    const highend::Inputs inputs{
        .environment = &environment, .lut = &lut, .lights = makeLights(), .baked = baked, .terms = true};
    return tests::shadeQuads(device(), makeScene(occluded), uvs, [&](const auto& buffers, const auto& kinds) {
      return highend::Renderer(device(), buffers, kinds, inputs, plain);
    })[0];
  }
  ShadedPixel shadeMobile(const Options& options, bool occluded, const scenes::LightmapUvs* uvs = nullptr,
                          const gpu::BakedMaps* baked = nullptr) {
    const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), kSky);
    const Inputs inputs{.environment = &environment, .lights = makeLights(), .baked = baked, .terms = true};
    return tests::shadeQuads(device(), makeScene(occluded), uvs, [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, inputs, options);
    })[0];
  }
  static void expectLightsAreTheSame(const ShadedPixel& occluded, const ShadedPixel& open, bool hasLocalLights) {
    for (const Term term :
         {Term::sunDiffuse, Term::sunSpecular, Term::localDiffuse, Term::localSpecular, Term::emissive}) {
      if (hasLocalLights || (term != Term::localDiffuse && term != Term::localSpecular)) {
        EXPECT_GT(open[term].x, 0) << static_cast<int>(term);
      }
      EXPECT_EQ(occluded[term], open[term]) << static_cast<int>(term);
    }
  }
  static glm::vec3 specularColor() {
    return glm::vec3(0.04f * (1 - kOccludedMetallic)) + kOccludedBase * kOccludedMetallic;
  }
};

TEST_F(OcclusionTest, HighendTakesItFromTheEnvironmentDiffuseAndSpecular) {
  const ShadedPixel occluded = shadeHighend(true), open = shadeHighend(false);
  const glm::vec3 diffuse = kSky * kOccludedBase * (1 - kOccludedMetallic),
                  specular = kSky * (specularColor() * kA + kB);
  tests::expectNear(open[Term::skyDiffuse], diffuse, 1e-4f, "open, diffuse");
  tests::expectNear(occluded[Term::skyDiffuse], kOcclusion * diffuse, 1e-4f, "diffuse");
  tests::expectNear(occluded[Term::skySpecular], kOcclusion * specular, 1e-4f, "specular");
  expectLightsAreTheSame(occluded, open, true);
  tests::expectNear(occluded.sum(), occluded.color, 1e-3f, "sum of the terms");
}

// Seed 002: Color *= MaterialAO before the lights are added; the sky light times MaterialAO; IndirectIrradiance *=
// MaterialAO, which the reflection reads where a weight scales it.
TEST_F(OcclusionTest, MobileTakesItFromTheSkyLightAndFromTheReflectionAsItsScaleSays) {
  struct Case {
    const char* preset;
    CaptureScale scale;
    float ofReflection; // what of it is left
  };
  const Case cases[] = {{"ue4-2020", CaptureScale::automatic, 1}, // the skylight's cube: no occlusion
                        {"ue4-2020", CaptureScale::sky, 1},
                        {"ue4-2020", CaptureScale::mixing, kOcclusion}, // rougher than .3: the whole weight
                        {"ue4-2020", CaptureScale::full, kOcclusion},
                        {"ue4-2020", CaptureScale::occlusion, kOcclusion},
                        {"karis2014", CaptureScale::full, kOcclusion},
                        {"refit", CaptureScale::occlusion, kOcclusion}};
  for (const Case& c : cases)
    for (const Precision precision : {Precision::fp32, Precision::fp16}) {
      if (precision == Precision::fp16 && !device().report().float16) continue;
      const float tolerance = precision == Precision::fp16 ? 5e-3f : 1e-3f;
      Options options = tests::inFp32(c.preset);
      options.precision = precision;
      options.captureScale = c.scale;
      const ShadedPixel occluded = shadeMobile(options, true), open = shadeMobile(options, false);
      if (options.environmentBrdf != EnvironmentBrdf::refit) { // whose own albedos are held in tests/shading
        const f64::real3 F0(specularColor().x, specularColor().y, specularColor().z);
        const f64::real3 E = f64::EnvBRDFApproxUE4(F0, kOccludedRoughness, 1);
        const glm::vec3 diffuse = kSky * kOccludedBase * (1 - kOccludedMetallic),
                        specular = kSky * glm::vec3(E.x, E.y, E.z);
        tests::expectNear(occluded[Term::skyDiffuse], kOcclusion * diffuse, tolerance, c.preset);
        tests::expectNear(occluded[Term::skySpecular], c.ofReflection * specular, tolerance, c.preset);
      }
      tests::expectNear(occluded[Term::skyDiffuse], kOcclusion * open[Term::skyDiffuse], tolerance, c.preset);
      tests::expectNear(occluded[Term::skySpecular], c.ofReflection * open[Term::skySpecular], tolerance, c.preset);
      expectLightsAreTheSame(occluded, open, options.localLights);
      tests::expectNear(occluded.sum(), occluded.color, 2 * tolerance, "sum of the terms");
    }
}

TEST_F(OcclusionTest, BothTakeItFromTheLightmapAndMobileFromTheMixingWeight) {
  const scenes::LightmapUvs uvs = tests::wholePage();
  const auto texelOf = [](std::uint32_t, bool lower, auto...) { return lower ? glm::vec4(0.5f) : glm::vec4(0.6f); };
  const tests::HostPages floats = tests::makeLightmapPages(vk::Format::eR16G16B16A16Sfloat, 4, 1, texelOf),
                         bytes = tests::makeLightmapPages(vk::Format::eR8G8B8A8Unorm, 4, 1, texelOf);
  const gpu::GpuLightmapScales scales{
      {0.5f, 0.55f, 0.45f, 0}, {0.125f, 0.1f, 0.05f, 0}, {2, 2, 2, 0}, {-1, -1, -1, 0.282095f}};
  const gpu::GpuCapture capture{{0, 0, 1, 9}, glm::vec4(-9, -9, -9, kSky), glm::vec4(9)};
  const gpu::BakedMaps highend = gpu::makeBakedMaps(device(), {.lightmap = floats.view()});
  const ShadedPixel ofHighend = shadeHighend(true, &uvs, &highend), openHighend = shadeHighend(false, &uvs, &highend);
  EXPECT_GT(openHighend[Term::lightmap].x, 0.05f);
  tests::expectNear(ofHighend[Term::lightmap], kOcclusion * openHighend[Term::lightmap], 1e-4f, "highend");

  const gpu::BakedMaps mobile =
      gpu::makeBakedMaps(device(), {.lightmap = bytes.view(), .scales = {&scales, 1}, .captures = {&capture, 1}});
  const Options options = tests::inFp32("ue4-2020");
  const ShadedPixel occluded = shadeMobile(options, true, &uvs, &mobile),
                    open = shadeMobile(options, false, &uvs, &mobile);
  EXPECT_GT(open[Term::lightmap].x, 0.005f);
  tests::expectNear(occluded[Term::lightmap], kOcclusion * open[Term::lightmap], 1e-4f, "mobile");
  EXPECT_GT(open[Term::skySpecular].x, 1e-3f);
  tests::expectNear(occluded[Term::skySpecular], kOcclusion * open[Term::skySpecular], 1e-4f, "mixing weight");
}

} // namespace
} // namespace parity::mobile
