// Height fog against Simpson's quadrature of its extinction along the way, its limits, and Unreal Engine 4's own lines.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f32 = shading::f32;
namespace f16 = shading::f16;

// exp(-integral) of density 2^(-falloff (y - height)) over the straight way from `start` metres on.
double transmittanceByQuadrature(const f64::HeightFog& fog, double eyeHeight, double rise, double distance) {
  if (distance <= fog.startDistance) return 1;
  constexpr int kPanels = 20000; // even
  const double step = (distance - fog.startDistance) / kPanels;
  double sum = 0;
  for (int i = 0; i <= kPanels; ++i) {
    const double s = fog.startDistance + i * step, y = eyeHeight + rise * s / distance;
    const double extinction = fog.density * std::pow(2.0, -fog.heightFalloff * (y - fog.height));
    sum += extinction * (i == 0 || i == kPanels ? 1 : i % 2 == 1 ? 4 : 2);
  }
  return std::max(std::exp(-sum * step / 3), 1 - fog.maxOpacity);
}

struct Way {
  double eyeHeight, rise, distance;
};
constexpr Way kWays[] = {{1.7, 0, 40},  {1.7, -1.7, 12}, {30, -28, 60},  {-5, 4, 9},   {2, 90, 95},
                         {2, 1e-5, 50}, {50, -55, 80},   {3, 0.004, 30}, {12, 11, 11}, {0, -3, 25}};

TEST(HeightFog, IsTheIntegralOfTheExtinctionAlongTheWay) {
  for (const double falloff : {0.0, 1e-4, 0.02, 0.3, 1.5})
    for (const double start : {0.0, 8.0})
      for (const Way& way : kWays) {
        const f64::HeightFog fog{0.03, falloff, 1.0, start, 1.0};
        EXPECT_NEAR(f64::heightFogTransmittance(fog, way.eyeHeight, way.rise, way.distance),
                    transmittanceByQuadrature(fog, way.eyeHeight, way.rise, way.distance), 3e-6)
            << "falloff " << falloff << ", start " << start << ", rise " << way.rise << " over " << way.distance;
      }
}

// Where Taylor's form takes over from the quotient (a fall of 0.05 / falloff), and on both sides of level.
TEST(HeightFog, HasNoStepWhereTheSeriesBegins) {
  const f32::HeightFog fog{0.05f, 0.5f, 0.f, 0.f, 1.f};
  const f64::HeightFog exact{0.05, 0.5, 0, 0, 1};
  for (double rise = -0.2; rise <= 0.2; rise += 0.0005) {
    const double truth = transmittanceByQuadrature(exact, 1, rise, 30);
    EXPECT_NEAR(f32::heightFogTransmittance(fog, 1.f, static_cast<float>(rise), 30.f), truth, 2e-6) << rise;
  }
}

TEST(HeightFog, WithoutFalloffIsDistanceFog) {
  for (const double distance : {0.0, 1.0, 25.0, 400.0})
    for (const double rise : {-0.7, 0.0, 0.9})
      EXPECT_NEAR(f64::heightFogTransmittance({0.01, 0, 5, 0, 1}, 3, rise * distance, distance),
                  std::exp(-0.01 * distance), 1e-12);
}

// HeightFogCommon.ush, 4.2x: Falloff = max(-127, FogHeightFalloff * RayDirectionZ); LineIntegral = (1 - exp2(-Falloff))
// / Falloff; RayOriginTerms = FogDensity * exp2(-FogHeightFalloff * (z - FogHeight)); ExpFogFactor =
// max(saturate(exp2(-RayOriginTerms * LineIntegral * RayLength)), MinFogOpacity).
TEST(HeightFog, IsUnrealsWithItsDensityTimesLn2Squared) {
  constexpr double kFalloff = 0.2, kDensity = 0.04, kHeight = 0.5, kMinFogOpacity = 0.1;
  const double ln2 = std::log(2.0);
  for (const Way& way : kWays) {
    const double F = std::max(-127.0, kFalloff * way.rise);
    if (std::abs(F) <= 0.01) continue; // its Taylor form has two terms only
    const double origin = kDensity * std::exp2(-kFalloff * (way.eyeHeight - kHeight));
    const double unreal = std::max(std::exp2(-origin * (1 - std::exp2(-F)) / F * way.distance), kMinFogOpacity);
    const f64::HeightFog fog{kDensity * ln2 * ln2, kFalloff, kHeight, 0, 1 - kMinFogOpacity};
    EXPECT_NEAR(f64::heightFogTransmittance(fog, way.eyeHeight, way.rise, way.distance), unreal, 3e-6);
  }
}

TEST(HeightFog, StartsAtItsDistanceAndEndsAtItsOpacity) {
  const f64::HeightFog fog{0.5, 0, 0, 10, 0.75};
  EXPECT_EQ(f64::heightFogTransmittance(fog, 0, 0, 10), 1);
  EXPECT_NEAR(f64::heightFogTransmittance(fog, 0, 0, 11), std::exp(-0.5), 1e-12);
  EXPECT_EQ(f64::heightFogTransmittance(fog, 0, 0, 1e4), 0.25);
  EXPECT_EQ(f64::heightFogTransmittance({0, 1, 0, 0, 1}, 0, 0, 1e4), 1) << "no density";
}

// Camera above and below, distances and falloffs without bound: never NaN, never outside [1 - maxOpacity, 1].
TEST(HeightFog, IsFiniteForEveryFiniteInput) {
  constexpr float kMost = std::numeric_limits<float>::max();
  const float sizes[] = {0, std::numeric_limits<float>::min(), 1e-3f, 1, 1e4f, 1e19f, 1e30f, kMost};
  for (const float density : sizes)
    for (const float falloff : sizes)
      for (const float start : {0.f, 1.f, kMost})
        for (const float distance : sizes)
          for (const float size : sizes)
            for (const float sign : {-1.f, 1.f})
              for (const float rise : {-1.f, -1e-6f, 0.f, 1.f}) {
                const float eye = sign * size, height = -eye;
                const f32::HeightFog fog{density, falloff, height, start, 0.9f};
                const float t = f32::heightFogTransmittance(fog, eye, rise * distance, distance);
                ASSERT_TRUE(t >= 1 - 0.9f && t <= 1)
                    << t << ": density " << density << ", falloff " << falloff << ", start " << start << ", distance "
                    << distance << ", eye " << eye << ", rise " << rise;
                const f16::HeightFog half{density, falloff, height, start, 0.9f};
                const float h = float(f16::heightFogTransmittance(half, eye, rise * distance, distance));
                ASSERT_TRUE(h >= 0.0999f && h <= 1) << h;
              }
}

TEST(HeightFog, IsThickBelowTheLayerAndNoneFarAboveIt) {
  const f32::HeightFog fog{0.01f, 1.f, 0.f, 0.f, 1.f};
  EXPECT_LT(f32::heightFogTransmittance(fog, -500.f, 0.f, 1.f), 1e-30f);
  EXPECT_EQ(f32::heightFogTransmittance(fog, 500.f, 0.f, 1000.f), 1.f);
  EXPECT_LT(f32::heightFogTransmittance(fog, 500.f, -1000.f, 1000.f), 1e-30f) << "down into it";
}

} // namespace
} // namespace parity::tests
