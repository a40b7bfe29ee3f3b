// Baked light of the mobile path: the base pass's order, with the formulas of shading/ on the CPU at equal precision.
#include <numbers>
#include <set>

#include "support/baked_quads.h"

#include "gpu/spirv/spirv_cost.h"
#include "mobile/presets.h"
#include "mobile/renderer.h"
#include "shading/shading.h"

namespace parity::mobile {
namespace {

using shading::Term;
using tests::HostPages;
using tests::ShadedPixel;
namespace f64 = shading::f64;
namespace f16 = shading::f16;

using std::numbers::pi;
const glm::vec3 kBakedBase(0.8f, 0.5f, 0.2f);
const glm::vec4 kLog(160, 140, 120, 255), kSh(150, 140, 200, 110); // codes of both halves
// What brings the lower codes to -1..1 and the last to S(N)'s constant, as a baker's would.
const gpu::GpuLightmapScales kScales{
    {0.5f, 0.55f, 0.45f, 0}, {0.125f, 0.1f, 0.05f, 0}, {2, 2, 2, 0}, {-1, -1, -1, 0.282095f}};

// GetLightMapColorLQ on the CPU: irradiance over pi, and Luma.
glm::dvec4 readOnCpu(bool half, const glm::vec4& log, const glm::vec4& sh, const gpu::GpuLightmapScales& s,
                     const glm::dvec3& N) {
  if (half) {
    const auto h = [](float code) { return shading::Half(code / 255); };
    const f16::LightmapScales scales{{s.scale0.x, s.scale0.y, s.scale0.z}, {s.add0.x, s.add0.y, s.add0.z},
                                     {s.scale1.x, s.scale1.y, s.scale1.z}, s.scale1.w,
                                     {s.add1.x, s.add1.y, s.add1.z},       s.add1.w};
    const f16::real4 read =
        f16::GetLightMapColorLQ({h(log.x), h(log.y), h(log.z)}, {h(sh.x), h(sh.y), h(sh.z), h(sh.w)}, scales,
                                {static_cast<float>(N.x), static_cast<float>(N.y), static_cast<float>(N.z)});
    return {float(read.x), float(read.y), float(read.z), float(read.w)};
  }
  const f64::LightmapScales scales{{s.scale0.x, s.scale0.y, s.scale0.z}, {s.add0.x, s.add0.y, s.add0.z},
                                   {s.scale1.x, s.scale1.y, s.scale1.z}, s.scale1.w,
                                   {s.add1.x, s.add1.y, s.add1.z},       s.add1.w};
  const glm::dvec4 l = glm::dvec4(log) / 255.0, d = glm::dvec4(sh) / 255.0;
  const f64::real4 read = f64::GetLightMapColorLQ({l.x, l.y, l.z}, {d.x, d.y, d.z, d.w}, scales, {N.x, N.y, N.z});
  return {read.x, read.y, read.z, read.w};
}

class BakedTest : public tests::DeviceTest {
protected:
  static HostPages lightmapOf(const glm::vec4& log, const glm::vec4& sh) {
    return tests::makeLightmapPages(vk::Format::eR8G8B8A8Unorm, 4, 1,
                                    [&](std::uint32_t, bool lower, auto...) { return (lower ? sh : log) / 255.f; });
  }
  std::vector<ShadedPixel> shade(const scenes::Scene& scene, const scenes::LightmapUvs* uvs,
                                 const gpu::BakedContent* content, Inputs inputs, const Options& options) {
    std::optional<gpu::BakedMaps> maps;
    if (content) maps.emplace(gpu::makeBakedMaps(device(), *content));
    inputs.baked = maps ? &*maps : nullptr;
    inputs.terms = inputs.view == kViewLit;
    inputs.compilation.store = &pipelines();
    return tests::shadeQuads(device(), scene, uvs, [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, inputs, options);
    });
  }
  // Presets in both precisions, as far as the device has them; relative errors: fp32's, half's.
  struct Setting {
    Options options;
    bool half = false;
    float tolerance = 1e-3f;
  };
  std::vector<Setting> settings() const {
    std::vector<Setting> all;
    for (const char* preset : {"karis2014", "ue4-2020", "refit"})
      for (const bool half : {false, true}) {
        if (half && !device().report().float16) continue;
        Options options = tests::inFp32(preset);
        if (half) options.precision = Precision::fp16;
        all.push_back({options, half, half ? 4e-3f : 1e-3f});
      }
    return all;
  }
  static scenes::Scene makeScene(float metallic = 0.25f) {
    scenes::Scene scene = tests::makeQuadScene();
    scene.materials[0].baseColor = glm::vec4(kBakedBase, 1);
    scene.materials[0].metallic = metallic;
    scene.materials[0].roughness = 0.5f;
    return scene;
  }
};

TEST_F(BakedTest, LightmapGivesItsRadianceInEachPresetUpToTheBordersOfThePage) {
  const HostPages pages = lightmapOf(kLog, kSh);
  const scenes::LightmapUvs uvs = tests::wholePage();
  const gpu::BakedContent content{.lightmap = pages.view(), .scales = {&kScales, 1}};
  for (const Setting& setting : settings()) {
    scenes::Scene scene = makeScene();
    scene.lightScales.indirectColorScale = {0.5f, 1, 0.75f};
    const glm::dvec4 read = readOnCpu(setting.half, kLog, kSh, kScales, {0, 0, 1});
    ASSERT_GT(read.y, 0.01);
    const bool isRefit = setting.options.preset == "refit"; // whose specular lobe takes its share off
    const f64::MobileShadingModelContext context =
        f64::initShadingModelContext(isRefit ? f64::kEnvironmentBrdfRefit : f64::kEnvironmentBrdfUE4, false, false,
                                     {{kBakedBase.x, kBakedBase.y, kBakedBase.z}, 0.25, {0.04, 0.04, 0.04}, 1, 0.5}, 1);
    const f64::real3 diffuse = context.DiffuseColor, multiple = context.lobe.multiple;
    const glm::vec3 light = glm::vec3(read) * scene.lightScales.indirectColorScale;
    for (const ShadedPixel& pixel :
         shade(scene, &uvs, &content, {.lights = {tests::makeDirectional({0, 0, 1}, glm::vec3(2))}}, setting.options)) {
      tests::expectNear(pixel[Term::lightmap], light * glm::vec3(diffuse.x, diffuse.y, diffuse.z), setting.tolerance,
                        "lightmap");
      tests::expectNear(pixel[Term::skySpecular],
                        isRefit ? light * glm::vec3(multiple.x, multiple.y, multiple.z) : glm::vec3(0),
                        3 * setting.tolerance, "what scatters more than once");
      tests::expectNear(pixel.sum(), pixel.color, setting.tolerance, "sum of the terms");
    }
  }
}

TEST_F(BakedTest, TheShadingNormalIsReadInTheOrderOfTheSource) {
  scenes::Scene scene = makeScene(0);
  const glm::dvec3 n = tests::leanByNormalMap(scene, 204, 150, 230);
  const scenes::LightmapUvs uvs = tests::wholePage();
  const HostPages pages = lightmapOf(kLog, kSh);
  const gpu::BakedContent content{.lightmap = pages.view(), .scales = {&kScales, 1}};
  const Options options = tests::inFp32("ue4-2020");
  const glm::dvec4 leaning = readOnCpu(false, kLog, kSh, kScales, n),
                   flat = readOnCpu(false, kLog, kSh, kScales, {0, 0, 1});
  ASSERT_GT(std::abs(leaning.w - flat.w), 0.1 * flat.w);
  for (const ShadedPixel& pixel : shade(scene, &uvs, &content, {}, options))
    tests::expectNear(pixel[Term::lightmap], glm::vec3(leaning) * kBakedBase, 1e-3f, "directional lightmap");
}

// Scales, adds and pages of two objects; one without a lightmap looks as without bake.
TEST_F(BakedTest, ObjectsReadTheirPagesAndScalesAndThoseWithoutALightmapLookAsUnbaked) {
  scenes::Scene scene = tests::makeTwoQuads();
  for (scenes::Material& material : scene.materials) {
    material.baseColor = glm::vec4(kBakedBase, 1);
    material.metallic = 0;
  }
  const glm::vec4 logs[2] = {kLog, {90, 180, 30, 255}};
  const HostPages pages =
      tests::makeLightmapPages(vk::Format::eR8G8B8A8Unorm, 4, 2, [&](std::uint32_t page, bool lower, auto...) {
        return (lower ? kSh : logs[page]) / 255.f;
      });
  const HostPages shadow = tests::makeShadowPages(4, 2, [](std::uint32_t page) { return page == 0 ? 140 : 255; });
  gpu::GpuLightmapScales scales[2] = {kScales, kScales};
  scales[1].scale0 = {0.75f, 0.5f, 0.625f, 0};
  scales[1].add1.w = 0.5f;
  const gpu::BakedContent content{
      .lightmap = pages.view(), .sunShadow = shadow.view(), .transitionScale = 4, .scales = scales};
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 0.7f);
  const scenes::LightmapUvs both{tests::quadCorners(), {{.page = 1}, {.page = 0}}},
      left{tests::quadCorners(), {{.page = 1}, {.page = -1}}};
  for (const Setting& setting : settings()) {
    if (setting.options.preset != "ue4-2020") continue;
    const Inputs inputs{.environment = &environment, .lights = {tests::makeDirectional({0, 0, 1}, glm::vec3(2))}};
    const auto unbaked = shade(scene, nullptr, nullptr, inputs, setting.options),
               baked = shade(scene, &both, &content, inputs, setting.options),
               halfBaked = shade(scene, &left, &content, inputs, setting.options);
    const double Shadow = f64::distanceFieldShadow(140 / 255.0, 4);
    ASSERT_NEAR(Shadow, 0.482, 0.01);
    for (std::size_t i = 0; i < baked.size(); ++i) {
      const std::uint32_t at = baked[i].instance;
      const glm::dvec4 read = readOnCpu(setting.half, logs[1 - at], kSh, scales[at], {0, 0, 1});
      // Half: a sampler's last place may tip LogL by one of its own, 2^-11: .54 % of the light.
      tests::expectNear(baked[i][Term::lightmap], glm::vec3(read) * kBakedBase, setting.half ? 6e-3f : 1e-3f,
                        "page and scales");
      EXPECT_EQ(baked[i][Term::skyDiffuse], glm::vec3(0)) << "no ENABLE_SKY_LIGHT";
      tests::expectNear(baked[i][Term::sunDiffuse],
                        unbaked[i][Term::sunDiffuse] * static_cast<float>(at == 0 ? 1 : Shadow), setting.tolerance,
                        "the sun through the distance field");
      tests::expectNear(baked[i].sum(), baked[i].color, setting.tolerance, "sum of the terms");
      EXPECT_EQ(halfBaked[i].color, at == 0 ? baked[i].color : unbaked[i].color);
    }
  }
}

TEST_F(BakedTest, ViewsShowWhatTheLightmapAndTheDistanceFieldGive) {
  scenes::Scene scene = makeScene(0);
  const HostPages pages = lightmapOf(kLog, kSh), shadow = tests::makeShadowPages(4, 1, [](auto) { return 100; });
  const scenes::LightmapUvs uvs = tests::wholePage();
  const gpu::BakedContent content{
      .lightmap = pages.view(), .sunShadow = shadow.view(), .transitionScale = 2, .scales = {&kScales, 1}};
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 0.7f);
  const glm::dvec4 read = readOnCpu(false, kLog, kSh, kScales, {0, 0, 1});
  const double d = 100 / 255.0 * 2 + 0.5 - 1;
  const std::pair<std::uint32_t, glm::vec3> expected[] = {
      {kViewIndirectColor, glm::vec3(read) * kBakedBase},
      {kViewIndirectIrradiance, glm::vec3(static_cast<float>(read.w))},
      {kViewShadow, glm::vec3(static_cast<float>(d * d))},
      {kViewSkyDiffuseLighting, glm::vec3(0)}};
  for (const auto& [view, value] : expected) {
    const Inputs inputs{
        .environment = &environment, .lights = {tests::makeDirectional({0, 0, 1}, glm::vec3(2))}, .view = view};
    tests::expectNear(shade(scene, &uvs, &content, inputs, tests::inFp32("ue4-2020"))[0].color, value, 1e-3f, "view");
  }
}

// With a map of the sun's, too: where nothing stands before anything the map lets all light through, and the baked
// shadow stays. The shadow is the darker of the two, as tests/mobile/sun_shadow_test.cpp has the map's alone.
TEST_F(BakedTest, TheDistanceFieldsShadowStaysBesideAMapsOfTheSun) {
  scenes::Scene scene = makeScene(0);
  const HostPages pages = lightmapOf(kLog, kSh), shadow = tests::makeShadowPages(4, 1, [](auto) { return 100; });
  const scenes::LightmapUvs uvs = tests::wholePage();
  const gpu::BakedContent content{
      .lightmap = pages.view(), .sunShadow = shadow.view(), .transitionScale = 2, .scales = {&kScales, 1}};
  const std::vector<scenes::Light> sun = {tests::makeDirectional({0, 0, 1}, glm::vec3(2))};
  Options options = tests::inFp32("ue4-2020");
  const glm::vec3 baked = shade(scene, &uvs, &content, {.lights = sun, .view = kViewShadow}, options)[0].color;
  ASSERT_GT(baked.x, 0);
  ASSERT_LT(baked.x, 1);
  options.sunShadow = true;
  // A square before the quad hides it from the sun, and is not seen: the camera stands between the two.
  scenes::Scene hidden = scene;
  hidden.instances.push_back({0, tests::translation(0, 0, 20), "square"});
  const scenes::LightmapUvs ofBoth{tests::quadCorners(), {{.page = 0}, {.page = 0}}};
  for (const bool isHidden : {false, true}) {
    const gpu::SceneBuffers buffers(device(), isHidden ? hidden : scene);
    gpu::ShadowMaps maps(device(), buffers, sun, gpu::ShadowOptions{});
    const gpu::GpuLightmapScales scales[2] = {kScales, kScales};
    gpu::BakedContent more = content;
    more.scales = {scales, isHidden ? 2u : 1u};
    const Inputs inputs{.lights = sun, .shadows = &maps, .view = kViewShadow};
    const std::vector<ShadedPixel> pixels =
        shade(isHidden ? hidden : scene, isHidden ? &ofBoth : &uvs, &more, inputs, options);
    EXPECT_EQ(pixels[0].color.x, isHidden ? 0 : baked.x);
  }
}

// The back of a double-sided object turns its normal round, as the source's two-sided sign does.
TEST_F(BakedTest, ABackReadsTheFrontsLightmapAtItsOwnNormal) {
  scenes::Scene scene = makeScene(0);
  scene.instances[0].toWorld[0].x = -1;
  scene.instances[0].toWorld[2].z = -1;
  const HostPages pages = lightmapOf(kLog, {128, 100, 128, 255}); // little light from +Z: y is z's
  const scenes::LightmapUvs uvs = tests::wholePage();
  const gpu::BakedContent content{.lightmap = pages.view(), .scales = {&kScales, 1}};
  const glm::dvec4 back = readOnCpu(false, kLog, {128, 100, 128, 255}, kScales, {0, 0, 1}),
                   front = readOnCpu(false, kLog, {128, 100, 128, 255}, kScales, {0, 0, -1});
  ASSERT_LT(back.w, 0.5 * front.w);
  tests::expectNear(shade(scene, &uvs, &content, {}, tests::inFp32("ue4-2020"))[0][Term::lightmap],
                    glm::vec3(back) * kBakedBase, 1e-3f, "the back");
}

// Each object takes its own capture whole, without parallax, in the scale that its average brightness gives.
TEST_F(BakedTest, AnObjectTakesTheCaptureThatItNamesInTheScaleOfTheLightmap) {
  scenes::Scene scene = tests::makeTwoQuads();
  for (scenes::Material& material : scene.materials) {
    material.metallic = 1;
    material.baseColor = glm::vec4(1);
    material.roughness = 0.5f;
  }
  const glm::vec3 radiance[2] = {{0.5f, 1, 2}, {3, 0.25f, 0.5f}};
  const gpu::EnvironmentMaps environment =
      tests::makeCubes(device(), 2, 1, [&](std::uint32_t cube, auto) { return radiance[cube]; });
  const gpu::GpuCapture captures[2] = {{{0, 0, 1, 9}, glm::vec4(-9, -9, -9, 0.8f), glm::vec4(9)},
                                       {{5, 0, 1, 9}, glm::vec4(-9, -9, -9, 2.5f), glm::vec4(9)}};
  const HostPages pages = lightmapOf(kLog, kSh);
  const gpu::GpuLightmapScales scales[2] = {kScales, kScales};
  const gpu::BakedContent content{.lightmap = pages.view(), .scales = scales, .captures = captures};
  const scenes::LightmapUvs uvs{tests::quadCorners(), {{.page = 0, .capture = 1}, {.page = 0, .capture = 0}}};
  const double irradiance = readOnCpu(false, kLog, kSh, kScales, {0, 0, 1}).w;
  for (const float roughness : {0.2f, 0.5f})
    for (const char* preset : {"karis2014", "ue4-2020"}) {
      for (scenes::Material& material : scene.materials) material.roughness = roughness;
      const Options options = tests::inFp32(preset);
      const bool isFull = options.captureScale == CaptureScale::full;
      const f64::real3 E = f64::EnvBRDFApproxUE4({1, 1, 1}, roughness, 1);
      for (const ShadedPixel& pixel : shade(scene, &uvs, &content, {.environment = &environment}, options)) {
        const std::uint32_t capture = 1 - pixel.instance;
        // The middle between .1 and .3: half the weight.
        const double w = irradiance / captures[capture].boxLower.w, s = roughness < 0.3f ? 0.5 : 1;
        const auto scale = static_cast<float>(isFull ? w : 1 - s + w * s);
        tests::expectNear(pixel[Term::skySpecular], radiance[capture] * scale * static_cast<float>(E.x), 1e-3f, preset);
      }
    }
}

// With --mobile-parallax the wall of the capture's box that the reflection hits is read; the capture has six faces of
// their own colour.
TEST_F(BakedTest, ParallaxShowsTheWallThatTheReflectionHits) {
  const glm::vec3 colors[6] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}};
  const gpu::EnvironmentMaps environment =
      tests::makeCubes(device(), 1, 1, [&](std::uint32_t, std::uint32_t face) { return colors[face]; });
  const glm::vec3 origin(0.0625f, 0.03125f, 0.0625f), lower(-2, -2, -1), upper(2, 2, 0.515625f);
  const gpu::GpuCapture capture{glm::vec4(origin, 4), glm::vec4(lower, 1), glm::vec4(upper, 0)};
  const gpu::BakedContent content{.captures = {&capture, 1}};
  scenes::Scene scene = makeScene();
  scene.materials[0].metallic = 1;
  scene.materials[0].baseColor = glm::vec4(1);
  for (const bool wide : {false, true})
    for (const bool parallax : {false, true}) {
      Options options = tests::inFp32("ue4-2020");
      options.captureScale = CaptureScale::sky; // no lightmap scales it
      options.parallax = parallax;
      std::set<std::uint32_t> seen;
      for (const ShadedPixel& pixel :
           shade(scene, nullptr, &content, {.environment = &environment, .wide = wide}, options)) {
        const glm::dvec3 wall(pixel.position.x, pixel.position.y, upper.z); // N = V = R = +Z
        const std::uint32_t face = parallax ? tests::faceOf(wall - glm::dvec3(origin)) : 4;
        seen.insert(face);
        const glm::vec3 lit = pixel[Term::skySpecular], color = colors[face];
        const float most = std::max({lit.x, lit.y, lit.z});
        ASSERT_GT(most, 0);
        tests::expectNear(lit / most, color, 1e-2f, "face");
      }
      EXPECT_EQ(seen.size(), parallax ? 5u : 1u);
    }
}

TEST_F(BakedTest, WhatBakedLightFetchesCounts) {
  const scenes::Scene scene = makeScene();
  const HostPages pages = lightmapOf(kLog, kSh), shadow = tests::makeShadowPages(4, 1, [](auto) { return 100; });
  const scenes::LightmapUvs uvs = tests::wholePage();
  const gpu::BakedMaps maps =
      gpu::makeBakedMaps(device(), {.lightmap = pages.view(), .sunShadow = shadow.view(), .scales = {&kScales, 1}});
  const gpu::SceneBuffers buffers(device(), scene, gpu::SpecularAa::off, {}, &uvs);
  const gpu::SurfacePass pass(device(), buffers, 8, 8);
  const std::vector<scenes::Light> sun = {tests::makeDirectional({0, 0, 1}, glm::vec3(2))};
  const scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
  const gpu::Surface surface = std::move(pass.render(camera, {0, 8}, glm::vec2(0.5f)).front());
  const auto count = [&](const Inputs& inputs) {
    const Renderer renderer(device(), buffers, pass.binKinds(), inputs, tests::inFp32("ue4-2020"));
    renderer.shade(surface, camera);
    const gpu::CompiledPermutation& compiled = renderer.pass().compiled().at(0);
    const gpu::ShaderCost cost = gpu::costOf(renderer.pass().spirv(), compiled.constants);
    EXPECT_EQ(cost.samplers(), renderer.countSamplers(compiled.permutation));
    return cost.fetches();
  };
  EXPECT_EQ(count({.lights = sun, .baked = &maps}), 3u) << "two halves of the lightmap, the distance field";
  EXPECT_EQ(count({.baked = &maps}), 2u) << "without a sun its shadow is not read";
}

} // namespace
} // namespace parity::mobile
