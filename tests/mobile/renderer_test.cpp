// The mobile path against the published formulas in double precision, put together here in the order of the base pass.
#include <numbers>

#include "support/bumpy_quad.h"
#include "support/path_quad.h"

#include "mobile/light_choice.h"
#include "mobile/presets.h"
#include "mobile/renderer.h"
#include "shading/shading.h"

namespace parity::mobile {
namespace {

using shading::Term;
using tests::makeDirectional;
using tests::makeLeaningQuad;
using tests::ShadedPoint;
namespace f64 = shading::f64;

using std::numbers::pi;
constexpr float kTolerance = 1e-4f; // fp32 exp2 against double

class MobileTest : public tests::DeviceTest {
protected:
  ShadedPoint shade(const scenes::Scene& scene, Inputs inputs, const Options& options) {
    inputs.terms = inputs.view == kViewLit;
    inputs.compilation.store = &pipelines();
    return tests::shadeQuad(device(), scene, [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, inputs, options);
    });
  }
};

const Options kKaris2014 = tests::inFp32("karis2014"), kUe42020 = tests::inFp32("ue4-2020"),
              kRefit = tests::inFp32("refit");

scenes::Light makePoint(const glm::vec3& position, float candela) {
  scenes::Light light;
  light.kind = scenes::LightKind::point;
  light.position = position;
  light.color = glm::vec3(candela);
  return light;
}

// Any base colour and metallic that is not the nonmetal's.
scenes::Scene makeMetal(float angle, float roughness) {
  scenes::Scene scene = makeLeaningQuad(angle);
  scene.materials[0].baseColor = glm::vec4(0.9f, 0.6f, 0.3f, 1);
  scene.materials[0].metallic = 0.7f;
  scene.materials[0].roughness = roughness;
  return scene;
}
glm::dvec3 specularColorOf(const scenes::Material& m) {
  return 0.04 * (1.0 - m.metallic) + glm::dvec3(glm::vec3(m.baseColor)) * static_cast<double>(m.metallic);
}
glm::dvec3 toGlm(const f64::real3& v) { return {v.x, v.y, v.z}; }
f64::real3 fromGlm(const glm::dvec3& v) { return f64::real3(v.x, v.y, v.z); }

// Its own textures make the picture, whatever the scene's hold.
TEST_F(MobileTest, ReadsTheTexturesThatItIsGiven) {
  const auto makeTextured = [](std::uint8_t value) {
    scenes::Scene scene = makeLeaningQuad(0.4f);
    scene.images.push_back({"paint", base::Image8(8, 8, 4, value)});
    scene.materials[0].baseColorTexture.image = 0;
    return scene;
  };
  const Inputs lit{.lights = {makeDirectional(glm::vec3(0, 0, 1), glm::vec3(3))}};
  const scenes::Scene white = makeTextured(255);
  const gpu::Textures stored(device(), white, false, {}, [](const base::Image8& mip, bool isColor) {
    EXPECT_TRUE(isColor);
    return base::Image8(mip.width, mip.height, 4, 100);
  });
  Inputs given = lit;
  given.textures = &stored;
  const glm::vec3 color = shade(white, given, kUe42020).color;
  EXPECT_EQ(color, shade(makeTextured(100), lit, kUe42020).color);
  EXPECT_NE(color, shade(white, lit, kUe42020).color);
}

TEST_F(MobileTest, SunOfKaris2014IsEnvBrdfTimesDApproxAroundTheReflection) {
  const glm::vec3 lux(4, 3, 2), towards = glm::normalize(glm::vec3(0.9f, 0.2f, 0.9f));
  for (const float roughness : {0.2f, 0.5f, 1.f}) {
    const scenes::Scene scene = makeMetal(0.4f, roughness);
    const ShadedPoint point = shade(scene, {.lights = {makeDirectional(towards, lux)}}, kKaris2014);
    const glm::dvec3 N(std::sin(0.4f), 0, std::cos(0.4f)), V(0, 0, 1), R = 2 * glm::dot(N, V) * N - V, L = towards;
    const glm::dvec3 environment =
        toGlm(f64::EnvBRDFApprox(fromGlm(specularColorOf(scene.materials[0])), roughness, glm::dot(N, V)));
    const double lobe = f64::D_Approx(roughness, glm::dot(R, L)), NoL = glm::dot(N, L);
    tests::expectNear(point[Term::sunSpecular], glm::vec3(glm::dvec3(lux) / pi * environment * lobe * NoL),
                      kTolerance * 4, "specular");
    tests::expectNear(point[Term::sunDiffuse],
                      glm::vec3(glm::dvec3(lux) / pi * glm::dvec3(glm::vec3(scene.materials[0].baseColor)) * 0.3 * NoL),
                      kTolerance, "diffuse");
  }
}

TEST_F(MobileTest, SunByPhongApproxIsFiniteWhereTheArticlesLobeIsNot) {
  const glm::vec3 mirror = glm::normalize(glm::vec3(std::sin(0.8f), 0, std::cos(0.8f)));
  Options options = kKaris2014;
  options.directLobe = DirectLobe::phongApprox;
  for (const float roughness : {0.f, 0.05f, 0.3f, 1.f}) {
    const scenes::Scene scene = makeMetal(0.4f, roughness);
    const Inputs inputs{.lights = {makeDirectional(mirror, glm::vec3(2))}};
    const double a = std::max(static_cast<double>(roughness) * roughness, 0.008), NoL = std::cos(0.4);
    const glm::dvec3 environment =
        toGlm(f64::EnvBRDFApprox(fromGlm(specularColorOf(scene.materials[0])), roughness, NoL));
    // At the peak; single precision's cosine there is wrong by 6e-8, times c.
    const double expected = 2 / pi * environment.x * NoL / (a * a);
    EXPECT_NEAR(shade(scene, inputs, options)[Term::sunSpecular].x, expected, 5e-3 * expected) << roughness;
    Options half = options;
    half.precision = Precision::fp16;
    if (!device().report().float16) continue;
    const float inHalf = shade(scene, inputs, half)[Term::sunSpecular].x;
    EXPECT_TRUE(inHalf > 0 && std::isfinite(inHalf)) << roughness;
  }
}

TEST_F(MobileTest, SunOfUe4IsEnvBrdfTimesCalcSpecularAroundTheHalfVector) {
  const glm::vec3 lux(4, 3, 2), towards = glm::normalize(glm::vec3(0.5f, 0.3f, 0.9f));
  for (const float roughness : {0.3f, 0.6f, 1.f}) {
    const scenes::Scene scene = makeMetal(0.4f, roughness);
    const ShadedPoint point = shade(scene, {.lights = {makeDirectional(towards, lux)}}, kUe42020);
    const glm::dvec3 N(std::sin(0.4f), 0, std::cos(0.4f)), V(0, 0, 1), L = towards;
    const double NoH = glm::dot(N, glm::normalize(V + L)), NoL = glm::dot(N, L);
    const glm::dvec3 environment =
        toGlm(f64::EnvBRDFApproxUE4(fromGlm(specularColorOf(scene.materials[0])), roughness, glm::dot(N, V)));
    tests::expectNear(point[Term::sunSpecular],
                      glm::vec3(glm::dvec3(lux) / pi * environment * (NoL * f64::CalcSpecular(roughness, NoH))),
                      kTolerance * 4, "specular");
  }
}

TEST_F(MobileTest, SkyIsOneFetchTimesEnvBrdf) {
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1.5f);
  const scenes::Scene scene = makeMetal(0.6f, 0.35f);
  const double NoV = std::cos(0.6f);
  const glm::dvec3 F0 = specularColorOf(scene.materials[0]);
  const ShadedPoint ue4 = shade(scene, {.environment = &environment}, kUe42020);
  const ShadedPoint karis = shade(scene, {.environment = &environment}, kKaris2014);
  tests::expectNear(ue4[Term::skySpecular], glm::vec3(1.5 * toGlm(f64::EnvBRDFApproxUE4(fromGlm(F0), 0.35, NoV))),
                    kTolerance, "ue4-2020");
  tests::expectNear(karis[Term::skySpecular], glm::vec3(1.5 * toGlm(f64::EnvBRDFApprox(fromGlm(F0), 0.35, NoV))),
                    kTolerance, "karis2014");
  tests::expectNear(ue4[Term::skyDiffuse], 1.5f * 0.3f * glm::vec3(scene.materials[0].baseColor), kTolerance,
                    "diffuse");
}

TEST_F(MobileTest, SkyIsFetchedAroundTheReflection) {
  const gpu::EnvironmentMaps environment = tests::makeRedTowardsX(device());
  // Leaning by 45 degrees towards +X, the quad reflects +X; upright it reflects +Z.
  EXPECT_GT(shade(makeMetal(0.7853982f, 0.5f), {.environment = &environment}, kUe42020)[Term::skySpecular].x, 0.2f);
  EXPECT_EQ(shade(makeMetal(0, 0.5f), {.environment = &environment}, kUe42020)[Term::skySpecular].x, 0);
}

// A black cube under a sky of 1: what is left of the reflection is the wide part of the lobe, and what scatters more
// than once.
TEST_F(MobileTest, RefitTakesTheWidePartOfTheLobeFromTheIrradiance) {
  gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 0);
  environment.tintedSky[0] = glm::vec4(1);
  for (const float metallic : {1.f, 0.f})
    for (const float roughness : {0.1f, 0.45f, 0.7f, 1.f}) {
      scenes::Scene scene = makeMetal(0.6f, roughness);
      scene.materials[0].metallic = metallic;
      const double NoV = std::cos(0.6f);
      const f64::RefitTap tap = f64::refitTap(roughness, NoV);
      f64::RefitLobe lobe = f64::refitLobe(fromGlm(specularColorOf(scene.materials[0])), 1, roughness, NoV);
      if (metallic == 0) lobe.multiple = {0, 0, 0};
      const glm::dvec3 expected = toGlm(lobe.single) * tap.wide + toGlm(lobe.multiple);
      tests::expectNear(shade(scene, {.environment = &environment}, kRefit)[Term::skySpecular], glm::vec3(expected),
                        1e-4f, "wide part");
    }
}

TEST_F(MobileTest, NonmetalUsesItsOwnFunction) {
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1);
  scenes::Scene scene = makeLeaningQuad(1.2f);
  scene.materials[0].metallic = 0;
  scene.materials[0].roughness = 0.25f;
  ASSERT_TRUE(scene.materials[0].isNonmetal());
  const ShadedPoint point = shade(scene, {.environment = &environment}, kUe42020);
  const double NoV = std::cos(1.2f), own = f64::EnvBRDFApproxNonmetal(0.25, NoV),
               general = f64::EnvBRDFApprox(f64::real3(0.04, 0.04, 0.04), 0.25, NoV).x;
  ASSERT_GT(std::abs(own - general), 3e-5) << "the two must be told apart at this point";
  EXPECT_NEAR(point[Term::skySpecular].x, own, 5e-6);
  // A metallic of 1e-6 is not a nonmetal.
  scene.materials[0].metallic = 1e-6f;
  EXPECT_NEAR(shade(scene, {.environment = &environment}, kUe42020)[Term::skySpecular].x, general, 5e-6);
}

TEST_F(MobileTest, FullyRoughMovesSpecularIntoDiffuseAndFetchesNoEnvironment) {
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1);
  for (const Options& preset : {kKaris2014, kUe42020}) {
    scenes::Scene scene = makeMetal(0.4f, 0.2f);
    scene.materials[0].fullyRough = true;
    const ShadedPoint point =
        shade(scene, {.environment = &environment, .lights = {makeDirectional({0, 0, 1}, glm::vec3(2))}}, preset);
    EXPECT_EQ(point[Term::skySpecular], glm::vec3(0));
    EXPECT_EQ(point[Term::sunSpecular], glm::vec3(0));
    const glm::dvec3 diffuse =
        glm::dvec3(glm::vec3(scene.materials[0].baseColor)) * 0.3 + 0.45 * specularColorOf(scene.materials[0]);
    tests::expectNear(point[Term::skyDiffuse], glm::vec3(diffuse), kTolerance, "DiffuseColor += SpecularColor * 0.45");
  }
}

TEST_F(MobileTest, RoughnessFloorKeepsUe4FiniteWhereKaris2014Fails) {
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1);
  const scenes::Scene scene = makeMetal(0, 0);
  const Inputs inputs{.environment = &environment, .lights = {makeDirectional({0, 0, 1}, glm::vec3(2))}};
  const ShadedPoint ue4 = shade(scene, inputs, kUe42020), karis = shade(scene, inputs, kKaris2014);
  EXPECT_TRUE(std::isfinite(ue4.color.x));
  // The clamp of 2048 at NoH = 1, and (R/4 + 1/4) at R = 1/64.
  const double lobe = (0.015625 * 0.25 + 0.25) * 2048;
  const glm::dvec3 E = toGlm(f64::EnvBRDFApproxUE4(fromGlm(specularColorOf(scene.materials[0])), 0.015625, 1));
  tests::expectNear(ue4[Term::sunSpecular], glm::vec3(2 / pi * lobe * E), kTolerance, "clamped peak");
  EXPECT_FALSE(std::isfinite(karis.color.x))
      << "the article prints no floor: 1/R^4 is infinite, and the picture must show it";
}

TEST_F(MobileTest, LocalLightsAreTheFourBrightestAndNoneWhereTheyAreBaked) {
  scenes::Scene scene = makeLeaningQuad(0);
  scene.materials[0].metallic = 0;
  std::vector<scenes::Light> lights;
  for (int i = 0; i < 6; ++i) lights.push_back(makePoint({0, 0, 2000}, 1e6f * static_cast<float>(i + 1)));
  const ShadedPoint point = shade(scene, {.lights = lights}, kUe42020);
  const double expected = (3e6 + 4e6 + 5e6 + 6e6) / (2000.0 * 2000.0) / pi;
  tests::expectNear(point[Term::localDiffuse], glm::vec3(static_cast<float>(expected)), 1e-3f, "diffuse");
  EXPECT_EQ(shade(scene, {.lights = lights}, kKaris2014).color, glm::vec3(0)) << "baked there";
}

TEST_F(MobileTest, EachLocalLightIsClampedAt65000WithItsPartsInProportion) {
  scenes::Scene scene = makeMetal(0.1f, 0.5f);
  const glm::vec3 position(0, 0, 2000);
  const ShadedPoint dim = shade(scene, {.lights = {makePoint(position, 1e6f)}}, kUe42020);
  const ShadedPoint bright = shade(scene, {.lights = {makePoint(position, 1e14f)}}, kUe42020);
  EXPECT_NEAR(bright[Term::localDiffuse].x + bright[Term::localSpecular].x, 65000, 0.5);
  EXPECT_NEAR(bright[Term::localDiffuse].x / bright[Term::localSpecular].x,
              dim[Term::localDiffuse].x / dim[Term::localSpecular].x, 1e-3);
}

TEST_F(MobileTest, TermsAddUpToTheColourInEveryPresetAndPrecision) {
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 0.7f);
  for (const float metallic : {0.7f, 0.f}) { // refit has a shader of its own for nonmetals
    scenes::Scene scene = makeMetal(0.3f, 0.4f);
    scene.materials[0].metallic = metallic;
    scene.materials[0].emissive = glm::vec3(0.1f, 0.2f, 0.3f);
    for (Options options : {kKaris2014, kUe42020, kRefit})
      for (const Precision precision : {Precision::fp32, Precision::fp16}) {
        if (precision == Precision::fp16 && !device().report().float16) continue;
        options.precision = precision;
        const ShadedPoint point =
            shade(scene,
                  {.environment = &environment,
                   .lights = {makeDirectional({0, 1, 1}, glm::vec3(2)), makePoint({1, 2, 3}, 20)}},
                  options);
        glm::vec3 sum(0);
        for (const glm::vec3& term : point.terms) sum += term;
        tests::expectNear(sum, point.color, precision == Precision::fp16 ? 4e-3f : 1e-3f, "sum of the terms");
        EXPECT_GT(point[Term::skySpecular].x, 0);
      }
  }
}

// Half rounds: what both precisions show of a material that is not smooth differs by little.
TEST_F(MobileTest, HalfShowsWhatSingleShows) {
  if (!device().report().float16) GTEST_SKIP() << "no shaderFloat16";
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 0.7f);
  for (Options options : {kKaris2014, kUe42020, kRefit}) {
    const Inputs inputs{.environment = &environment, .lights = {makeDirectional({0.2f, 1, 1}, glm::vec3(2))}};
    const glm::vec3 single = shade(makeMetal(0.3f, 0.5f), inputs, options).color;
    options.precision = Precision::fp16;
    const glm::vec3 half = shade(makeMetal(0.3f, 0.5f), inputs, options).color;
    tests::expectNear(half, single, 5e-3f, "colour");
    EXPECT_NE(half, single) << "half it is";
  }
}

// A sun's scale of 1000 on a peak of half's size: beyond half before the light, within it after.
TEST_F(MobileTest, AStrongSpecularScaleUnderADimSunStaysWhatItIs) {
  if (!device().report().float16) GTEST_SKIP() << "no shaderFloat16";
  scenes::Light sun = makeDirectional({0, 0, 1}, glm::vec3(0.01f, 0, 0.01f));
  sun.specularScale = 1000;
  Options options = kUe42020;
  const glm::vec3 single = shade(makeMetal(0, 0.1f), {.lights = {sun}}, options)[Term::sunSpecular];
  options.precision = Precision::fp16;
  const glm::vec3 half = shade(makeMetal(0, 0.1f), {.lights = {sun}}, options)[Term::sunSpecular];
  tests::expectNear(half, single, 5e-3f, "specular");
  EXPECT_EQ(half.y, 0) << "no light in this channel";
}

// What the path shows of two tilts in turn is a smooth surface of the widened roughness (tests/highend has the same).
TEST_F(MobileTest, SpecularAaWidensTheRoughnessThatThePathSees) {
  scenes::Scene checker = tests::makeQuadScene(), smooth = checker;
  checker.images = {tests::makeChecker(256)};
  checker.materials[0].normalTexture.image = 0;
  checker.materials[0].roughness = 0.25f;
  const double tilt = 39.5 / 120.5, length = 1 / std::sqrt(1 + tilt * tilt); // codes 88, 167; 248
  smooth.materials[0].roughness = static_cast<float>(std::pow(std::pow(0.25, 4) + 2 * (1 - length) / length, 0.25));
  const Inputs inputs{.lights = {makeDirectional({0.3f, 0.2f, 1}, glm::vec3(1))}};
  for (const Options& preset : {kKaris2014, kUe42020}) {
    const auto shadeWith = [&](gpu::SpecularAa specularAa) {
      return tests::shadeQuad(
          device(), checker,
          [&](const auto& buffers, const auto& kinds) { return Renderer(device(), buffers, kinds, inputs, preset); },
          specularAa);
    };
    const glm::vec3 expected = shade(smooth, inputs, preset).color;
    tests::expectNear(shadeWith(gpu::SpecularAa::toksvig).color, expected, 0.03f, "widened");
    EXPECT_GT(std::abs(shadeWith(gpu::SpecularAa::off).color.x / expected.x - 1), 0.2);
  }
}

TEST_F(MobileTest, RendererSaysWhatItLeavesOut) {
  const scenes::Scene scene = makeMetal(0, 0.5f);
  const gpu::SceneBuffers buffers(device(), scene);
  const gpu::SurfacePass pass(device(), buffers, 8, 8);
  std::vector<scenes::Light> lights = {makeDirectional({0, 0, 1}, glm::vec3(1)),
                                       makeDirectional({0, 1, 0}, glm::vec3(2))};
  for (int i = 0; i < 5; ++i) lights.push_back(makePoint({0, 0, 3}, 10));
  const Inputs inputs{.lights = lights};
  EXPECT_EQ(Renderer(device(), buffers, pass.binKinds(), inputs, kUe42020).notes().size(), 2u);
  EXPECT_EQ(Renderer(device(), buffers, pass.binKinds(), inputs, kKaris2014).notes().size(), 2u);
  const Inputs none{};
  EXPECT_TRUE(Renderer(device(), buffers, pass.binKinds(), none, kUe42020).notes().empty());
}

} // namespace
} // namespace parity::mobile
