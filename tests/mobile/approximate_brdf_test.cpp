// The mobile path's environment BRDF in double against the article's constants.
#include "mobile/approximate_brdf.h"

#include <cmath>

#include <gtest/gtest.h>

namespace parity::mobile {
namespace {

constexpr double kRoughness[] = {0.1, 0.3, 0.5, 0.8, 1}, kCosines[] = {0.08, 0.3, 0.6, 1};

// The article's function, its constants written out here.
double articleAt(double R, double N, double F0) {
  const double rx = 1 - R, ry = 0.0425 - 0.0275 * R, rz = 1.04 - 0.572 * R, rw = 0.022 * R - 0.04;
  const double a004 = std::min(rx * rx, std::exp2(-9.28 * N)) * rx + ry;
  return F0 * (rz - 1.04 * a004) + 1.04 * a004 + rw;
}

TEST(ApproximateBrdf, IsThePresetsOwn) {
  const ApproximateBrdf karis(presetByName("karis2014")), ue4(presetByName("ue4-2020"));
  for (const double roughness : kRoughness)
    for (const double NoV : kCosines) {
      for (const double F0 : {0.04, 1.0})
        for (const ApproximateBrdf* brdf : {&karis, &ue4})
          EXPECT_NEAR(brdf->once(roughness, NoV, glm::dvec3(F0)).x, articleAt(roughness, NoV, F0), 1e-6);
      EXPECT_NEAR(karis.at(roughness, NoV).A + karis.at(roughness, NoV).B, 1 - 0.55 * roughness, 1e-6);
      EXPECT_EQ(karis.multiple(roughness, NoV, glm::dvec3(1)).x, 0);
    }
  EXPECT_EQ(ue4.once(0.4, 0.5, glm::dvec3(0)).y, 0) << "B is off where F0 is 0";
  EXPECT_GT(karis.once(0.4, 0.5, glm::dvec3(0)).y, 0.01);
  // The preset's roughness floor.
  EXPECT_EQ(ue4.at(0, 0.3).A, ue4.at(0.015625, 0.3).A);
  EXPECT_NE(karis.at(0, 0.3).A, karis.at(0.015625, 0.3).A);
  // In a white furnace what is missing once comes back.
  const ApproximateBrdf refit(presetByName("refit"));
  EXPECT_NEAR(refit.once(0.8, 0.5, glm::dvec3(1)).x + refit.multiple(0.8, 0.5, glm::dvec3(1)).x, 1, 1e-9);
}

TEST(ApproximateBrdf, OfAMaterialTakesTheFormThatThePathTakes) {
  const ApproximateBrdf ue4(presetByName("ue4-2020"));
  paths::EnvBrdfMaterial m{.baseColor = {0.5, 0.25, 1}, .metallic = 0, .roughness = 0.5};
  EXPECT_NEAR(ue4.once(m, 0.4).x, articleAt(0.5, 0.4, 0.04), 1e-6);
  EXPECT_EQ(ue4.form(m), "general");
  m.nonmetal = true;
  const double a004 = std::min(0.25, std::exp2(-9.28 * 0.4)) * 0.5 + 0.0425 - 0.0275 * 0.5;
  EXPECT_NEAR(ue4.once(m, 0.4).x, a004, 1e-6) << "EnvBRDFApproxNonmetal";
  EXPECT_EQ(ue4.form(m), "nonmetal");
  m.fullyRough = true;
  EXPECT_NEAR(ue4.once(m, 0.4).x, 0.45 * 0.04, 1e-12);
  EXPECT_EQ(ue4.form(m), "fully rough");
}

} // namespace
} // namespace parity::mobile
