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

} // namespace
} // namespace parity::tests
