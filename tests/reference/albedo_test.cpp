// The tabulated directional albedo against an independent quadrature.
#include "reference/directional_albedo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "reference/fresnel.h"
#include "reference/lobes.h"
#include "reference/surroundings.h"
#include "shading/quadrature.h"
#include "shading/shading.h"

namespace parity::reference {
namespace {

// Between the table's nodes. Observed: 1.5e-5 at worst; the average 5.3e-6.
TEST(DirectionalAlbedo, IsTheIntegralToFourDigitsForBothGeometryTerms) {
  for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith}) {
    const DirectionalAlbedo table(term);
    const auto geometry =
        term == GeometryTerm::heightCorrelated ? tests::Geometry::heightCorrelated : tests::Geometry::schlickSmith;
    for (const double roughness : {0.033, 0.11, 0.2, 0.373, 0.5, 0.71, 0.93, 1.0}) {
      const AlbedoRow row = table.row(roughness);
      for (const double mu : {0.003, 0.01, 0.03, 0.1, 0.23, 0.5, 0.77, 1.0}) {
        const tests::EnvBrdf truth = tests::integrateEnvBrdf(geometry, roughness, mu, 16);
        EXPECT_NEAR(row.at(mu), truth.A + truth.B, 2.5e-5) << "roughness " << roughness << ", mu " << mu;
      }
      const tests::GaussRule gauss(48);
      double average = 0;
      for (std::size_t i = 0; i < gauss.nodes.size(); ++i) {
        const double mu = 0.5 * (1 + gauss.nodes[i]);
        const tests::EnvBrdf truth = tests::integrateEnvBrdf(geometry, roughness, mu, 12);
        average += gauss.weights[i] * mu * (truth.A + truth.B);
      }
      EXPECT_NEAR(row.average(), average, 1e-5) << "roughness " << roughness;
    }
  }
}

// The mean of Fresnel's weight, by Schlick's curve the share B of the environment BRDF. Observed: 1e-5 at worst, but
// 1e-4 at mu = 0.003 of a smooth surface.
TEST(DirectionalAlbedo, WeighsFresnelsCurvesAsTheIntegralDoes) {
  using Choice = std::pair<GeometryTerm, FresnelCurve>;
  for (const auto& [term, curve] : {Choice(GeometryTerm::heightCorrelated, FresnelCurve::schlick),
                                    Choice(GeometryTerm::heightCorrelated, FresnelCurve::dielectric),
                                    Choice(GeometryTerm::schlickSmith, FresnelCurve::sphericalGaussian)}) {
    const DirectionalAlbedo table(term, curve);
    for (const double roughness : {0.033, 0.2, 0.81}) {
      const AlbedoRow row = table.row(roughness);
      const double alpha = roughness * roughness;
      for (const double mu : {0.003, 0.23, 0.9}) {
        const auto lobe = [&, geometry = term](const tests::Cosines& c) {
          const double V = geometry == GeometryTerm::heightCorrelated
                               ? shading::f64::V_SmithGGXCorrelated(alpha, mu, c.NoL)
                               : shading::f64::V_SchlickSmith(alpha, mu, c.NoL);
          return shading::f64::D_GGX(alpha, c.NoH) * V * c.NoL;
        };
        const double all = tests::integrateLobe(alpha, mu, 12, lobe);
        const double weighted = tests::integrateLobe(alpha, mu, 12, [&, fresnel = curve](const tests::Cosines& c) {
          return lobe(c) * fresnelWeight(fresnel, c.VoH);
        });
        EXPECT_NEAR(row.fresnelWeightAt(mu), weighted / all, mu < 0.01 ? 1.2e-4 : 2.5e-5)
            << "roughness " << roughness << ", mu " << mu;
      }
    }
  }
}

// alpha = 1: D = 1/pi, and height-correlated V = 1/2 / (NoL + NoV), so E = integral of l / (l + mu) dl = 1 - mu ln(1 +
// 1/mu). Schlick-Smith has the same V at mu = 1: docs/shading.md 1a's 1 - ln 2.
TEST(DirectionalAlbedo, AtRoughnessOneHasItsClosedForm) {
  const AlbedoRow row = DirectionalAlbedo(GeometryTerm::heightCorrelated).row(1);
  for (const double mu : {0.01, 0.05, 0.2, 0.4, 0.8, 1.0})
    EXPECT_NEAR(row.at(mu), 1 - mu * std::log1p(1 / mu), 2e-6) << mu;
  EXPECT_NEAR(DirectionalAlbedo(GeometryTerm::schlickSmith).row(1).at(1), 1 - std::log(2.0), 1e-7);
}

TEST(DirectionalAlbedo, IsTheSameAfterTheCache) {
  const DirectionalAlbedo table(GeometryTerm::schlickSmith);
  const std::vector<std::byte> bytes = table.toBytes();
  const auto kept = DirectionalAlbedo::fromBytes(bytes);
  ASSERT_TRUE(kept.has_value());
  for (const double roughness : {0.0, 0.37, 1.0}) {
    EXPECT_EQ(kept->row(roughness).at(0.3), table.row(roughness).at(0.3));
    EXPECT_EQ(kept->row(roughness).fresnelWeightAt(0.3), table.row(roughness).fresnelWeightAt(0.3));
    EXPECT_EQ(kept->row(roughness).average(), table.row(roughness).average());
  }
  EXPECT_FALSE(DirectionalAlbedo::fromBytes(std::span(bytes).first(bytes.size() - 1)).has_value());
}

TEST(DirectionalAlbedo, NeverExceedsOne) {
  const DirectionalAlbedo table(GeometryTerm::heightCorrelated);
  for (int r = 0; r <= 200; ++r) {
    const AlbedoRow row = table.row(r / 200.0);
    ASSERT_LE(row.average(), 1);
    for (int m = 0; m <= 500; ++m) {
      const double E = row.at(m / 500.0);
      ASSERT_TRUE(E > 0.3 && E <= 1) // 1 - ln 2 is the least
          << E << " at roughness " << r / 200.0 << ", mu " << m / 500.0;
    }
  }
}

// What multiple scattering adds to a coloured metal: bounce after bounce, with Fresnel's mean by quadrature instead of
// its closed form.
TEST(Lobes, MultipleScatteringIsTheSumOfItsBounces) {
  const DirectionalAlbedo table(GeometryTerm::heightCorrelated);
  SurfaceSample sample;
  sample.baseColor = {0.2f, 0.5f, 0.9f};
  sample.metallic = 1;
  constexpr double kRoughness = 0.8, kNoV = 0.6, kNoL = 0.45, kNoH = 0.9, kVoH = 0.7;
  const AlbedoRow row = table.row(kRoughness);
  const double lost = 1 - row.average(), lostAtView = 1 - row.at(kNoV);
  const Model multiple;
  const glm::dvec3 added =
      Lobes(sample, multiple, kRoughness, &table).evaluate(kNoV, kNoL, kNoH, kVoH, {.lost = lostAtView}).specular -
      Lobes(sample, tests::plainModel(), kRoughness, nullptr).evaluate(kNoV, kNoL, kNoH, kVoH, {}).specular;
  for (int c = 0; c < 3; ++c) {
    const double F0 = static_cast<double>(sample.baseColor[c]);
    double Favg = 0;
    constexpr int kSteps = 4000;
    for (int i = 0; i < kSteps; ++i) {
      const double mu = (i + 0.5) / kSteps;
      Favg += 2 * mu * (F0 + (1 - F0) * std::pow(1 - mu, 5)) / kSteps;
    }
    // Each bounce reflects Favg; a share Eavg of what was reflected leaves, the rest bounces again.
    double sum = 0, onItsWay = Favg * Favg;
    for (int bounce = 0; bounce < 200; ++bounce, onItsWay *= Favg * lost) sum += onItsWay * row.average();
    const double expected = sum * lostAtView * (1 - row.at(kNoL)) / (3.14159265358979 * lost) * kNoL;
    EXPECT_NEAR(added[c] / expected, 1, 1e-5) << c;
  }
}

} // namespace
} // namespace parity::reference
