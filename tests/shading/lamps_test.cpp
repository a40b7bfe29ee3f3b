// The lobe of a prefiltered level, against quadrature.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

#include "shading/shading.h"

namespace parity::shading {
namespace {

using std::numbers::pi;

// Sum over `count` heights of f(cos) 2 pi dcos, dense where cos is near 1.
template <typename F> double overHemisphere(int count, const F& f) {
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double x = (i + 0.5) / count, u = 0.5 * x * x * x; // (1 - cos) / 2
    sum += f(u) * 2 * pi * 2 * 1.5 * x * x / count;
  }
  return sum;
}

double lobeOf(double a2, double u, double spread = 0) {
  return f64::prefilteredLobe(a2, f64::prefilteredLobeIntegral(a2), u, spread);
}

TEST(PrefilteredLobe, IntegratesToOne) {
  for (double roughness = 0.06; roughness <= 1.0001; roughness += 0.01) {
    const double a2 = std::min(1.0, std::pow(roughness, 4));
    const auto lobe = [&](double u) { return lobeOf(a2, u); };
    const auto lobe32 = [&](double u) {
      return f32::prefilteredLobe(static_cast<float>(a2), f32::prefilteredLobeIntegral(static_cast<float>(a2)),
                                  static_cast<float>(u), 0.f);
    };
    EXPECT_NEAR(overHemisphere(20000, lobe), 1, 3e-4) << roughness;
    EXPECT_NEAR(overHemisphere(20000, lobe32), 1, 5e-4) << roughness;
  }
}

// It is D_GGX cos / 4 for N = V, to a factor that does not depend on the direction.
TEST(PrefilteredLobe, IsThatOfGgx) {
  for (const double alpha : {0.01, 0.1, 0.5, 1.0}) {
    double first = 0;
    for (const double u : {0.0, 1e-4, 0.01, 0.1, 0.4}) {
      const double ratio = lobeOf(alpha * alpha, u) / (f64::D_GGX(alpha, std::sqrt(1 - u)) * (1 - 2 * u));
      if (u == 0) first = ratio;
      EXPECT_NEAR(ratio / first, 1, 1e-9) << alpha << " " << u;
    }
    EXPECT_EQ(lobeOf(alpha * alpha, 0.5), 0);
    EXPECT_EQ(lobeOf(alpha * alpha, 1.0), 0);
  }
}

// The mean over a disc of radius r, whose mean square distance is r^2 / 2, by rings and sectors.
TEST(PrefilteredLobe, TakesTheMeanOverASpread) {
  for (const double a2 : {1e-4, 0.01})
    for (const double angle : {0.0, 0.1, 0.3, 0.7}) {
      const double r = 0.15 * std::sqrt(4 * (a2 + std::pow(std::sin(angle / 2), 2)));
      double sum = 0;
      for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j) {
          const double q = r * std::sqrt((i + 0.5) / 64), phi = 2 * pi * (j + 0.5) / 64;
          // Of a direction at `angle`, another by q towards phi.
          const double c = std::cos(angle) * std::cos(q) + std::sin(angle) * std::sin(q) * std::cos(phi);
          sum += lobeOf(a2, (1 - c) / 2) / 4096;
        }
      const double at = lobeOf(a2, std::pow(std::sin(angle / 2), 2)),
                   mean = lobeOf(a2, std::pow(std::sin(angle / 2), 2), r * r / 2);
      EXPECT_NEAR(mean / sum, 1, 0.01) << a2 << " " << angle;
      EXPECT_LT(std::abs(mean / sum - 1), 0.35 * std::abs(at / sum - 1) + 1e-4) << a2 << " " << angle;
    }
}

// Of D over a disc of lights about L, by sums in double; V and L in the plane x = 0 and out of it.
TEST(MeanOfGgx, IsTheMeanOverADiscOfLights) {
  const glm::dvec3 N(0, 0, 1);
  const auto unit = [](double x, double y, double z) { return glm::normalize(glm::dvec3(x, y, z)); };
  for (const double alpha : {0.0041, 0.05, 0.3})
    for (const glm::dvec3& V : {unit(0, 0.1, 1), unit(0, 0.8, 1)})
      for (const double away : {0.0, 0.5, 1.0, 3.0}) { // of alpha, the half vector from N
        const glm::dvec3 middle = unit(away * alpha, 0, 1), L = glm::reflect(-V, middle);
        const auto lobe = [&](const glm::dvec3& l) {
          const double NoH = glm::dot(N, glm::normalize(V + l));
          return std::pow(1 - NoH * NoH * (1 - alpha * alpha), -2);
        };
        const glm::dvec3 across = glm::normalize(glm::cross(L, glm::dvec3(0, 1, 0))), along = glm::cross(across, L);
        const double r = 0.4 * alpha; // of the disc
        double sum = 0;
        for (int i = 0; i < 64; ++i)
          for (int j = 0; j < 64; ++j) {
            const double q = r * std::sqrt((i + 0.5) / 64), phi = 2 * pi * (j + 0.5) / 64;
            sum += lobe(glm::normalize(L + q * (std::cos(phi) * across + std::sin(phi) * along))) / 4096;
          }
        const double NoH2 = std::pow(glm::dot(N, middle), 2), VoH2 = std::pow(glm::dot(V, middle), 2);
        const double mean = lobe(L) * f64::meanOfGgx(alpha * alpha, NoH2, VoH2, r * r / 2);
        EXPECT_NEAR(mean / sum, 1, 0.03) << alpha << " " << V.y << " " << away;
        // Turning half as much or twice as much leaves half of the difference, or more, at the peak.
        const double left = away == 0 ? 0.15 : 0.7;
        EXPECT_LT(std::abs(mean / sum - 1), left * std::abs(lobe(L) / sum - 1) + 1e-3) << alpha << " " << away;
      }
}

TEST(LampShare, RunsFromNoneToAll) {
  EXPECT_LT(f64::lampShare(0.1, 1.0), 0.001);
  EXPECT_GT(f64::lampShare(30.0, 1.0), 0.98);
  EXPECT_EQ(f64::lobeScale(0.25, 1.0, 1.0), 1.0);
  EXPECT_EQ(f64::lobeScale(0.25, 2.0, 0.5), 0.5); // beyond 1 by rounding
}

} // namespace
} // namespace parity::shading
