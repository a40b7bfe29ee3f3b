// The same functions in fp32 and fp16: fp32 against fp64, and the hazards of half precision as results (docs/shading.md
// 4).
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "shading/shading.h"
#include "study/stress/function_table.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f16 = shading::f16;
using shading::Half;
using namespace stress;

float dApproxHalf(double roughness, double RoL) { return float(f16::D_Approx(Half(roughness), Half(RoL))); }

// Every half in [low, high], by bits: halves of one sign are ordered like their patterns.
template <typename F> void forHalvesBetween(double low, double high, F f) {
  for (unsigned bits = Half(low).bits(); bits <= Half(high).bits(); ++bits)
    f(double(float(Half::fromBits(static_cast<std::uint16_t>(bits)))));
}

// fp32 differs from fp64 by rounding alone. Where the conditioning is worse than that, the table says what is lost.
TEST(Fp32, AgreesWithFp64OnEveryFunction) {
  struct Loss {
    int id;
    double relative; // of max(|value|, 1)
  };
  const Loss losses[] = {
      {kFnD_Approx, 2e-3},     // exp2(c RoL - c) with c up to 5e4: half an ulp of c RoL is 1.4e-3 of the result
      {kFnPhongApprox, 2e-3},  // the same with c up to 1.1e4
      {kFnMobileShadow, 1e-5}, // a depth over a twentieth of itself
      {kFnGGX_Mobile, 2e-3},   // 1 - NoH^2 cancels near the peak
      {kFnCalcSpecular, 2e-3},
      {kFnSpotAttenuation, 2e-3}, // divided by as little as 0.001
      {kFnMobileIntegrateBxDF, 2e-3},
      {kFnLocalLightAt, 2e-3}, // which contain them
      {kFnClampContribution65000, 1e-6},
      {kFnHeightFogTransmittance, 1e-5}, // heights of 100 m times a falloff of 8 are an exponent
      {kFnGetLightMapColorLQ,
       3e-5}, // LogL of up to 2: half an ulp of 16 LogL is 7e-7 of the result, and LogL's own 1e-5
      {kFnLightmapRoundTrip, 5e-6},
      {kFnEncodeLightmapSh, 1e-5}, // 1 / D, of a D that cancels down to 1/64
  };
  for (const FunctionCase& function : functionTable()) {
    if (function.id == kFnConstants) continue; // kSmallest and kLargest differ on purpose
    double limit = 2e-6;
    for (const Loss& loss : losses)
      if (loss.id == function.id) limit = loss.relative;
    // By the name (FNV-1a, 32 bits): another function's number does not change what this one is tried with.
    std::uint32_t seed = 2166136261u;
    for (const char c : std::string(function.name)) seed = (seed ^ static_cast<unsigned char>(c)) * 16777619u;
    Random random(seed);
    double worst = 0;
    for (int i = 0; i < 4000; ++i) {
      Row row = function.makeRow(random);
      for (double& x : row) x = static_cast<float>(x);
      const Result exact = evaluate64(function.id, row), actual = evaluate32(function.id, row);
      for (int k = 0; k < kOutputs; ++k) {
        if (actual[k] == exact[k]) continue;
        const double error = std::fabs(actual[k] - exact[k]) / std::max(1.0, std::fabs(exact[k]));
        // Guards act at each precision's own kSmallest: beyond 1e18 a value is one of theirs.
        if (std::fabs(exact[k]) > 1e18 && std::fabs(actual[k]) > 1e18) continue;
        worst = std::isnan(error) ? std::numeric_limits<double>::infinity() : std::max(worst, error);
      }
    }
    EXPECT_LE(worst, limit) << function.name;
  }
}

// "D_Approx with the article's types: inf for R <= .0625 at RoL=1, NaN for R <= .0574 (c*RoL-c = inf-inf)".
TEST(Fp16, DApproxOverflowsWhereTheArticlesTypesDo) {
  forHalvesBetween(1e-3, 0.0574, [](double R) { EXPECT_TRUE(std::isnan(dApproxHalf(R, 1))) << R; });
  forHalvesBetween(0.0576, 0.0625, [](double R) { EXPECT_TRUE(std::isinf(dApproxHalf(R, 1))) << R; });
  forHalvesBetween(0.0626, 1, [](double R) { EXPECT_TRUE(std::isfinite(dApproxHalf(R, 1))) << R; });
  EXPECT_TRUE(std::isnan(dApproxHalf(0.015625, 1))) << "UE4's roughness floor is not enough";
}

// "half RoL: banding: adjacent-step ratio 11.5 at R=.1, 1.62 at .15, 1.165 at .2, 1.03 at .3"
TEST(Fp16, HalfReflectionCosinesBandASmoothHighlight) {
  struct Step {
    double roughness, ratio, tolerance;
  };
  const double below = 1 - 0x1p-11; // the half next to 1
  for (const Step& step : {Step{0.1, 11.5, 0.1}, {0.15, 1.62, 0.01}, {0.2, 1.165, 0.002}, {0.3, 1.03, 0.005}})
    EXPECT_NEAR(f64::D_Approx(step.roughness, 1) / f64::D_Approx(step.roughness, below), step.ratio, step.tolerance);
}

// "GGX, fp32 NoH, the rest half: fine for R >= .08; inf for R <= .06": the clamp turns inf into 2048.
TEST(Fp16, GgxMobileWithAFullPrecisionCosineIsFineFromRoughness008) {
  double worst = 0;
  forHalvesBetween(0.08, 1, [&](double R) {
    for (int i = 0; i <= 40; ++i) { // across the lobe: 1 - NoH in units of its width
      const double NoH = static_cast<float>(std::max(0.0, 1 - 0.1 * i * std::pow(R, 4)));
      const double exact = f64::GGX_Mobile(R, NoH);
      worst = std::max(worst, std::fabs(float(f16::GGX_Mobile(Half(R), static_cast<float>(NoH))) / exact - 1));
    }
  });
  EXPECT_LT(worst, 0.05);
  forHalvesBetween(0.015625, 0.06, [](double R) { EXPECT_EQ(float(f16::GGX_Mobile(Half(R), 1)), 2048) << R; });
}

// "R=0, NoH=1: 0/0; min(NaN, 2048) is 2048 only where min drops NaN": GLSL's definition of min keeps it.
TEST(Fp16, GgxMobileOfAMirrorIsNanWithoutTheRoughnessFloor) {
  EXPECT_TRUE(std::isnan(float(f16::GGX_Mobile(Half(0), 1))));
  EXPECT_TRUE(std::isnan(f64::GGX_Mobile(0, 1)));
  EXPECT_EQ(f64::GGX_Mobile(0.015625, 1), 2048);
}

// "EnvBRDFApprox: safe, <= .5 % relative". A dielectric, where B can be negative (-0.0024), is held to the same of
// 0.04.
TEST(Fp16, EnvBrdfApproxIsSafeEverywhere) {
  double worstMetal = 0, worstDielectric = 0;
  for (int i = 0; i <= 200; ++i)
    for (int k = 0; k <= 200; ++k) {
      const Half R(i / 200.0), N(k / 200.0), one(1), four(0.04);
      const double metal = f64::EnvBRDFApprox({1, 1, 1}, float(R), float(N)).x;
      const double dielectric = f64::EnvBRDFApprox({float(four), 0, 0}, float(R), float(N)).x;
      const float metal16 = float(f16::EnvBRDFApprox({one, one, one}, R, N).x);
      const float dielectric16 = float(f16::EnvBRDFApprox({four, Half(0), Half(0)}, R, N).x);
      ASSERT_TRUE(std::isfinite(metal16) && std::isfinite(dielectric16));
      worstMetal = std::max(worstMetal, std::fabs(metal16 / metal - 1));
      worstDielectric = std::max(worstDielectric, std::fabs(dielectric16 - dielectric));
    }
  EXPECT_LE(worstMetal, 5e-3);
  EXPECT_LE(worstDielectric, 2e-3);
}

// "Smith visibility * NoL: inf/NaN where both cosines <= .03" for the plain form; ours is guarded. Roughness from the
// half floor of alpha^2 (0.088) on keeps the peak, below it D_GGX is low but finite.
TEST(Fp16, MicrofacetFunctionsAreFiniteOverTheirWholeDomain) {
  for (int i = 0; i <= 64; ++i)
    for (int k = 0; k <= 64; ++k)
      for (int m = 0; m <= 64; ++m) {
        const Half R(i / 64.0), alpha = R * R, NoV(k / 64.0), NoL(m / 64.0);
        const float smith = float(f16::V_SmithGGXCorrelated(alpha, NoV, NoL) * NoL);
        const float schlick = float(f16::V_SchlickSmith(alpha, NoV, NoL) * NoL);
        ASSERT_TRUE(std::isfinite(smith) && smith >= 0) << i << ", " << k << ", " << m;
        ASSERT_TRUE(std::isfinite(schlick) && schlick >= 0) << i << ", " << k << ", " << m;
        ASSERT_TRUE(std::isfinite(float(f16::D_GGX(alpha, NoL))));
      }
  const Half alpha(0.1 * 0.1);
  EXPECT_NEAR(float(f16::D_GGX(alpha, Half(1))) / f64::D_GGX(float(alpha), 1), 1, 5e-3);
  const Half low(0.05 * 0.05);
  EXPECT_LT(float(f16::D_GGX(low, Half(1))) / f64::D_GGX(float(low), 1), 0.1);
}

} // namespace
} // namespace parity::tests
