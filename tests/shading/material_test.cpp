// Material inputs to lighting colours, and the mapping between roughness and mips of the prefiltered cube.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;

TEST(Material, DielectricsReflectTheirSpecularAndKeepTheirColour) {
  EXPECT_DOUBLE_EQ(f64::dielectricSpecular(0.5), 0.04); // glTF's default, index of refraction 1.5: ((n-1)/(n+1))^2
  EXPECT_DOUBLE_EQ(f64::dielectricSpecular(0.5), std::pow(0.5 / 2.5, 2));
  const f64::real3 F0(0.04, 0.05, 0.06), base(0.8, 0.2, 0.1);
  const f64::real3 specular = f64::specularColor(F0, base, 0), diffuse = f64::diffuseColor(base, 0);
  EXPECT_EQ(specular.x, 0.04);
  EXPECT_EQ(specular.z, 0.06);
  EXPECT_EQ(diffuse.x, 0.8);
  EXPECT_EQ(diffuse.y, 0.2);
}

TEST(Material, MetalsReflectTheirColourAndDiffuseNothing) {
  const f64::real3 F0(0.04, 0.04, 0.04), base(0.9, 0.6, 0.2);
  EXPECT_EQ(f64::specularColor(F0, base, 1).x, 0.9);
  EXPECT_EQ(f64::specularColor(F0, base, 1).z, 0.2);
  EXPECT_EQ(f64::diffuseColor(base, 1).x, 0);
  // docs/shading.md 8: metallic 1 over black is exactly 0.
  EXPECT_EQ(f64::specularColor(F0, {0, 0, 0}, 1).y, 0);
  EXPECT_EQ(shading::f32::specularColor({0.04f, 0.04f, 0.04f}, {0, 0, 0}, 1).y, 0);
}

TEST(Material, HalfMetalIsTheMixOfBoth) {
  const f64::real3 specular = f64::specularColor({0.04, 0.04, 0.04}, {1, 0.5, 0}, 0.5);
  EXPECT_DOUBLE_EQ(specular.x, 0.52);
  EXPECT_DOUBLE_EQ(specular.y, 0.27);
  EXPECT_DOUBLE_EQ(specular.z, 0.02);
  EXPECT_DOUBLE_EQ(f64::diffuseColor({1, 0.5, 0}, 0.5).y, 0.25);
}

TEST(Mips, RoughnessOneIsTheRoughestMipAndEachHalvingIs1Point2MipsLess) {
  EXPECT_DOUBLE_EQ(f64::mipFromRoughness(1), f64::kPrefilterRoughestMip);
  EXPECT_DOUBLE_EQ(f64::mipFromRoughness(0.5), 5 - 1.2);
  EXPECT_DOUBLE_EQ(f64::mipFromRoughness(0.25), 5 - 2.4);
}

TEST(Mips, SmoothSurfacesReadTheSharpestMip) {
  EXPECT_EQ(f64::mipFromRoughness(0), 0);
  EXPECT_EQ(f64::mipFromRoughness(0.05), 0);
  EXPECT_GT(f64::mipFromRoughness(0.06), 0);
  EXPECT_EQ(float(shading::f16::mipFromRoughness(shading::Half(0))), 0);
}

// The blend of the two levels' mips, as layer j of mip m stands for mip m + j / layers, is the mip of the roughness.
TEST(Mips, LevelsBetweenMipsEncloseTheRoughness) {
  constexpr int kLast = f64::kPrefilterLayers * f64::kPrefilterRoughestMip;
  for (double R = 0; R <= 1; R += 0.001) {
    const f64::PrefilterBlend blend = f64::prefilterBlend(f64::mipFromRoughness(R));
    ASSERT_GE(blend.lower, 0);
    ASSERT_LE(blend.upper, kLast);
    ASSERT_GE(blend.upperShare, 0);
    ASSERT_LE(blend.upperShare, 1);
    const double level = blend.lower + (blend.upper - blend.lower) * blend.upperShare;
    ASSERT_NEAR(level / f64::kPrefilterLayers, f64::mipFromRoughness(R), 1e-12) << R;
    if (f64::mipFromRoughness(R) < 1) // there is one layer of mip 0
      ASSERT_TRUE(blend.lower == 0 && blend.upper == f64::kPrefilterLayers) << R;
    else
      ASSERT_EQ(blend.upper, blend.lower + 1) << R;
  }
  EXPECT_EQ(f64::prefilterBlend(f64::mipFromRoughness(1)).upper, kLast);
  EXPECT_EQ(f64::prefilterBlend(f64::mipFromRoughness(1)).upperShare, 1);
}

TEST(Mips, FineLevelsEncloseTheRoughnessFromTheSharpestOn) {
  constexpr int kLast = f64::kPrefilterLayers * f64::kPrefilterRoughestMip;
  for (double R = 0; R <= 1; R += 0.001) {
    const double mip = f64::unclampedMip(R);
    const f64::PrefilterBlend blend = f64::finePrefilterBlend(mip);
    ASSERT_TRUE(blend.lower >= 1 && blend.upper == blend.lower + 1 && blend.upper <= kLast) << R;
    ASSERT_TRUE(blend.upperShare >= 0 && blend.upperShare <= 1) << R;
    const double level = blend.lower + blend.upperShare;
    ASSERT_NEAR(level / f64::kPrefilterLayers, std::max(mip, 1. * f64::kSharpestPrefilteredMip), 1e-12) << R;
  }
}

// D of a < a1 is (a / a1)^2 that of a1, far out, and a core: by quadrature of the small-angle lobes 1 / (pi b^2) / (1 +
// theta^2 / b^2)^2, b = 2 a.
TEST(Mips, SharpLobesHaveTheTailOfLevelOneAndTheVarianceOfTheRest) {
  const double sharpest = f64::kSharpestPrefilteredMip, alpha1 = std::pow(f64::roughnessFromMip(sharpest), 2);
  const auto lobe = [](double alpha, double theta) {
    const double b2 = 4 * alpha * alpha;
    return 1 / (std::numbers::pi * b2) / std::pow(1 + theta * theta / b2, 2);
  };
  for (const double mip : {-4.0, -1.0, 0.0, 0.2}) {
    const double alpha = std::pow(f64::roughnessFromMip(mip), 2);
    const f64::SharpLobe sharp = f64::sharpLobe(mip);
    EXPECT_NEAR(sharp.tail * lobe(alpha1, 1) / lobe(alpha, 1), 1, 1e-3) << mip;
    double sum = 0, squares = 0;
    for (double t = -14; t < 6; t += 1e-3) { // theta = e^t
      const double theta = std::exp(t), weight = 2 * std::numbers::pi * theta * theta * 1e-3 *
                                                 (lobe(alpha, theta) - sharp.tail * lobe(alpha1, theta));
      sum += weight;
      squares += weight * theta * theta / 2; // along one axis
    }
    EXPECT_NEAR(sum, 1 - sharp.tail, 1e-3) << mip;
    EXPECT_NEAR(sharp.width / 1.5, std::sqrt(squares / sum), 2e-3 * sharp.width) << mip;
  }
  EXPECT_LT(f64::sharpLobe(f64::unclampedMip(0)).width, 1e-4) << "a mirror reads a cell";
}

TEST(Mips, MappingAndInverseAgree) {
  for (int mip = 0; mip <= 5; ++mip) EXPECT_NEAR(f64::mipFromRoughness(f64::roughnessFromMip(mip)), mip, 1e-12);
  for (double R = 0.06; R <= 1; R += 0.05) EXPECT_NEAR(f64::roughnessFromMip(f64::mipFromRoughness(R)), R, 1e-12);
}

} // namespace
} // namespace parity::tests
