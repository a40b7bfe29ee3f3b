// The tabulated directional albedo against an independent quadrature.
#include "reference/directional_albedo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shading/quadrature.h"

namespace parity::reference {
namespace {

// Between the table's nodes. Observed: 1.5e-5 at worst; the average 5.3e-6.
TEST(DirectionalAlbedo, isTheIntegralToFourDigitsForBothGeometryTerms) {
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

// alpha = 1: D = 1/pi, and height-correlated V = 1/2 / (NoL + NoV), so E = integral of l / (l + mu) dl = 1 - mu ln(1 +
// 1/mu). Schlick-Smith has the same V at mu = 1: SHADING's 1 - ln 2.
TEST(DirectionalAlbedo, atRoughnessOneHasItsClosedForm) {
  const AlbedoRow row = DirectionalAlbedo(GeometryTerm::heightCorrelated).row(1);
  for (const double mu : {0.01, 0.05, 0.2, 0.4, 0.8, 1.0})
    EXPECT_NEAR(row.at(mu), 1 - mu * std::log1p(1 / mu), 2e-6) << mu;
  EXPECT_NEAR(DirectionalAlbedo(GeometryTerm::schlickSmith).row(1).at(1), 1 - std::log(2.0), 1e-7);
}

TEST(DirectionalAlbedo, neverExceedsOneAndAMirrorLosesNothing) {
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
  EXPECT_EQ(AlbedoRow().at(0.3), 1);
}

} // namespace
} // namespace parity::reference
