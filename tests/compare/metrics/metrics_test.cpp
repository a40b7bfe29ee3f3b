// RMSE and PSNR of whole images on closed forms; NaN never passes.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/error.h"
#include "compare/metrics/metrics.h"
#include "error_code.h"

namespace parity::compare {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

TEST(Rmse, ofAConstantOffsetIsTheOffset) {
  const base::Image a(7, 5, 3, 0.25f), b(7, 5, 3, 0.75f);
  EXPECT_DOUBLE_EQ(rmse(a, b), 0.5);
  EXPECT_NEAR(psnr(a, b), 6.020599913, 1e-8); // 10 log10(4)
}

TEST(Rmse, ofOneWrongChannelIsSpreadOverAll) {
  const base::Image a(4, 4, 3);
  base::Image b = a;
  b.at(2, 1)[0] = 1.f;
  EXPECT_DOUBLE_EQ(rmse(a, b), std::sqrt(1. / 48));
  EXPECT_NEAR(psnr(a, b), 10 * std::log10(48.), 1e-9);
}

TEST(Psnr, ofIdenticalImagesIsInfinite) {
  const base::Image image(4, 4, 3, 0.3f);
  EXPECT_EQ(rmse(image, image), 0);
  EXPECT_EQ(psnr(image, image), std::numeric_limits<double>::infinity());
}

TEST(Rmse, unlikeOrNonFiniteImagesAreAnError) {
  const base::Image image(4, 4, 3), bad(4, 4, 3, kNan);
  EXPECT_EQ(test::codeOf([&] { rmse(image, base::Image(4, 5, 3)); }), base::ExitCode::notComparable);
  EXPECT_EQ(test::codeOf([&] { rmse(base::Image(), base::Image()); }), base::ExitCode::notComparable);
  EXPECT_EQ(test::codeOf([&] { rmse(image, bad); }), base::ExitCode::failed);
  EXPECT_EQ(test::codeOf([&] { psnr(bad, bad); }), base::ExitCode::failed);
}

TEST(NonFinite, isCountedPerPixelWithTheFirstInRowOrder) {
  base::Image image(300, 4, 3, -1e38f);
  EXPECT_EQ(countNonFinite(image).count, 0u);
  image.at(7, 3)[0] = kNan;
  image.at(299, 1)[2] = -kInf;
  image.at(299, 1)[1] = kInf;
  image.at(3, 3)[1] = kInf;
  const NonFinite found = countNonFinite(image);
  EXPECT_EQ(found.count, 3u);
  EXPECT_EQ(found.x, 299);
  EXPECT_EQ(found.y, 1);
}

} // namespace
} // namespace parity::compare
