// The pieces of the mobile base pass against the sources' formulas, written out again, and at the ends of their ranges.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f32 = shading::f32;
namespace f16 = shading::f16;
using shading::Half;

const float kInf = std::numeric_limits<float>::infinity();
const float kNan = std::numeric_limits<float>::quiet_NaN();

f64::MobileMaterial copper() {
  f64::MobileMaterial m;
  m.BaseColor = {0.9, 0.5, 0.25};
  m.Metallic = 0.75;
  m.DielectricSpecular = {0.04, 0.04, 0.04};
  m.F90 = 1;
  m.Roughness = 0.4;
  return m;
}

TEST(Narrow, SaturatesAtTheLargestHalfAndKeepsNan) {
  EXPECT_EQ(float(f16::narrow(1e6f)), 65504);
  EXPECT_EQ(float(f16::narrow(kInf)), 65504);
  EXPECT_TRUE(std::isnan(float(f16::narrow(kNan))));
  EXPECT_EQ(float(f16::narrow(1e-9f)), 0) << "a denormal light is none";
  EXPECT_EQ(f32::narrow(kInf), std::numeric_limits<float>::max());
  EXPECT_EQ(f32::narrow(1e6f), 1e6f);
}

// UE4, MobileShadingModels.ush: the three colours of the context.
TEST(MobileShadingModelContext, HasTheColoursOfTheSource) {
  const f64::MobileMaterial m = copper();
  const double NoV = 0.6;
  const f64::MobileShadingModelContext c = f64::initShadingModelContext(f64::kEnvironmentBrdfUE4, false, false, m, NoV);
  EXPECT_NEAR(c.DiffuseColor.x, 0.9 - 0.9 * 0.75, 1e-15);
  EXPECT_NEAR(c.SpecPreEnvBrdf.y, (0.04 - 0.04 * 0.75) + 0.5 * 0.75, 1e-15);
  const double R = 0.4, rx = 1 - R, ry = 0.0425 - 0.0275 * R, rz = 1.04 - 0.572 * R, rw = -0.04 + 0.022 * R;
  const double a004 = std::min(rx * rx, std::exp2(-9.28 * NoV)) * rx + ry;
  EXPECT_NEAR(c.SpecularColor.z, c.SpecPreEnvBrdf.z * (-1.04 * a004 + rz) + (1.04 * a004 + rw), 1e-15);
}

TEST(MobileShadingModelContext, NonmetalAndFullyRoughTakeTheirShortcuts) {
  const f64::MobileMaterial m = copper();
  const auto nonmetal = f64::initShadingModelContext(f64::kEnvironmentBrdfUE4, true, false, m, 0.3);
  EXPECT_EQ(nonmetal.SpecularColor.x, f64::EnvBRDFApproxNonmetal(0.4, 0.3));
  const auto rough = f64::initShadingModelContext(f64::kEnvironmentBrdfUE4, false, true, m, 0.3);
  EXPECT_EQ(rough.SpecularColor.x, 0);
  EXPECT_EQ(rough.Roughness, 1);
  EXPECT_NEAR(rough.DiffuseColor.x, 0.225 + 0.45 * rough.SpecPreEnvBrdf.x, 1e-15);
}

// Below 2 % the UE4 form fades specular out: at 0 it is off, where Karis 2014 leaves B.
TEST(MobileShadingModelContext, SpecularOfZeroIsOffInUe4Alone) {
  f64::MobileMaterial black = copper();
  black.BaseColor = {0, 0, 0};
  black.Metallic = 1;
  EXPECT_EQ(f64::initShadingModelContext(f64::kEnvironmentBrdfUE4, false, false, black, 0.2).SpecularColor.y, 0);
  EXPECT_GT(f64::initShadingModelContext(f64::kEnvironmentBrdfKaris2014, false, false, black, 0.2).SpecularColor.y,
            0.02);
}

TEST(MobileIntegrateBxDF, IsSpecularColorTimesNoLTimesTheLobe) {
  f64::MobileShadingModelContext c =
      f64::initShadingModelContext(f64::kEnvironmentBrdfUE4, false, false, copper(), 0.8);
  const f64::MobileFrame frame = f64::mobileFrame({0, 0, 1}, {0.6, 0, 0.8});
  const f64::real3 R = frame.reflection, L(0, 0.6, 0.8);
  EXPECT_NEAR(R.x, -0.6, 1e-15);
  EXPECT_NEAR(R.z, 0.8, 1e-15);
  const double RoL = 0.64, NoH = 1.6 / std::sqrt(0.36 + 0.36 + 2.56);
  const auto ue4 = f64::mobileIntegrateBxDF(f64::kSunCalcSpecular, false, c, frame, L);
  const double a = 0.16, p = a / (1 - NoH * NoH + NoH * a * NoH * a);
  EXPECT_NEAR(ue4.Specular.x, c.SpecularColor.x * 0.8 * (0.4 * 0.25 + 0.25) * p * p, 1e-14);
  EXPECT_NEAR(ue4.Diffuse.y, c.DiffuseColor.y * 0.8, 1e-15);
  const auto karis = f64::mobileIntegrateBxDF(f64::kSunDApprox, false, c, frame, L);
  const double k = 0.72134752 / (a * a) + 0.39674113;
  EXPECT_NEAR(karis.Specular.x, c.SpecularColor.x * 0.8 * std::exp2(k * RoL - k) / (a * a), 1e-14);
  const auto engine = f64::mobileIntegrateBxDF(f64::kSunPhongApprox, false, c, frame, L);
  EXPECT_NEAR(engine.Specular.x, karis.Specular.x, 1e-14);
}

// The engine cuts R.L off at 0, the article does not: beyond a right angle its lobe goes no lower.
TEST(MobileIntegrateBxDF, GivesPhongApproxNoCosineBelowZero) {
  f64::MobileMaterial rough = copper();
  rough.Roughness = 1;
  const f64::MobileShadingModelContext c = f64::initShadingModelContext(0, false, false, rough, 0.28);
  const f64::MobileFrame frame = f64::mobileFrame({0, 0, 1}, {0.96, 0, 0.28});
  const f64::real3 L(0.8, 0, 0.6); // R = (-.96, 0, .28): R.L = -.6
  const auto lit = f64::mobileIntegrateBxDF(f64::kSunPhongApprox, false, c, frame, L);
  EXPECT_NEAR(lit.Specular.y, c.SpecularColor.y * 0.6 * std::exp2(-(0.72134752 + 0.39674113)), 1e-14);
  EXPECT_LT(f64::mobileIntegrateBxDF(f64::kSunDApprox, false, c, frame, L).Specular.y, 0.7 * lit.Specular.y);
}

// What --term EnvBRDF.A and .B show is what the lobe is made of, preset by preset.
TEST(EnvironmentBrdfAB, IsWhatSpecularColorIsMadeOf) {
  for (const int form : {f64::kEnvironmentBrdfKaris2014, f64::kEnvironmentBrdfUE4, f64::kEnvironmentBrdfRefit})
    for (const double roughness : {0.1, 0.5, 1.0})
      for (const double NoV : {0.1, 0.6, 1.0}) {
        f64::MobileMaterial m = copper();
        m.Roughness = roughness;
        const auto c = f64::initShadingModelContext(form, false, false, m, NoV);
        const f64::real2 AB = f64::environmentBrdfAB(form, false, c.SpecPreEnvBrdf, roughness, NoV);
        EXPECT_NEAR(c.SpecularColor.x, c.SpecPreEnvBrdf.x * AB.x + AB.y, 1e-12) << form;
        EXPECT_NEAR(c.SpecularColor.z, c.SpecPreEnvBrdf.z * AB.x + AB.y, 1e-12) << form;
      }
  EXPECT_EQ(f64::environmentBrdfAB(f64::kEnvironmentBrdfUE4, false, {0, 0, 0}, 0.5, 0.5).y, 0) << "faded out";
  EXPECT_EQ(f64::environmentBrdfAB(f64::kEnvironmentBrdfUE4, true, {1, 1, 1}, 0.5, 0.5).x, 0.45) << "fully rough";
}

// docs/shading.md 8: N flipped, direct light 0; V = -L, H = N.
TEST(MobileIntegrateBxDF, GivesNothingFromBehindAndSurvivesLightAgainstTheView) {
  const f64::MobileShadingModelContext c = f64::initShadingModelContext(1, false, false, copper(), 1);
  const f64::MobileFrame frame = f64::mobileFrame({0, 0, 1}, {0, 0, 1});
  const f64::real3 L(0, 0, -1);
  const auto behind = f64::mobileIntegrateBxDF(f64::kSunCalcSpecular, false, c, frame, L);
  EXPECT_EQ(behind.Specular.x + behind.Diffuse.x, 0);
  EXPECT_EQ(f64::halfVector(frame.N, frame.V, L).z, 1);
}

TEST(LightWith, SaturatesInHalf) {
  f16::MobileDirectLighting lighting;
  lighting.Diffuse = {Half(0.5), Half(0.5), Half(0)};
  lighting.Specular = {Half(100), Half(0), Half(0)};
  const f16::real3 lit = f16::lightWith({1e6f, 10, 1e6f}, lighting, Half(1));
  EXPECT_EQ(float(lit.x), 65504);
  EXPECT_EQ(float(lit.y), 5);
  EXPECT_EQ(float(lit.z), 0);
}

const f64::MixingRange kMixing = f64::mixingRange(f64::kMixingBegin, f64::kMixingEnd, f64::kMixingLargest);

TEST(CaptureScale, IsOneOfTheSkylightTheWholeWeightOfKarisAndOcclusionOfOurs) {
  EXPECT_EQ(f64::captureScale(f64::kCaptureScaleSky, 0.1, 5, 1, 0.7, kMixing), 1);
  EXPECT_DOUBLE_EQ(f64::captureScale(f64::kCaptureScaleFull, 0.5, 2, 0.1, 0.7, kMixing), 0.25);
  EXPECT_EQ(f64::captureScale(f64::kCaptureScaleOcclusion, 0.5, 2, 0.5, 0.7, kMixing), 0.7);
}

// docs/shading.md 7d, by the engine's own steps, in numbers: scale 5, bias -.5.
TEST(CaptureScale, MixingIsWholeFromTheEndOnAndAbsentUpToTheBegin) {
  EXPECT_NEAR(kMixing.scale, 5, 1e-12);
  EXPECT_NEAR(kMixing.bias, -0.5, 1e-12);
  const auto weight = [](double R) { return f64::captureScale(f64::kCaptureScaleMixing, 0.5, 2, R, 0.7, kMixing); };
  for (const double R : {0.0, 0.05, 0.1}) EXPECT_NEAR(weight(R), 1, 1e-12) << R;
  for (const double R : {0.3, 0.5, 1.0}) EXPECT_NEAR(weight(R), 0.25, 1e-12) << R;
  // x = .25 and .5: 3 x^2 - 2 x^3 = .15625 and .5.
  EXPECT_NEAR(weight(0.15), 1 - 0.75 * 0.15625, 1e-12);
  EXPECT_NEAR(weight(0.2), 1 - 0.75 * 0.5, 1e-12);
}

TEST(CaptureScale, MixingObeysItsRangeAndItsLargestWeight) {
  const f64::MixingRange wide = f64::mixingRange(0, 1, 3);
  EXPECT_NEAR(f64::captureScale(f64::kCaptureScaleMixing, 0.5, 2, 0.5, 1, wide), 0.625, 1e-12); // smoothstep(R)
  EXPECT_NEAR(f64::captureScale(f64::kCaptureScaleMixing, 8, 2, 1, 1, wide), 3, 1e-12) << "of 4";
  EXPECT_NEAR(f64::captureScale(f64::kCaptureScaleMixing, 8, 0, 1, 1, kMixing), 10000, 1e-9) << "of 80000";
  EXPECT_NEAR(f64::captureScale(f64::kCaptureScaleMixing, 1e-3, 0, 1, 1, kMixing), 10, 1e-9) << "cut off at 1e-4";
}

// In half the weight is what double makes of it, to the half's own steps: of the roughness (5 / 2^12 of the step's
// argument, times its steepest slope of 1.5) and of the weight.
TEST(CaptureScale, MixingInHalfIsWithinItsRounding) {
  const f16::MixingRange mixing = f16::mixingRange(0.1f, 0.3f, 10000);
  for (double R = 0; R <= 1; R += 1.0 / 64)
    for (const double irradiance : {0.25, 1.0, 6.0}) {
      const double expected = f64::captureScale(f64::kCaptureScaleMixing, irradiance, 2, R, 1, kMixing);
      const Half actual = f16::captureScale(f16::kCaptureScaleMixing, Half(irradiance), 2, Half(R), Half(1), mixing);
      EXPECT_NEAR(float(actual), expected, 4e-3 * std::max(1.0, irradiance)) << R << ", " << irradiance;
    }
}

// docs/shading.md 8: "Average brightness 0: guarded", and what is black stays black.
TEST(CaptureScale, OfABlackCaptureIsFiniteAndItsReflectionBlack) {
  const Half scale = f16::captureScale(f16::kCaptureScaleFull, Half(60000), 0, Half(1), Half(1), {});
  EXPECT_EQ(float(scale), 65504);
  const f16::real3 ibl = f16::specularIBL({Half(0), Half(200), Half(1)}, scale);
  EXPECT_EQ(float(ibl.x), 0);
  EXPECT_EQ(float(ibl.y), 65504);
  EXPECT_EQ(float(f16::modulate(ibl, {Half(1), Half(0), Half(1)}).y), 0) << "0 times what saturated";
}

TEST(LuminanceUE4, HasTheEnginesWeights) {
  EXPECT_NEAR(f64::luminanceUE4({1, 0, 0}), 0.3, 1e-15);
  EXPECT_NEAR(f64::luminanceUE4({0, 1, 0}), 0.59, 1e-15);
  EXPECT_NEAR(f64::luminanceUE4({1, 1, 1}), 1, 1e-15);
}

TEST(LocalLightAt, AttenuatesBySquareWindowConeAndPi) {
  const double cosInner = std::cos(0.3), cosOuter = std::cos(0.5);
  const auto light = f64::localLightAt(f64::kFalloffUE4, {0, 0, 2}, {10, 20, 30}, 4, 0, true,
                                       {std::sin(0.4), 0, -std::cos(0.4)}, cosInner, cosOuter);
  EXPECT_EQ(light.L.z, 1);
  const double window = 1 - std::pow(0.5, 4), cone = (std::cos(0.4) - cosOuter) / (cosInner - cosOuter);
  EXPECT_NEAR(light.color.y, 20 / std::numbers::pi * window * window / 4.0001 * cone * cone, 1e-12);
  EXPECT_NEAR(f64::localLightAt(f64::kFalloffUE4, {0, 0, 2}, {10, 20, 30}, 0, 0, false, {0, 0, -1}, 0, 0).color.x,
              10 / std::numbers::pi / 4.0001, 1e-12);
  EXPECT_EQ(f64::localLightAt(f64::kFalloffUE4, {0, 0, 5}, {10, 20, 30}, 4, 0, false, {0, 0, -1}, 0, 0).color.x, 0)
      << "out of range";
  const auto at = f64::localLightAt(f64::kFalloffUE4, {0, 0, 0}, {1, 1, 1}, 0, 0, false, {0, 0, -1}, 0, 0);
  EXPECT_NEAR(f64::localLightAt(f64::kFalloffKhr, {0, 0, 2}, {10, 20, 30}, 4, 0, false, {0, 0, -1}, 0, 0).color.x,
              10 / std::numbers::pi * window / 4, 1e-12)
      << "as KHR_lights_punctual";
  EXPECT_EQ(at.L.z, 1) << "at the light itself: from its axis";
  EXPECT_NEAR(at.color.x, 1e4 / std::numbers::pi, 1e-6);
}

} // namespace
} // namespace parity::tests
