// The intermediates of the high-end path: the environment BRDF as the table has it, against quadrature.
#include "support/path_quad.h"

#include <map>

#include "highend/renderer.h"
#include "shading/quadrature.h"

namespace parity::highend {
namespace {

constexpr double kAngle = 0.7, kRoughness = 0.45, kMetallic = 0.25, kRadiance = 1.5;

class HighendViewTest : public tests::DeviceTest {
protected:
  // A leaning quad, partly a metal; with an environment of constant radiance where it is asked for.
  glm::vec3 show(const std::string& name, const Options& options, bool lit = true) {
    scenes::Scene scene = tests::makeLeaningQuad(static_cast<float>(kAngle));
    scene.materials[0].baseColor = glm::vec4(0.9f, 0.6f, 0.3f, 1);
    scene.materials[0].metallic = static_cast<float>(kMetallic);
    scene.materials[0].roughness = static_cast<float>(kRoughness);
    const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), static_cast<float>(kRadiance));
    const base::Image lut = makeEnvBrdfLut(options.model.geometryTerm, options.model.fresnel);
    Inputs inputs;
    inputs.environment = lit ? &environment : nullptr;
    inputs.view = paths::placeOf(views(), name).value();
    EXPECT_TRUE(Renderer::needsLut(inputs, options));
    inputs.lut = &lut;
    return tests::shadeQuad(device(), scene,
                            [&](const auto& buffers, const auto& kinds) {
                              return Renderer(device(), buffers, kinds, inputs, options);
                            })
        .color;
  }
};

TEST(HighendViews, HaveNamesOfTheirOwnAndUnknownOnesAreNone) {
  std::map<std::string_view, int> count;
  for (const View& view : views()) {
    EXPECT_EQ(++count[view.name], 1) << view.name;
    EXPECT_FALSE(view.meaning.empty());
  }
  EXPECT_EQ(paths::placeOf(views(), "EnvBRDF"), kViewEnvBrdf);
  EXPECT_FALSE(paths::placeOf(views(), "envbrdf").has_value());
}

// Of either geometry term, with an environment and without any light.
TEST_F(HighendViewTest, EnvironmentBrdfIsTheIntegral) {
  for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith})
    for (const Compensation compensation : {Compensation::none, Compensation::kullaConty})
      for (const bool lit : {true, false}) {
        const Options options{.model = {.geometryTerm = term, .diffuse = DiffuseLobe::lambert},
                              .compensation = compensation};
        const tests::EnvBrdf truth = tests::integrateEnvBrdf(
            term == GeometryTerm::schlickSmith ? tests::Geometry::schlickSmith : tests::Geometry::heightCorrelated,
            kRoughness, std::cos(kAngle));
        const glm::vec3 A = show("EnvBRDF.A", options, lit), B = show("EnvBRDF.B", options, lit);
        const glm::vec3 both = show("EnvBRDF", options, lit);
        EXPECT_NEAR(A.x, truth.A, 5e-4);
        EXPECT_NEAR(B.z, truth.B, 5e-4);
        const double base[] = {0.9, 0.6, 0.3};
        for (int k = 0; k < 3; ++k) {
          const double F0 = 0.04 * (1 - kMetallic) + base[k] * kMetallic;
          EXPECT_NEAR(both[k], F0 * truth.A + truth.B, 5e-4) << "compensation is no part of it";
        }
      }
}

// What scatters more than once is apart: at F0 = 1 all that is missing, without compensation nothing.
TEST_F(HighendViewTest, MultipleScatteringIsApart) {
  Options options{.model = {.diffuse = DiffuseLobe::lambert}, .compensation = Compensation::none};
  EXPECT_EQ(show("EnvBRDF.Multiple", options), glm::vec3(0));
  const glm::vec3 once = show("EnvBRDF", options);
  for (const Compensation compensation : {Compensation::turquin, Compensation::fdezAguera, Compensation::kullaConty}) {
    options.compensation = compensation;
    const glm::vec3 more = show("EnvBRDF.Multiple", options);
    EXPECT_EQ(show("EnvBRDF", options), once);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GT(more[k], 0);
      EXPECT_LT(once[k] + more[k], 1);
    }
  }
}

TEST_F(HighendViewTest, EnvironmentIsShownAsItIsRead) {
  tests::expectNear(show("SpecularIBL", {}), glm::vec3(static_cast<float>(kRadiance)), 1e-5f, "radiance");
}

} // namespace
} // namespace parity::highend
