// Scales of light that the scene sets, in both paths; and premultiplied colour.
#include "support/path_quad.h"

#include "gpu/surface/frame_builder.h"
#include "highend/renderer.h"
#include "mobile/presets.h"
#include "mobile/renderer.h"

namespace parity::mobile {
namespace {

using shading::Term;
using tests::ShadedPoint;

scenes::Scene makeHalfMetal() {
  scenes::Scene scene = tests::makeLeaningQuad(0.3f);
  scene.materials[0].metallic = 0.5f;
  return scene;
}

class LightScalesTest : public tests::DeviceTest {
protected:
  ShadedPoint shadeHighend(const scenes::Scene& scene, const std::vector<scenes::Light>& lights) {
    const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1);
    return tests::shadeQuad(device(), scene, [&](const auto& buffers, const auto& kinds) {
      return highend::Renderer(device(), buffers, kinds,
                               {.environment = &environment, .lut = &m_lut, .lights = lights, .terms = true}, {});
    });
  }
  ShadedPoint shadeMobile(const scenes::Scene& scene, const std::vector<scenes::Light>& lights,
                          const char* preset = "ue4-2020") {
    const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1);
    return tests::shadeQuad(device(), scene, [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, {.environment = &environment, .lights = lights, .terms = true},
                      tests::inFp32(preset));
    });
  }
  static std::vector<scenes::Light> makeLights(float sunScale, float lampScale) {
    std::vector<scenes::Light> lights = {tests::makeDirectional({0.2f, 0.3f, 1}, glm::vec3(2)), {}};
    lights[0].specularScale = sunScale;
    lights[1].position = {0.3f, 0, 1};
    lights[1].specularScale = lampScale;
    return lights;
  }

  base::Image m_lut =
      highend::makeEnvBrdfLut(highend::GeometryTerm::heightCorrelated, highend::FresnelCurve::schlick, 32);
};

TEST_F(LightScalesTest, SkyLightColorScalesTheSkysLightAndNoOther) {
  scenes::Scene scene = makeHalfMetal();
  scene.materials[0].emissive = {1, 1, 1};
  const auto lights = makeLights(1, 1);
  const ShadedPoint highend = shadeHighend(scene, lights), mobile = shadeMobile(scene, lights);
  const glm::vec3 color(0.5f, 2, 0);
  scene.lightScales.skyLightColor = color;
  const ShadedPoint scaled = shadeHighend(scene, lights), scaledMobile = shadeMobile(scene, lights);
  tests::expectNear(scaled[Term::skyDiffuse], highend[Term::skyDiffuse] * color, 1e-6f, "diffuse");
  tests::expectNear(scaled[Term::skySpecular], highend[Term::skySpecular] * color, 1e-6f, "specular");
  tests::expectNear(scaledMobile[Term::skyDiffuse], mobile[Term::skyDiffuse] * color, 1e-6f, "mobile diffuse");
  for (const Term term :
       {Term::sunDiffuse, Term::sunSpecular, Term::localDiffuse, Term::localSpecular, Term::emissive}) {
    EXPECT_GT(scaled[term].x, 0);
    EXPECT_EQ(scaled[term], highend[term]);
    EXPECT_EQ(scaledMobile[term], mobile[term]);
  }
}

// In every preset, and by any of the scales of the capture: grey, coloured, black.
TEST_F(LightScalesTest, SkyLightColorReachesTheReflectionOfEveryPreset) {
  for (const char* preset : {"karis2014", "ue4-2020", "refit"})
    for (const glm::vec3 color : {glm::vec3(0.25f), glm::vec3(0.5f, 2, 0), glm::vec3(0)}) {
      scenes::Scene scene = makeHalfMetal();
      const ShadedPoint plain = shadeMobile(scene, {}, preset);
      ASSERT_GT(plain[Term::skySpecular].x, 0.05f);
      scene.lightScales.skyLightColor = color;
      tests::expectNear(shadeMobile(scene, {}, preset)[Term::skySpecular], plain[Term::skySpecular] * color, 1e-5f,
                        preset);
    }
}

TEST_F(LightScalesTest, SpecularScaleOfALightScalesItsSpecularLightAlone) {
  const scenes::Scene scene = makeHalfMetal();
  const auto check = [](const ShadedPoint& plain, const ShadedPoint& scaled) {
    EXPECT_GT(plain[Term::sunSpecular].x, 0);
    EXPECT_GT(plain[Term::localSpecular].x, 0);
    tests::expectNear(scaled[Term::sunSpecular], plain[Term::sunSpecular] * 0.25f, 1e-6f, "sun");
    tests::expectNear(scaled[Term::localSpecular], plain[Term::localSpecular] * 3.f, 1e-6f, "lamp");
    EXPECT_EQ(scaled[Term::sunDiffuse], plain[Term::sunDiffuse]);
    EXPECT_EQ(scaled[Term::localDiffuse], plain[Term::localDiffuse]);
    EXPECT_EQ(scaled[Term::skySpecular], plain[Term::skySpecular]);
  };
  check(shadeHighend(scene, makeLights(1, 1)), shadeHighend(scene, makeLights(0.25f, 3)));
  check(shadeMobile(scene, makeLights(1, 1)), shadeMobile(scene, makeLights(0.25f, 3)));
}

// The same glass by both ways of blending: mobile's own (premultiplied), and its opaque twin blended by the CPU.
TEST_F(LightScalesTest, PremultipliedGlassIsThePictureThatBlendingAfterwardsGives) {
  constexpr float kOpacity = 0.3f;
  scenes::Scene glass = makeHalfMetal();
  glass.materials[0].emissive = {1, 2, 3};
  glass.materials[0].baseColor = {0.8f, 0.5f, 0.2f, kOpacity};
  glass.fog = scenes::Fog{.density = 0.2f};
  const auto lights = makeLights(1, 1);
  const ShadedPoint opaque = shadeMobile(glass, lights);
  EXPECT_EQ(opaque.opacity, 1);
  glass.materials[0].alphaMode = scenes::AlphaMode::blend;
  const ShadedPoint layer = shadeMobile(glass, lights);
  EXPECT_EQ(layer.opacity, kOpacity);

  const glm::vec4 below(4, 5, 6, 1);
  const auto frameOf = [&](const ShadedPoint& point, bool premultiplied) {
    const auto shadedOf = [&](const glm::vec4& color, const auto& terms, bool multiplied) {
      gpu::ShadedSurface shaded{{color}, {}, multiplied};
      for (const glm::vec3& term : terms) shaded.terms.push_back({glm::vec4(term, 0)});
      return shaded;
    };
    gpu::Surface surface, glassSurface;
    glassSurface.blended = true;
    for (gpu::Surface* each : {&surface, &glassSurface}) {
      each->width = each->height = 1;
      each->pixels = each->instances = {0};
    }
    gpu::FrameBuilder builder(1, 1, 1, std::vector<char>(shading::kBaseTermCount, 1), glm::vec3(0));
    const gpu::ShadedSurface under = shadedOf(below, std::array<glm::vec3, shading::kTermCount>{}, false),
                             over = shadedOf(glm::vec4(point.color, kOpacity), point.terms, premultiplied);
    builder.begin({0, 1});
    builder.lay(surface, under);
    builder.lay(glassSurface, over);
    builder.end();
    return builder.take();
  };
  const base::Frame frame = frameOf(layer, true), expected = frameOf(opaque, false);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(frame.color.pixels[c], expected.color.pixels[c], 1e-6f * expected.color.pixels[c]);
    EXPECT_NEAR(expected.color.pixels[c], 0.7f * below[c] + kOpacity * opaque.color[c], 1e-5f);
    for (std::size_t t = 0; t < frame.terms.size(); ++t)
      EXPECT_NEAR(frame.terms[t].pixels[c], expected.terms[t].pixels[c], 1e-6f) << shading::kTermNames[t];
  }
}

TEST_F(LightScalesTest, MobileMarksItsColourAsPremultipliedAndHighendDoesNot) {
  const scenes::Scene scene = tests::makeQuadScene();
  const gpu::SceneBuffers buffers(device(), scene);
  const gpu::SurfacePass pass(device(), buffers, 4, 4);
  const scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
  const std::vector<gpu::Surface> layers = pass.render(camera, {0, 4}, glm::vec2(0.5f));
  const gpu::Surface& surface = layers.front();
  EXPECT_TRUE(
      Renderer(device(), buffers, pass.binKinds(), {}, tests::inFp32("ue4-2020")).shade(surface, camera).premultiplied);
  EXPECT_FALSE(
      highend::Renderer(device(), buffers, pass.binKinds(), {.lut = &m_lut}, {}).shade(surface, camera).premultiplied);
}

} // namespace
} // namespace parity::mobile
