// The form, against its numbers written out.
#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;

TEST(TintedSky, IsTheFormChannelByChannelAndNotNegative) {
  f64::TintedSky sky;
  sky.c[0] = {1, 2, -0.5};
  sky.c[1] = {0.5, 0, 0};
  sky.c[2] = {0, -1, 0};
  sky.c[3] = {0.25, 0, -2};
  sky.tint = {1, 0, -2};
  const double q[5] = {0.3, -0.7, 1.1, 0.9, -0.4};
  for (int k = 0; k < 5; ++k) sky.q[k] = q[k];
  const double x = 0.48, y = -0.6, z = 0.64;
  const double form = 0.3 * x * x - 0.7 * x * y + 1.1 * x * z + 0.9 * y * y - 0.4 * y * z;
  const f64::real3 e = f64::tintedSkyDiffuse(sky, {x, y, z});
  EXPECT_NEAR(e.x, 1 + 0.5 * x + 0.25 * z + form, 1e-14);
  EXPECT_NEAR(e.y, 2 - y, 1e-14) << "no tint, no second band";
  ASSERT_LT(-0.5 - 2 * z - 2 * form, 0);
  EXPECT_EQ(e.z, 0);
}

} // namespace
} // namespace parity::tests
