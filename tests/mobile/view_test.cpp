// The intermediates of the base pass: each shows what its name says.
#include "support/path_quad.h"

#include <map>
#include <numbers>

#include "mobile/presets.h"
#include "mobile/renderer.h"
#include "shading/shading.h"

namespace parity::mobile {
namespace {

namespace f64 = shading::f64;

constexpr double kAngle = 0.5, kRadiance = 1.5, kRoughness = 0.4, kMetallic = 0.75, kLux = 3;
using std::numbers::pi;

class ViewTest : public tests::DeviceTest {
protected:
  // The lit quad of all these tests: leaning, half a metal, under a constant sky, a sun and a lamp.
  glm::vec3 show(std::uint32_t view, const Options& options) {
    scenes::Scene scene = tests::makeLeaningQuad(static_cast<float>(kAngle));
    scene.materials[0].baseColor = glm::vec4(0.9f, 0.6f, 0.3f, 1);
    scene.materials[0].metallic = static_cast<float>(kMetallic);
    scene.materials[0].roughness = static_cast<float>(kRoughness);
    scene.materials[0].emissive = glm::vec3(0.1f, 0.2f, 0.3f);
    const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), static_cast<float>(kRadiance));
    scenes::Light lamp;
    lamp.position = {0, 0, 2000};
    lamp.color = glm::vec3(8e6f);
    Inputs inputs;
    inputs.environment = &environment;
    inputs.lights = {tests::makeDirectional({0, 0, 1}, glm::vec3(static_cast<float>(kLux))), lamp};
    inputs.view = view;
    return tests::shadeQuad(device(), scene,
                            [&](const auto& buffers, const auto& kinds) {
                              return Renderer(device(), buffers, kinds, inputs, options);
                            })
        .color;
  }
  static std::uint32_t numberOf(const std::string& name) { return paths::placeOf(views(), name).value(); }
};

TEST(Views, HaveNamesOfTheirOwnAndUnknownOnesAreNone) {
  std::map<std::string_view, int> count;
  for (const View& view : views()) {
    EXPECT_EQ(++count[view.name], 1) << view.name;
    EXPECT_FALSE(view.meaning.empty());
  }
  EXPECT_EQ(paths::placeOf(views(), "Lit"), kViewLit);
  EXPECT_FALSE(paths::placeOf(views(), "lit").has_value());
}

TEST_F(ViewTest, EachShowsWhatItsNameSays) {
  const Options options = tests::inFp32("ue4-2020");
  const double NoV = std::cos(kAngle), c = 0.25;
  const glm::dvec3 base(0.9, 0.6, 0.3), F0 = 0.04 * c + kMetallic * base;
  const f64::real3 E = f64::EnvBRDFApproxUE4({F0.x, F0.y, F0.z}, kRoughness, NoV);
  const f64::real2 AB = f64::EnvBRDFApproxAB(kRoughness, NoV); // F0 is above 2 %: nothing of B is faded
  const glm::dvec3 specular(E.x, E.y, E.z), diffuse = base * c, one(1);
  const double lobe = f64::CalcSpecular(kRoughness, NoV); // V = L = H
  const double sun = kLux / pi, lamp = 8e6 / (2000.0 * 2000.0) / pi;
  const glm::dvec3 lighting = NoV * (diffuse + specular * lobe), emissive(0.1, 0.2, 0.3);
  const std::map<std::string, glm::dvec3> expected = {
      {"IndirectColor", glm::dvec3(0)},
      {"SkyDiffuseLighting", kRadiance * one},
      {"DiffuseLookup", kRadiance * one},
      {"SkyLightColor", one},
      {"IndirectIrradiance", kRadiance * one},
      {"DirectionalLight", sun * lighting},
      {"Lighting.Diffuse", NoV * diffuse},
      {"Lighting.Specular", NoV * lobe * specular},
      {"Lighting", lighting},
      {"SpecularIBL", kRadiance * one},
      {"SpecularIBL.Lit", kRadiance * specular},
      {"Color.AfterIBL", sun * lighting + kRadiance * specular},
      {"DynamicPointLights", lamp * lighting},
      {"SkyLight", kRadiance * diffuse},
      {"Emissive", emissive},
      {"VertexFog", glm::dvec3(0)},
      {"VertexFog.a", glm::dvec3(1)}, // no fog: nothing is lost behind it
      {"DiffuseColor", diffuse},
      {"SpecPreEnvBrdf", F0},
      {"SpecularColor", specular},
      {"DielectricSpecular", 0.04 * one},
      {"BaseColor", base},
      {"Metallic", kMetallic * one},
      {"Roughness", kRoughness * one},
      {"MaterialAO", one},
      {"Opacity", one},
      {"Shadow", one},
      {"NoL", NoV * one},
      {"NoH", NoV * one},
      {"NoV", NoV * one},
      {"H", glm::dvec3(0, 0, 1)},
      {"WorldNormal", glm::dvec3(std::sin(kAngle), 0, NoV)},
      {"ReflectionVector", glm::dvec3(std::sin(2 * kAngle), 0, std::cos(2 * kAngle))},
      {"EnvBRDF.A", AB.x * one},
      {"EnvBRDF.B", AB.y * one},
      {"EnvBRDF", specular},
      {"EnvBRDF.Multiple", glm::dvec3(0)},
      {"Lit", (sun + lamp) * lighting + kRadiance * (specular + diffuse) + emissive},
  };
  ASSERT_EQ(expected.size(), views().size()) << "a view without a test";
  for (const auto& [name, value] : expected) {
    const glm::vec3 actual = show(numberOf(name), options);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(actual[k], value[k], 1e-3 * std::abs(value[k]) + 1e-6) << name << " " << k;
  }
}

} // namespace
} // namespace parity::mobile
