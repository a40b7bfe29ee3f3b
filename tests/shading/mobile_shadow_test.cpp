// The mobile spot light's shadow against its formulas by hand, and at their ends.
#include <limits>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f16 = shading::f16;

TEST(MobileShadow, DarkensOverTheTransitionBehindTheCaster) {
  EXPECT_EQ(f64::shadowmapOcclusion(3.0, 2.9, 10), 1) << "before it";
  EXPECT_EQ(f64::shadowmapOcclusion(3.0, 3.0, 10), 1) << "the caster itself";
  EXPECT_NEAR(f64::shadowmapOcclusion(3.0, 3.025, 10), 0.75, 1e-12);
  EXPECT_NEAR(f64::shadowmapOcclusion(3.0, 3.05, 10), 0.5, 1e-12);
  EXPECT_EQ(f64::shadowmapOcclusion(3.0, 3.1001, 10), 0);
  EXPECT_EQ(f64::shadowmapOcclusion(1e6, 3, 1e4), 1) << "nothing in the map";
}

TEST(MobileShadow, KeepsCentimetresAThousandMetresAwayInHalf) {
  EXPECT_NEAR(float(f16::shadowmapOcclusion(1000.f, 1000.0625f, 10.f)), 0.375, 1e-3);
}

TEST(MobileShadow, IsSharpenedAboutTheMiddleSquaredAndFaded) {
  EXPECT_NEAR(f64::sharpenedShadow(0.5, 1, 1), 0.25, 1e-12);
  EXPECT_NEAR(f64::sharpenedShadow(0.6, 2, 1), 0.7 * 0.7, 1e-12);
  EXPECT_EQ(f64::sharpenedShadow(0.2, 4, 1), 0);
  EXPECT_EQ(f64::sharpenedShadow(0.9, 4, 1), 1);
  EXPECT_NEAR(f64::sharpenedShadow(0.5, 1, 0.4), 1 + 0.4 * (0.25 - 1), 1e-12);
  EXPECT_EQ(f64::sharpenedShadow(0, 1, 0), 1) << "faded out";
}

// The engine's sun of 200 m and its .1: whole up to 180 m, gone from 200 m, in between the square of the way.
TEST(MobileShadow, OfTheSunFadesOverTheLastShareOfItsDistance) {
  const f64::DistanceFade MAD = f64::distanceFadeMAD(200, 0.1);
  EXPECT_NEAR(MAD.x, 1 / 20.0, 1e-12);
  EXPECT_NEAR(MAD.y, -9, 1e-12);
  for (const auto& [depth, fade] : {std::pair{1.0, 0.0}, {180, 0}, {185, 0.25}, {190, 0.5}, {200, 1}, {1000, 1}}) {
    EXPECT_NEAR(f64::distanceFadedShadow(0, depth, MAD), fade * fade, 1e-12) << depth;
    EXPECT_NEAR(f64::distanceFadedShadow(0.6, depth, MAD), 0.6 + 0.4 * fade * fade, 1e-12) << depth;
    EXPECT_EQ(f64::distanceFadedShadow(1, depth, MAD), 1) << "lit stays lit";
  }
}

TEST(MobileShadow, OfTheSunIsCutOffWhereTheFadeHasNoLengthAndFadesFromTheEyeWhereItHasAll) {
  const auto edge = shading::f32::distanceFadeMAD(50, 0);
  EXPECT_EQ(shading::f32::distanceFadedShadow(0, 49.99f, edge), 0);
  EXPECT_EQ(shading::f32::distanceFadedShadow(0, 50.01f, edge), 1);
  const auto whole = f64::distanceFadeMAD(50, 1);
  EXPECT_NEAR(f64::distanceFadedShadow(0, 25, whole), 0.25, 1e-12);
}

// The depth is no half: at 1999 m halves are a metre apart.
TEST(MobileShadow, FadesByMetresFarAwayInHalf) {
  const auto MAD = f16::distanceFadeMAD(2000, 0.001f);
  EXPECT_NEAR(float(f16::distanceFadedShadow(shading::Half(0), 1999.25f, MAD)), 0.625 * 0.625, 1e-3);
}

} // namespace
} // namespace parity::tests
