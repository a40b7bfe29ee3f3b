// Preset folders on the device: a built-in preset as a folder is the same picture at the same cost, and every function
// that a folder defines is the one that is called.
#include <cmath>
#include <filesystem>

#include "support/path_quad.h"

#include <fmt/format.h>

#include "gpu/device/pipeline.h"
#include "gpu/spirv/spirv_cost.h"
#include "highend/table_brdf.h"
#include "mobile/approximate_brdf.h"
#include "mobile/knobs.h"
#include "mobile/presets.h"
#include "mobile/probe.h"
#include "mobile/programs.h"
#include "mobile/renderer.h"
#include "mobile/sampled_brdf.h"
#include "paths/preset/preset_template.h"
#include "scenes/builtin/builtin.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/view.h"
#include "shading/shading.h"

namespace parity::mobile {
namespace {

class OwnPresetTest : public tests::DeviceTest {
protected:
  ~OwnPresetTest() override { paths::forgetPresetFolders(); }

  Options folderOf(const std::string& name, const std::string& glsl, const std::string& base,
                   Precision precision) const {
    const std::filesystem::path folder = m_folder / name;
    std::filesystem::create_directories(folder);
    tests::writeFile(folder / "preset.toml", "base = \"" + base + "\"\n");
    tests::writeFile(folder / "preset.glsl", glsl);
    Options plain;
    plain.precision = precision;
    return optionsOfFolder(folder.string(), plain);
  }
  Options templateOf(const std::string& name, Precision precision) const {
    const std::string folder = (m_folder / fmt::format("{} {}", name, m_count++)).string();
    paths::writePresetTemplate(presetHost(), name, folder);
    Options plain;
    plain.precision = precision;
    return optionsOfFolder(folder, plain);
  }

  const tests::TempFolder m_folder;
  mutable int m_count = 0;
};

Options builtIn(const std::string& name, Precision precision) {
  Options options = presetByName(name);
  options.precision = precision;
  return options;
}

TEST_F(OwnPresetTest, ABuiltInPresetAsAFolderIsTheSameToTheLastBitAndCostsTheSame) {
  constexpr std::uint32_t kWidth = 40, kHeight = 30;
  struct Case {
    const char *scene, *preset;
    Precision precision;
    bool wide;
  };
  for (const auto& [sceneName, name, precision, wide] :
       {Case{"lobes", "ue4-2020", Precision::fp16, false}, Case{"lobes", "ue4-2020", Precision::fp32, true},
        Case{"lights", "karis2014", Precision::fp16, false}, Case{"lights", "karis2014", Precision::fp32, false},
        Case{"lights", "ue4-2020", Precision::fp16, true}}) {
    const scenes::Scene scene = scenes::makeBuiltinScene(sceneName);
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, kWidth, kHeight);
    const scenes::Camera camera = scenes::makeCamera(scene, {}, float{kWidth} / kHeight);
    const std::vector<gpu::Surface> layers = pass.render(camera, {0, kHeight}, glm::vec2(0.5f));
    std::vector<scenes::Light> lights = scene.lights;
    lights.push_back(tests::makeDirectional({1, 1, 1}, glm::vec3(1)));
    const gpu::EnvironmentMaps sky = tests::makeRedTowardsX(device());
    const Inputs inputs{.environment = &sky, .lights = lights, .wide = wide};
    const Renderer own(device(), buffers, pass.binKinds(), inputs, templateOf(name, precision));
    const Renderer plain(device(), buffers, pass.binKinds(), inputs, builtIn(name, precision));
    ASSERT_NE(own.pass().spirv().data(), plain.pass().spirv().data());
    for (const gpu::Surface& layer : layers) {
      const gpu::ShadedPlane a = plain.shade(layer, camera).color, b = own.shade(layer, camera).color;
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 4; ++c)
          if (std::isfinite(a[i][c]) || std::isfinite(b[i][c])) {
            ASSERT_EQ(a[i][c], b[i][c]) << sceneName << ", " << name << ", entry " << i;
          }
    }
    if (wide) continue;
    ASSERT_EQ(own.pass().compiled().size(), plain.pass().compiled().size());
    const gpu::ShaderCost a = gpu::costOf(plain.pass().spirv(), plain.pass().compiled().front().constants),
                          b = gpu::costOf(own.pass().spirv(), own.pass().compiled().front().constants);
    EXPECT_EQ(a.operations(), b.operations()) << sceneName << ", " << name;
    EXPECT_EQ(a.fetches(), b.fetches());
    EXPECT_EQ(a.samplers(), b.samplers());
  }
}

ProbeCall callOf(std::uint32_t function, float roughness, float NoV, float x = 0, float y = 0, float z = 0) {
  return {.function = function, .F0 = 0.5f, .roughness = roughness, .NoV = NoV, .x = x, .y = y, .z = z, .unused = 0};
}

// Of the built-in presets, by the formulas in C++ of the same precision.
TEST_F(OwnPresetTest, TheProbeComputesWhatTheFormulasDo) {
  std::vector<ProbeCall> calls;
  for (int i = 1; i <= 8; ++i)
    for (int k = 1; k <= 8; ++k)
      calls.push_back(callOf(kProbeEnvironmentBrdf, static_cast<float>(i) / 8, static_cast<float>(k) / 8));
  const std::vector<glm::vec4> results = probe(device(), builtIn("karis2014", Precision::fp32), calls);
  ASSERT_EQ(results.size(), calls.size());
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const shading::f64::real2 AB = shading::f64::EnvBRDFApproxAB(calls[i].roughness, calls[i].NoV);
    EXPECT_NEAR(results[i].x, AB.x, 1e-5);
    EXPECT_NEAR(results[i].y, AB.y, 1e-5);
    EXPECT_NEAR(results[i].z, 0.5 * AB.x + AB.y, 1e-5);
  }
  const std::vector<glm::vec4> others =
      probe(device(), builtIn("ue4-2020", Precision::fp32),
            std::vector<ProbeCall>{callOf(kProbeFalloff, 0, 1, 2, 10), callOf(kProbeCone, 0, 1, 0.8f, 0.9f, 0.7f),
                                   callOf(kProbeMip, 0.5f, 1), callOf(kProbeEncode, 0, 1, 1, 2, 3),
                                   callOf(kProbeDirectLobe, 0.5f, 0.5f, 0.5f, 3.14159265f)});
  EXPECT_NEAR(others[0].x, shading::f64::squareFalloff(4, 10), 1e-6);
  EXPECT_NEAR(others[1].x, 0.25, 1e-5);
  EXPECT_NEAR(others[2].x, 5 - 1.2, 1e-5);
  EXPECT_EQ(others[3], glm::vec4(1, 2, 3, 1));
  const shading::f64::real2 AB = shading::f64::EnvBRDFApproxAB(0.5, 0.5);
  // In the mirror direction H is N.
  EXPECT_NEAR(others[4].x, 0.5 * (0.5 * AB.x + AB.y) * shading::f64::CalcSpecular(0.5, 1), 1e-4);
}

// Each returns a number that nothing else does.
TEST_F(OwnPresetTest, CallsEveryFunctionThatTheFolderDefines) {
  const std::string glsl = R"(
real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV) { return real2(R(0.25) * Roughness, R(0.125) * NoV); }
real presetEnvironmentBrdfNonmetal(real Roughness, real NoV) { return Roughness * NoV; }
real3 presetDirectLobe(MobileShadingModelContext c, MobileFrame f, real32x3 L, real NoL) {
  return real3(NoL, c.Roughness, c.SpecPreEnvBrdf.x);
}
real3 presetLocalLobe(MobileShadingModelContext c, MobileFrame f, real32x3 L, real NoL) { return real3(R(7.0)); }
real32 presetDistanceFalloff(int falloff, real32 d2, real32 range, real32 exponent) { return d2 + range; }
real presetSpotCone(real cosAngle, real cosInner, real cosOuter) { return cosAngle * R(4.0); }
real presetCaptureMip(real Roughness) { return Roughness * R(3.0); }
real3 presetSkyDiffuse(SkySh sky, real3 N) { return real3(R(0.5), R(0.25), R(0.125)); }
real3 presetEncode(real3 Color) { return Color * R(2.0); }
)";
  for (const Precision precision : {Precision::fp32, Precision::fp16}) {
    const Options options = folderOf(precision == Precision::fp16 ? "half" : "single", glsl, "ue4-2020", precision);
    const std::vector<glm::vec4> results =
        probe(device(), options,
              std::vector<ProbeCall>{callOf(kProbeEnvironmentBrdf, 0.5f, 0.25f), callOf(kProbeNonmetal, 0.5f, 0.25f),
                                     callOf(kProbeDirectLobe, 0.5f, 1, 0.25f), callOf(kProbeLocalLobe, 0.5f, 1, 0.25f),
                                     callOf(kProbeFalloff, 0, 1, 2, 10), callOf(kProbeCone, 0, 1, 0.5f, 0.9f, 0.7f),
                                     callOf(kProbeMip, 0.5f, 1), callOf(kProbeEncode, 0, 1, 1, 2, 3)});
    EXPECT_EQ(results[0], glm::vec4(0.125f, 0.03125f, 0.09375f, 0.25f));
    EXPECT_EQ(results[1].z, 0.125f);
    EXPECT_EQ(results[2], glm::vec4(0.25f, 0.5f, 0.5f, 0.25f));
    EXPECT_EQ(results[3], glm::vec4(7, 7, 7, 0.25f));
    EXPECT_EQ(results[4].x, 14);
    EXPECT_EQ(results[5].x, 2);
    EXPECT_EQ(results[6].x, 1.5f);
    EXPECT_EQ(results[7], glm::vec4(2, 4, 6, 1));

    // In the path itself: sky, encoding and lobe of a quad that faces its light.
    scenes::Scene scene = tests::makeQuadScene();
    scene.materials[0].baseColor = glm::vec4(1);
    scene.materials[0].metallic = 0;
    const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 3);
    const auto shade = [&](const Options& with) {
      return tests::shadeQuad(device(), scene,
                              [&](const gpu::SceneBuffers& buffers, const std::vector<gpu::BinKind>& kinds) {
                                return Renderer(device(), buffers, kinds, {.environment = &sky, .terms = true}, with);
                              });
    };
    const tests::ShadedPoint point = shade(options);
    EXPECT_NEAR(point[shading::Term::skyDiffuse].x / point[shading::Term::skyDiffuse].z, 4, 1e-2);
    Options other = options;
    const std::string plain = glsl.substr(0, glsl.find("real3 presetEncode"));
    other = folderOf(precision == Precision::fp16 ? "half2" : "single2", plain, "ue4-2020", precision);
    const tests::ShadedPoint without = shade(other);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(point.color[c], 2 * without.color[c], 2e-3 * point.color[c]);

    // A spot light 3 m in front: d^2 for the distance, four times the cosine for the cone, 7 for the lobe.
    scenes::Light spot;
    spot.kind = scenes::LightKind::spot;
    spot.position = {0, 0, 3};
    spot.direction = {0, 0, -1};
    const tests::ShadedPoint lamp = tests::shadeQuad(
        device(), scene, [&](const gpu::SceneBuffers& buffers, const std::vector<gpu::BinKind>& kinds) {
          return Renderer(device(), buffers, kinds, {.lights = {spot}, .terms = true}, options);
        });
    const glm::vec3 specular = lamp[shading::Term::localSpecular];
    EXPECT_NEAR(specular.x, 7 * 9 * 4 / 3.14159f, 12); // d and the cosine are those of a pixel beside the axis
    EXPECT_EQ(specular.x, specular.y);
    EXPECT_EQ(specular.x, specular.z);
  }
}

// The base, the coat, brushed metal and glass all read the environment at the folder's mip.
TEST_F(OwnPresetTest, ReadsTheEnvironmentAtTheFoldersMipOnEveryRoute) {
  const std::string rough = "real presetCaptureMip(real Roughness) { return R(1.0); }\n";
  gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 0);
  const std::vector<glm::vec4> fine(6 * 4, glm::vec4(1)), coarse(6, glm::vec4(3)); // radiance by mip
  const std::span<const std::byte> mips[] = {std::as_bytes(std::span{fine}), std::as_bytes(std::span{coarse})};
  vk::SamplerCreateInfo info;
  info.maxLod = VK_LOD_CLAMP_NONE;
  sky.sampler = vk::raii::Sampler(device().handle(), info);
  sky.cube = gpu::DeviceImage(
      device(), {.format = vk::Format::eR32G32B32A32Sfloat, .width = 2, .height = 2, .mips = 2, .cube = true}, mips);
  Options options = folderOf("rough", rough, "ue4-2020", Precision::fp32), plain = builtIn("ue4-2020", Precision::fp32);
  for (Options* each : {&options, &plain}) {
    each->capture = CaptureEncoding::fp16;
    each->anisotropy = AnisotropyForm::bent;
    each->transmission = TransmissionForm::refracted;
  }
  const auto lit = [&](const scenes::Scene& scene, const Options& with) {
    return tests::shadeQuad(device(), scene,
                            [&](const gpu::SceneBuffers& buffers, const std::vector<gpu::BinKind>& kinds) {
                              return Renderer(device(), buffers, kinds, {.environment = &sky, .terms = true}, with);
                            });
  };
  using shading::Term;
  const auto expectThrice = [&](const char* route, Term term, const auto& change) {
    scenes::Scene scene = tests::makeQuadScene();
    scene.materials[0].baseColor = glm::vec4(1);
    scene.materials[0].metallic = 1;
    scene.materials[0].roughness = 0.01f; // the path's own mip is 0
    change(scene.materials[0]);
    const float own = lit(scene, options)[term].x, before = lit(scene, plain)[term].x;
    EXPECT_GT(before, 0) << route;
    EXPECT_NEAR(own, 3 * before, 1e-3f * own) << route;
  };
  expectThrice("base", Term::skySpecular, [](scenes::Material&) {});
  expectThrice("coat", Term::coatSpecular, [](scenes::Material& m) { m.coat = 1; });
  expectThrice("brushed metal", Term::skySpecular, [](scenes::Material& m) { m.anisotropy = 0.01f; });
  expectThrice("glass", Term::transmission, [](scenes::Material& m) { m.metallic = 0, m.transmission = 1; });
  expectThrice("thick glass", Term::transmission,
               [](scenes::Material& m) { m.metallic = 0, m.transmission = 1, m.thickness = 0.1f; });
}

// The grid stands for the formula, whose own values are in double. Between its nodes the fit's cusp is cut off.
TEST_F(OwnPresetTest, ItsSampledEnvironmentBrdfIsTheFormulas) {
  const Options own = templateOf("ue4-2020", Precision::fp32);
  const SampledBrdf sampled(device(), own);
  const ApproximateBrdf exact(builtIn("ue4-2020", Precision::fp32));
  for (const auto& [steps, tolerance] : {std::pair(32, 2e-5), std::pair(37, 2e-3)})
    for (int j = 1; j <= steps; ++j)
      for (int i = 1; i <= steps; ++i) {
        const double roughness = static_cast<double>(j) / steps, NoV = static_cast<double>(i) / steps;
        const glm::dvec3 grey(0.3);
        EXPECT_NEAR(sampled.at(roughness, NoV).A, exact.at(roughness, NoV).A, tolerance) << roughness << " " << NoV;
        EXPECT_NEAR(sampled.at(roughness, NoV).B, exact.at(roughness, NoV).B, tolerance);
        EXPECT_NEAR(sampled.once(roughness, NoV, grey).x, exact.once(roughness, NoV, grey).x, tolerance);
      }
  EXPECT_EQ(sampled.form({.nonmetal = true}), "nonmetal");
}

// Without refit's environment BRDF its lobe has no terms to share.
TEST_F(OwnPresetTest, AnEnvironmentBrdfOnRefitNeedsALobe) {
  const std::string brdf = "real2 presetEnvironmentBrdf(real3 S, real R0, real N) { return real2(R0, N); }\n";
  EXPECT_THROW(requireSense(folderOf("a", brdf, "refit", Precision::fp32), "sRGB"), base::Error);
  const std::string lobe =
      "real3 presetDirectLobe(MobileShadingModelContext c, MobileFrame f, real32x3 L, real NoL) { return "
      "real3(NoL); }\n";
  EXPECT_NO_THROW(requireSense(folderOf("b", brdf + lobe, "refit", Precision::fp32), "sRGB"));
  Options lobeAlone = builtIn("ue4-2020", Precision::fp32);
  lobeAlone.directLobe = DirectLobe::own;
  EXPECT_THROW(requireSense(lobeAlone, "sRGB"), base::Error);
}

} // namespace
} // namespace parity::mobile
