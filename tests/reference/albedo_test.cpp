// The tabulated directional albedo against an independent quadrature.
#include "reference/directional_albedo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shading/quadrature.h"

namespace parity::reference {
namespace {

TEST(DirectionalAlbedo, dump) {
  for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith}) {
    const DirectionalAlbedo table(term);
    const auto geometry =
        term == GeometryTerm::heightCorrelated ? tests::Geometry::heightCorrelated : tests::Geometry::schlickSmith;
    for (const double roughness : {0.033, 0.07, 0.11, 0.2, 0.373, 0.5, 0.71, 0.93, 1.0}) {
      const AlbedoRow row = table.row(roughness);
      double worst = 0, at = 0, most = 0;
      for (const double mu : {0.003, 0.01, 0.03, 0.05, 0.1, 0.15, 0.23, 0.31, 0.5, 0.77, 0.9, 1.0}) {
        const auto t = tests::integrateEnvBrdf(geometry, roughness, mu, 48);
        const double d = std::abs(row.at(mu) - (t.A + t.B));
        most = std::max(most, t.A + t.B);
        if (d > worst) worst = d, at = mu;
      }
      const tests::GaussRule gauss(64);
      double avg = 0;
      for (int i = 0; i < 64; ++i) {
        const double mu = 0.5 * (1 + gauss.nodes[i]);
        const auto t = tests::integrateEnvBrdf(geometry, roughness, mu, 12);
        avg += gauss.weights[i] * mu * (t.A + t.B);
      }
      printf("%d R %.3f worst %.2e at %.2f  maxE %.6f avg %.6f diff %.1e\n", int(term), roughness, worst, at, most, avg, row.average() - avg);
    }
  }
}

} // namespace
} // namespace parity::reference
#include "base/stopwatch.h"
#include <chrono>
namespace parity::reference { TEST(T, time) { auto a = std::chrono::steady_clock::now(); DirectionalAlbedo t(GeometryTerm::heightCorrelated); printf("%f s\n", std::chrono::duration<double>(std::chrono::steady_clock::now()-a).count()); } }
