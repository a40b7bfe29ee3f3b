// Baked light of the high-end path against its formulas in double precision.
#include "support/baked_quads.h"

#include "gpu/shadows/shadow_maps.h"
#include "highend/highend_quad.h"
#include "shading/shading.h"

namespace parity::highend {
namespace {

using shading::Term;
using tests::HostPages;
using tests::ShadedPixel;
namespace f64 = shading::f64;

constexpr float kTexelTolerance = 1e-3f; // texels are fp16
const glm::vec3 kIrradiance(0.5f, 1.25f, 0.0625f), kBase(0.8f, 0.5f, 0.2f);
constexpr glm::vec3 kNoDirection(0);

f64::real3 vec(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

class BakedTest : public tests::DeviceTest {
protected:
  static HostPages lightmapOf(const glm::vec3& irradianceOverPi, const glm::vec3& r) {
    return tests::makeLightmapPages(vk::Format::eR16G16B16A16Sfloat, 4, 1, [&](std::uint32_t, bool lower, auto...) {
      return glm::vec4(lower ? r : irradianceOverPi, 1);
    });
  }
  std::vector<ShadedPixel> shade(const scenes::Scene& scene, const scenes::LightmapUvs* uvs,
                                 const gpu::BakedContent* content, Inputs inputs, const Options& options = kPlain) {
    std::optional<gpu::BakedMaps> maps;
    if (content) maps.emplace(gpu::makeBakedMaps(device(), *content));
    inputs.baked = maps ? &*maps : nullptr;
    inputs.terms = true;
    inputs.compilation.store = &pipelines();
    return tests::shadeQuads(device(), scene, uvs, [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, inputs, options);
    });
  }
  static scenes::Scene makeScene(float metallic = 0) {
    scenes::Scene scene = tests::makeQuadScene();
    scene.materials[0].baseColor = glm::vec4(kBase, 1);
    scene.materials[0].metallic = metallic;
    scene.materials[0].roughness = 0.5f;
    return scene;
  }
};

// The lower half holds a long direction: read together with it, the upper one would be off at the border between them.
TEST_F(BakedTest, ConstantIrradianceGivesItsRadianceUpToTheBordersOfThePage) {
  const HostPages pages = lightmapOf(kIrradiance, {0.9f, 0, 0});
  const gpu::BakedContent content{.lightmap = pages.view()};
  const scenes::LightmapUvs uvs = tests::wholePage();
  for (const float indirectScale : {1.f, 0.5f}) {
    scenes::Scene scene = makeScene();
    scene.lightScales.indirectColorScale = glm::vec3(indirectScale);
    for (const ShadedPixel& pixel :
         shade(scene, &uvs, &content, {.lights = {tests::makeDirectional({0, 0, 1}, glm::vec3(2))}})) {
      tests::expectNear(pixel[Term::lightmap], kIrradiance * kBase * indirectScale, kTexelTolerance, "lightmap");
      EXPECT_GT(pixel[Term::sunDiffuse].x, 0.1f);
      tests::expectNear(pixel.sum(), pixel.color, kTexelTolerance, "sum of the terms");
    }
  }
}

TEST_F(BakedTest, TexelsAreReadBilinearlyAndNeverAcrossTheHalves) {
  constexpr std::uint32_t kTexels = 4;
  const HostPages pages = tests::makeLightmapPages(
      vk::Format::eR16G16B16A16Sfloat, kTexels, 1, [](std::uint32_t, bool lower, std::uint32_t x, std::uint32_t y) {
        return lower ? glm::vec4(0) : glm::vec4(static_cast<float>(x), static_cast<float>(y), 1, 1);
      });
  const gpu::BakedContent content{.lightmap = pages.view()};
  const scenes::LightmapUvs uvs = tests::wholePage();
  scenes::Scene scene = makeScene();
  scene.materials[0].baseColor = glm::vec4(1);
  for (const ShadedPixel& pixel : shade(scene, &uvs, &content, {})) {
    const glm::vec2 uv = glm::vec2(pixel.position) * 0.5f + 0.5f;
    const glm::vec2 texel = glm::clamp(uv * static_cast<float>(kTexels) - 0.5f, 0.f, kTexels - 1.f);
    EXPECT_NEAR(pixel[Term::lightmap].x, texel.x, 0.01f) << uv.x; // filters have 8 bits of fraction
    EXPECT_NEAR(pixel[Term::lightmap].y, texel.y, 0.01f) << uv.y;
    EXPECT_NEAR(pixel[Term::lightmap].z, 1, kTexelTolerance);
  }
}

TEST_F(BakedTest, TheShadingNormalTurnsTowardsTheLightByTheRatio) {
  scenes::Scene scene = makeScene();
  const glm::dvec3 n = tests::leanByNormalMap(scene, 204, 128, 230), N0(0, 0, 1);
  const scenes::LightmapUvs uvs = tests::wholePage();
  for (const glm::vec3 r :
       {glm::vec3(0.5f, 0, 0.5f), glm::vec3(-0.5f, 0.25f, 0.25f), glm::vec3(0, 0, 1), glm::vec3(0.8f, 0, -0.6f)}) {
    const HostPages pages = lightmapOf(kIrradiance, r);
    const gpu::BakedContent content{.lightmap = pages.view()};
    const double ratio = f64::directionalLightmapRatio(vec(glm::dvec3(r)), vec(n), vec(N0));
    for (const ShadedPixel& pixel : shade(scene, &uvs, &content, {}))
      tests::expectNear(pixel[Term::lightmap], kIrradiance * kBase * static_cast<float>(ratio), 2 * kTexelTolerance,
                        "directional lightmap");
    if (r.x > 0)
      EXPECT_GT(ratio, 1.01);
    else
      EXPECT_LT(ratio, 0.99);
  }
}

TEST_F(BakedTest, ABackAsksTheFrontsLightFromBehind) {
  scenes::Scene scene = makeScene();
  scene.instances[0].toWorld[0].x = -1; // half a turn about +Y: baked normal -Z, the back shows +Z
  scene.instances[0].toWorld[2].z = -1;
  const glm::vec3 r(0, 0, -0.5f);
  const HostPages pages = lightmapOf(kIrradiance, r);
  const gpu::BakedContent content{.lightmap = pages.view()};
  const scenes::LightmapUvs uvs = tests::wholePage();
  const double ratio =
      f64::nonlinearIrradiance({0, 0, -0.5}, {0, 0, 1}) / f64::nonlinearIrradiance({0, 0, -0.5}, {0, 0, -1});
  ASSERT_LT(ratio, 0.2);
  for (const ShadedPixel& pixel : shade(scene, &uvs, &content, {}))
    tests::expectNear(pixel[Term::lightmap], kIrradiance * kBase * static_cast<float>(ratio), kTexelTolerance,
                      "the back");
}

TEST_F(BakedTest, ObjectsReadTheirPagesAndThoseWithoutOneLookAsUnbaked) {
  scenes::Scene scene = tests::makeTwoQuads();
  for (scenes::Material& material : scene.materials) {
    material.baseColor = glm::vec4(kBase, 1);
    material.metallic = 0;
  }
  const HostPages pages =
      tests::makeLightmapPages(vk::Format::eR16G16B16A16Sfloat, 4, 2, [](std::uint32_t page, bool lower, auto...) {
        return glm::vec4(lower ? 0.f : 1.f + static_cast<float>(page));
      });
  const HostPages shadow = tests::makeShadowPages(4, 2, [](std::uint32_t page) { return page == 0 ? 51 : 255; });
  const gpu::BakedContent content{.lightmap = pages.view(), .sunShadow = shadow.view()};
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 0.7f);
  const base::Image lut = constantLut(0.5f, 0.1f, 0.5f);
  const Inputs inputs{
      .environment = &environment, .lut = &lut, .lights = {tests::makeDirectional({0, 0, 1}, glm::vec3(2))}};
  const scenes::LightmapUvs both{tests::quadCorners(), {{.page = 1}, {.page = 0}}},
      left{tests::quadCorners(), {{.page = 1}, {.page = -1}}};
  const auto unbaked = shade(scene, nullptr, nullptr, inputs), baked = shade(scene, &both, &content, inputs),
             halfBaked = shade(scene, &left, &content, inputs);
  for (std::size_t i = 0; i < baked.size(); ++i) {
    const bool isLeft = baked[i].instance == 0;
    tests::expectNear(baked[i][Term::lightmap], kBase * (isLeft ? 2.f : 1.f), kTexelTolerance, "page");
    EXPECT_EQ(baked[i][Term::skyDiffuse], glm::vec3(0)) << "it is in the lightmap";
    EXPECT_GT(unbaked[i][Term::skyDiffuse].x, 0.1f);
    tests::expectNear(baked[i][Term::sunDiffuse], unbaked[i][Term::sunDiffuse] * (isLeft ? 1.f : 0.2f), kTexelTolerance,
                      "the sun through the mask, not squared");
    tests::expectNear(baked[i].sum(), baked[i].color, kTexelTolerance, "sum of the terms");
    EXPECT_EQ(halfBaked[i].color, isLeft ? baked[i].color : unbaked[i].color);
  }
}

TEST_F(BakedTest, WhereShadowMapsAreBoundTheBakedShadowIsNotRead) {
  const scenes::Scene scene = makeScene();
  const HostPages shadow = tests::makeShadowPages(4, 1, [](auto) { return 51; });
  const gpu::BakedContent content{.sunShadow = shadow.view()};
  const scenes::LightmapUvs uvs = tests::wholePage();
  const std::vector<scenes::Light> lights = {tests::makeDirectional({0.2f, 0, 1}, glm::vec3(2))};
  const gpu::SceneBuffers buffers(device(), scene);
  gpu::ShadowMaps maps(device(), buffers, lights, {});
  const auto byMap = shade(scene, &uvs, &content, {.lights = lights, .shadows = &maps}),
             byMask = shade(scene, &uvs, &content, {.lights = lights});
  for (std::size_t i = 0; i < byMap.size(); ++i)
    tests::expectNear(byMask[i].color, byMap[i].color * 0.2f, kTexelTolerance, "mask");
}

// A = 0.5, B = 0.1, Eavg = 0.5: what scatters more often takes the lightmap's irradiance, the reflection its captures.
TEST_F(BakedTest, MultipleScatteringTakesItsLightFromTheLightmap) {
  scenes::Scene scene = makeScene(1);
  const HostPages pages = lightmapOf(kIrradiance, kNoDirection);
  const gpu::BakedContent content{.lightmap = pages.view()};
  const scenes::LightmapUvs uvs = tests::wholePage();
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 2);
  const base::Image lut = constantLut(0.5f, 0.1f, 0.5f);
  Options options = kPlain;
  options.compensation = Compensation::kullaConty;
  for (const bool hasSky : {true, false}) {
    const Inputs inputs{.environment = hasSky ? &environment : nullptr, .lut = &lut};
    for (const ShadedPixel& pixel : shade(scene, &uvs, &content, inputs, options)) {
      EXPECT_EQ(pixel[Term::lightmap], glm::vec3(0)) << "a metal has no diffuse lobe";
      for (int k = 0; k < 3; ++k) {
        const float F0 = kBase[k], Favg = F0 + (1 - F0) / 21, single = F0 * 0.5f + 0.1f;
        const float multiple = Favg * Favg * 0.5f * 0.4f / (1 - Favg * 0.5f);
        EXPECT_NEAR(pixel[Term::skySpecular][k], (hasSky ? 2 * single : 0) + kIrradiance[k] * multiple, 1e-4f);
      }
    }
  }
}

// A capture whose six faces have colours of their own, in a box that is far wider than high.
TEST_F(BakedTest, CaptureShowsTheWallThatTheReflectionHits) {
  const glm::vec3 colors[6] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}};
  const gpu::EnvironmentMaps environment = tests::makeCubes(
      device(), 1, shading::f32::kPrefilterLayers, [&](std::uint32_t, std::uint32_t face) { return colors[face]; });
  const glm::vec3 origin(0.0625f, 0.03125f, 0.0625f), lower(-2, -2, -1),
      upper(2, 2, 0.515625f); // no pixel's direction on an edge of the cube
  const base::Image lut = constantLut(0.5f, 0.1f, 0.5f);
  const float single = 0.04f * 0.5f + 0.1f;
  for (const bool isInside : {true, false})
    for (const OffSpecular offSpecular : {OffSpecular::none, OffSpecular::dominant, OffSpecular::twoTaps}) {
      const gpu::GpuCapture capture{glm::vec4(origin, 4), glm::vec4(isInside ? lower : lower + 10.f, 1),
                                    glm::vec4(isInside ? upper : upper + 10.f, 0)};
      const gpu::BakedContent content{.captures = {&capture, 1}};
      Options options = kPlain;
      options.offSpecular = offSpecular;
      std::array<int, 6> seen{};
      for (const ShadedPixel& pixel :
           shade(makeScene(), nullptr, &content, {.environment = &environment, .lut = &lut}, options)) {
        // N = V = R = +Z: every tap looks straight up, at a place of the ceiling.
        const glm::dvec3 wall(pixel.position.x, pixel.position.y, upper.z);
        const std::uint32_t face = isInside ? tests::faceOf(wall - glm::dvec3(origin)) : 4;
        ++seen[face];
        tests::expectNear(pixel[Term::skySpecular], colors[face] * single, kTexelTolerance, "face");
      }
      EXPECT_EQ(std::ranges::count_if(seen, [](int n) { return n > 0; }), isInside ? 5 : 1);
    }
}

TEST_F(BakedTest, CapturesAreBlendedByDistanceAndBeyondTheirRadiusTheNearestIsTaken) {
  const glm::vec3 radiance[2] = {glm::vec3(1, 0, 0.5f), glm::vec3(0, 3, 0.5f)};
  const gpu::EnvironmentMaps environment = tests::makeCubes(device(), 2, shading::f32::kPrefilterLayers,
                                                            [&](std::uint32_t cube, auto) { return radiance[cube]; });
  const base::Image lut = constantLut(0.5f, 0.1f, 0.5f);
  const float single = 0.04f * 0.5f + 0.1f;
  for (const float radius : {4.f, 0.5f}) {
    const gpu::GpuCapture captures[2] = {{{-0.9f, 0, 0.1f, radius}, glm::vec4(-9, -9, -9, 1), glm::vec4(9)},
                                         {{0.7f, 0.1f, 0.2f, radius}, glm::vec4(-9, -9, -9, 1), glm::vec4(9)}};
    const gpu::BakedContent content{.captures = captures};
    int alone = 0;
    for (const ShadedPixel& pixel : shade(makeScene(), nullptr, &content, {.environment = &environment, .lut = &lut})) {
      double weights[2], distances[2];
      for (int k = 0; k < 2; ++k) {
        distances[k] = glm::distance(glm::dvec3(pixel.position), glm::dvec3(glm::vec3(captures[k].position)));
        weights[k] = f64::captureWeight(distances[k], radius);
      }
      if (weights[0] + weights[1] == 0) {
        weights[distances[1] < distances[0]] = 1;
        ++alone;
      }
      const glm::vec3 blended =
          (radiance[0] * static_cast<float>(weights[0]) + radiance[1] * static_cast<float>(weights[1])) /
          static_cast<float>(weights[0] + weights[1]);
      tests::expectNear(pixel[Term::skySpecular], blended * single, kTexelTolerance, "blend");
    }
    EXPECT_EQ(alone > 0, radius < 1) << "the radius is reached in one of both";
  }
}

TEST_F(BakedTest, CaptureFollowsTheLightmapByTheMixingWeight) {
  const HostPages pages = lightmapOf(kIrradiance, kNoDirection);
  const gpu::EnvironmentMaps environment =
      tests::makeCubes(device(), 1, shading::f32::kPrefilterLayers, [](auto...) { return glm::vec3(0.5f, 1, 2); });
  const gpu::GpuCapture capture{{0, 0, 1, 9}, glm::vec4(-9, -9, -9, 1.5f), glm::vec4(9)};
  const base::Image lut = constantLut(0.5f, 0.1f, 0.5f);
  const double irradiance = f64::luminanceUE4(vec(glm::dvec3(kIrradiance)));
  const scenes::LightmapUvs uvs = tests::wholePage(), none{{}, {{.page = -1}}};
  for (const float roughness : {0.f, 0.15f, 0.2f, 0.4f, 1.f}) {
    scenes::Scene scene = makeScene();
    scene.materials[0].roughness = roughness;
    const gpu::BakedContent content{.lightmap = pages.view(), .captures = {&capture, 1}};
    const Inputs inputs{.environment = &environment, .lut = &lut};
    const glm::vec3 reflected = glm::vec3(0.5f, 1, 2) * (0.04f * 0.5f + 0.1f);
    const double x = std::clamp((roughness - 0.1) / 0.2, 0.0, 1.0), s = x * x * (3 - 2 * x),
                 scale = 1 - s + s * irradiance / 1.5;
    tests::expectNear(shade(scene, &uvs, &content, inputs)[0][Term::skySpecular], reflected * static_cast<float>(scale),
                      kTexelTolerance, "with a lightmap");
    tests::expectNear(shade(scene, &none, &content, inputs)[0][Term::skySpecular], reflected, kTexelTolerance,
                      "without");
  }
}

} // namespace
} // namespace parity::highend
