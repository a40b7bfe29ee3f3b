// Punctual lights against the textbook formulas, written out here.
#include "reference/direct_light.h"

#include <numbers>

#include <gtest/gtest.h>

#include "reference/surroundings.h"
#include "shading/quadrature.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

scenes::Light makeSun(const glm::vec3& towards, const glm::vec3& lux) {
  scenes::Light light;
  light.kind = scenes::LightKind::directional;
  light.direction = -glm::normalize(towards);
  light.color = lux;
  return light;
}

TEST(DirectLight, SunIsTheClosedFormForBothGeometryTerms) {
  const scenes::Light sun = makeSun({0.3f, 0.8f, 0.4f}, {3, 2, 1});
  for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith})
    for (const float roughness : {0.1f, 0.5f, 1.f}) {
      SurfaceSample sample = tests::makePoint(0.6, roughness, 0.25f);
      sample.baseColor = {0.9f, 0.5f, 0.1f};
      sample.dielectricF90 = 0.8f;
      const glm::dvec3 N(sample.normal), V = glm::normalize(glm::dvec3(sample.view)), L = -glm::dvec3(sun.direction);
      const glm::dvec3 H = glm::normalize(V + L);
      const double NoL = glm::dot(N, L), NoV = glm::dot(N, V), alpha = double(roughness) * double(roughness);
      const double G = tests::maskingShadowing(
          term == GeometryTerm::heightCorrelated ? tests::Geometry::heightCorrelated : tests::Geometry::schlickSmith,
          alpha, NoV, NoL);
      const double lobe = tests::distribution(alpha, glm::dot(N, H)) * G / (4 * NoV);
      const DirectLight result = shadeDirect(sample, {sun}, tests::plainModel(term), nullptr);
      for (int c = 0; c < 3; ++c) {
        const double base = sample.baseColor[c], metallic = sample.metallic;
        const double F0 = sample.dielectricF0[c] * (1 - metallic) + base * metallic;
        const double F90 = double(sample.dielectricF90) * (1 - metallic) + metallic;
        const double F = F0 + (F90 - F0) * std::pow(1 - glm::dot(V, H), 5);
        const double specular = sun.color[c] * lobe * F, diffuse = sun.color[c] * NoL * base * (1 - metallic) / pi;
        EXPECT_NEAR(result.sunSpecular[c], specular, 1e-9 * specular) << roughness;
        EXPECT_NEAR(result.sunDiffuse[c], diffuse, 1e-12);
      }
      EXPECT_EQ(result.localDiffuse, glm::dvec3(0));
    }
}

TEST(DirectLight, SpecularScaleOfALightIsOfItsSpecularLightAlone) {
  scenes::Light sun = makeSun({0.3f, 0.8f, 0.4f}, {3, 2, 1}), lamp;
  lamp.position = {0.4f, 1, 0.3f};
  const SurfaceSample sample = tests::makePoint(0.6, 0.5f, 0.25f);
  const Model model = tests::plainModel(GeometryTerm::heightCorrelated);
  const DirectLight plain = shadeDirect(sample, {sun, lamp}, model, nullptr);
  sun.specularScale = 0.25f;
  lamp.specularScale = 3;
  const DirectLight scaled = shadeDirect(sample, {sun, lamp}, model, nullptr);
  ASSERT_GT(plain.sunSpecular.x, 0);
  ASSERT_GT(plain.localSpecular.x, 0);
  EXPECT_EQ(scaled.sunSpecular, 0.25 * plain.sunSpecular);
  EXPECT_NEAR(scaled.localSpecular.x, 3 * plain.localSpecular.x, 1e-12 * plain.localSpecular.x);
  EXPECT_EQ(scaled.sunDiffuse, plain.sunDiffuse);
  EXPECT_EQ(scaled.localDiffuse, plain.localDiffuse);
}

// What Kulla and Conty add, with the albedos by quadrature instead of the table; at F0 = 1 Fms is 1.
TEST(DirectLight, MultipleScatteringAddsKullaAndContysLobe) {
  const DirectionalAlbedo table(GeometryTerm::heightCorrelated);
  const scenes::Light sun = makeSun({-0.5f, 0.7f, 0.2f}, glm::vec3(pi));
  for (const float roughness : {0.4f, 0.8f}) {
    SurfaceSample sample = tests::makePoint(0.35, roughness, 1);
    sample.baseColor = glm::vec3(1);
    const auto lost = [&](double mu) {
      const tests::EnvBrdf E = tests::integrateEnvBrdf(tests::Geometry::heightCorrelated, roughness, mu, 20);
      return 1 - E.A - E.B;
    };
    const tests::GaussRule gauss(48);
    double average = 0;
    for (std::size_t i = 0; i < gauss.nodes.size(); ++i)
      average += gauss.weights[i] * 0.5 * (1 + gauss.nodes[i]) * lost(0.5 * (1 + gauss.nodes[i]));
    const double NoL = -sun.direction.y, NoV = glm::normalize(sample.view).y;
    const double expected = pi * NoL * lost(NoV) * lost(NoL) / (pi * average);
    const double added = shadeDirect(sample, {sun}, Model{}, &table).sunSpecular.x -
                         shadeDirect(sample, {sun}, tests::plainModel(), nullptr).sunSpecular.x;
    EXPECT_NEAR(added, expected, 2e-4 * expected) << roughness;
  }
}

TEST(DirectLight, PointAndSpotFollowKhrLightsPunctual) {
  SurfaceSample sample = tests::makePoint(1, 0.5f, 0);
  scenes::Light light;
  light.position = {0, 2, 0};
  light.color = {8, 4, 2};
  light.range = 4;
  const glm::dvec3 point = shadeDirect(sample, {light}, tests::plainModel(), nullptr).localDiffuse;
  // window 1 - (2/4)^4 = 15/16; over d^2 = 4; Lambert's 1/pi.
  EXPECT_NEAR(point.x, 8 * (15.0 / 16) / 4 / pi, 1e-12);
  EXPECT_NEAR(point.z, 2 * (15.0 / 16) / 4 / pi, 1e-12);
  light.kind = scenes::LightKind::spot;
  light.direction = glm::normalize(glm::vec3(0.2f, -1, 0));
  light.innerConeAngle = 0.1f;
  light.outerConeAngle = 0.3f;
  const glm::dvec3 spot = shadeDirect(sample, {light}, tests::plainModel(), nullptr).localDiffuse;
  const double x =
      (-double(light.direction.y) - std::cos(double(0.3f))) / (std::cos(double(0.1f)) - std::cos(double(0.3f)));
  ASSERT_TRUE(x > 0.1 && x < 0.9);
  EXPECT_NEAR(spot.x / point.x, x * x, 1e-6);
}

TEST(DirectLight, FadesAsTheLightSays) {
  const SurfaceSample sample = tests::makePoint(1, 0.5f, 0);
  scenes::Light light;
  light.position = {0, 2, 0};
  light.color = {8, 4, 2};
  light.range = 4;
  light.falloff = scenes::Falloff::ue4;
  EXPECT_NEAR(shadeDirect(sample, {light}, tests::plainModel(), nullptr).localDiffuse.x,
              8 * std::pow(15.0 / 16, 2) / (4 + 1e-4) / pi, 1e-12);
  light.falloff = scenes::Falloff::exponent;
  light.falloffExponent = 8;
  EXPECT_NEAR(shadeDirect(sample, {light}, tests::plainModel(), nullptr).localDiffuse.x, 8 * std::pow(0.75, 8) / pi,
              1e-12);
}

TEST(DirectLight, FromBehindIsDarkAndAtTheLightFinite) {
  SurfaceSample sample = tests::makePoint(0.5, 0, 1);
  EXPECT_EQ(shadeDirect(sample, {makeSun({0, -1, 0}, glm::vec3(5))}, tests::plainModel(), nullptr).sunSpecular,
            glm::dvec3(0));
  scenes::Light light;
  light.direction = {0, -1, 0};
  const DirectLight at = shadeDirect(sample, {light}, tests::plainModel(), nullptr);
  EXPECT_TRUE(std::isfinite(at.localSpecular.x) && at.localSpecular.x >= 0);
}

} // namespace
} // namespace parity::reference
