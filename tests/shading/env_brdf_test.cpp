// The mobile path's environment BRDF: the article's own statements, and its deviation from both exact integrals.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "shading/quadrature.h"
#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;

double approx(double F0, double roughness, double NoV) { return f64::EnvBRDFApprox({F0, F0, F0}, roughness, NoV).x; }

struct Deviation {
  double max = 0, squares = 0, weight = 0;
  void add(double error, double w) {
    max = std::max(max, std::fabs(error));
    squares += w * error * error;
    weight += w;
  }
  double rms() const { return std::sqrt(squares / weight); }
};

// Deviations over the core, R and N in [0.05, 1]: a 41x41 grid with its edges, trapezoid weights.
struct CoreDeviations {
  Deviation dielectric, metal, nonmetal;
};

CoreDeviations deviationsFrom(Geometry geometry) {
  constexpr int kSteps = 40;
  CoreDeviations core;
  for (int i = 0; i <= kSteps; ++i)
    for (int k = 0; k <= kSteps; ++k) {
      const double R = 0.05 + 0.95 * i / kSteps, N = 0.05 + 0.95 * k / kSteps;
      const double w = (i % kSteps == 0 ? 0.5 : 1) * (k % kSteps == 0 ? 0.5 : 1);
      const EnvBrdf e = integrateEnvBrdf(geometry, R, N, 6);
      core.dielectric.add(approx(0.04, R, N) - (0.04 * e.A + e.B), w);
      core.metal.add(approx(1, R, N) - (e.A + e.B), w);
      core.nonmetal.add(f64::EnvBRDFApproxNonmetal(R, N) - (0.04 * e.A + e.B), w);
    }
  return core;
}

constexpr double kPrinted = 6e-4; // half a unit of docs/shading.md 2b's last digit, and the grid

TEST(EnvBrdfApprox, DeviatesFromSchlickSmithAsPublished) {
  const CoreDeviations core = deviationsFrom(Geometry::schlickSmith);
  EXPECT_NEAR(core.dielectric.max, 0.161, kPrinted);
  EXPECT_NEAR(core.dielectric.rms(), 0.024, kPrinted);
  EXPECT_NEAR(core.metal.max, 0.238, kPrinted);
  EXPECT_NEAR(core.metal.rms(), 0.076, kPrinted);
  EXPECT_NEAR(core.nonmetal.max, 0.160, kPrinted);
  EXPECT_NEAR(core.nonmetal.rms(), 0.024, kPrinted);
}

TEST(EnvBrdfApprox, DeviatesFromHeightCorrelatedSmithAsPublished) {
  const CoreDeviations core = deviationsFrom(Geometry::heightCorrelated);
  EXPECT_NEAR(core.dielectric.max, 0.084, kPrinted);
  EXPECT_NEAR(core.dielectric.rms(), 0.020, kPrinted);
  // docs/shading.md 2b prints .396, from a grid that stops short of the corner R = 1, N = 0.05; at the edge itself it
  // is .3978.
  EXPECT_NEAR(core.metal.max, 0.3978, kPrinted);
  EXPECT_NEAR(core.metal.rms(), 0.127, kPrinted);
  EXPECT_NEAR(core.nonmetal.max, 0.085, kPrinted);
  EXPECT_NEAR(core.nonmetal.rms(), 0.020, kPrinted);
}

// The article: EnvBRDFApprox(SpecularColor, 1, 1) == SpecularColor * 0.4524 - 0.0024. It rounds: the second term is
// 1.04 * 0.015 + 0.022 - 0.04 = -0.0024 exactly, the first -1.04 * 0.015 + 1.04 - 0.572 = 0.4524 exactly.
TEST(EnvBrdfApprox, MeetsTheArticlesOwnCheckAtFullRoughness) {
  for (const double S : {0.0, 0.04, 0.5, 1.0}) EXPECT_NEAR(approx(S, 1, 1), S * 0.4524 - 0.0024, 1e-12);
}

TEST(EnvBrdfApprox, SumOfAAndBFallsLinearlyWithRoughnessWhateverTheView) {
  for (const double R : {0.0, 0.3, 0.8, 1.0})
    for (const double N : {0.0, 0.1, 0.5, 1.0}) {
      const f64::real2 AB = f64::EnvBRDFApproxAB(R, N);
      EXPECT_NEAR(AB.x + AB.y, 1 - 0.55 * R, 1e-12);
    }
}

TEST(EnvBrdfApprox, GivesEachChannelItsOwnColour) {
  const f64::real3 E = f64::EnvBRDFApprox({0.1, 0.5, 0.9}, 0.4, 0.3);
  EXPECT_EQ(E.x, approx(0.1, 0.4, 0.3));
  EXPECT_EQ(E.y, approx(0.5, 0.4, 0.3));
  EXPECT_EQ(E.z, approx(0.9, 0.4, 0.3));
}

TEST(EnvBrdfApproxUE4, IsIdenticalFromTwoPercentOnAndOffAtZero) {
  for (const double R : {0.0, 0.5, 1.0})
    for (const double N : {0.0, 0.4, 1.0}) {
      for (const double F0 : {0.02, 0.04, 1.0})
        EXPECT_EQ(f64::EnvBRDFApproxUE4({F0, F0, F0}, R, N).x, approx(F0, R, N));
      EXPECT_EQ(f64::EnvBRDFApproxUE4({0, 0, 0}, R, N).y, 0);
      // Green decides for all channels; at 1 % half of B is left.
      const f64::real2 AB = f64::EnvBRDFApproxAB(R, N);
      EXPECT_NEAR(f64::EnvBRDFApproxUE4({1, 0.01, 0}, R, N).x, AB.x + 0.5 * AB.y, 1e-15);
    }
}

// The article: "Same as EnvBRDFApprox(0.04, Roughness, NoV)". It drops a term, which is worth up to 1.53e-3.
TEST(EnvBrdfApproxNonmetal, StandsForApproxAtFourPercent) {
  double worst = 0;
  for (int i = 0; i <= 400; ++i)
    for (int k = 0; k <= 400; ++k) {
      const double R = i / 400.0, N = k / 400.0;
      worst = std::max(worst, std::fabs(f64::EnvBRDFApproxNonmetal(R, N) - approx(0.04, R, N)));
    }
  EXPECT_LE(worst, 1.6e-3);
  EXPECT_GT(worst, 1.4e-3);
}

TEST(FullyRough, MovesFortyFivePercentOfSpecularIntoDiffuse) {
  f64::real3 diffuse(0.2, 0, 1), specular(0.04, 1, 0.5);
  f64::FullyRough(diffuse, specular);
  EXPECT_DOUBLE_EQ(diffuse.x, 0.2 + 0.04 * 0.45);
  EXPECT_DOUBLE_EQ(diffuse.y, 0.45);
  EXPECT_DOUBLE_EQ(diffuse.z, 1.225);
  EXPECT_EQ(specular.x + specular.y + specular.z, 0);
}

// docs/shading.md 2c: 0.45 F0 in place of the integral at R = 1, F0 = 1, over N in [0, 1]. Converged: .0893 and .1739.
TEST(FullyRough, DeviatesFromBothIntegralsAsPublished) {
  const PanelRule views({0.0, 0.01, 0.1, 0.3, 1.0}, 12);
  for (const auto& [geometry, rms] : {std::pair{Geometry::schlickSmith, 0.090}, {Geometry::heightCorrelated, 0.175}}) {
    double squares = 0, width = 0;
    for (std::size_t i = 0; i < views.nodes.size(); ++i) {
      const EnvBrdf e = integrateEnvBrdf(geometry, 1, views.nodes[i], 8);
      f64::real3 diffuse(0, 0, 0), specular(1, 1, 1);
      f64::FullyRough(diffuse, specular);
      squares += views.weights[i] * std::pow(diffuse.x - (e.A + e.B), 2);
      width += views.weights[i];
    }
    EXPECT_NEAR(std::sqrt(squares / width), rms, 1.5e-3);
  }
}

} // namespace
} // namespace parity::tests
