// Where on a material its error lies: planted errors.
#include "study/explain/ranges.h"

#include <gtest/gtest.h>

namespace parity::explain {
namespace {

// Sixteen pixels; the quantity is i / 16.
base::Image ramp() {
  base::Image image(16, 1, 3);
  for (std::size_t i = 0; i < 16; ++i) image.pixels[3 * i] = static_cast<float>(i) / 16;
  return image;
}
base::PixelList all() {
  base::PixelList list{"m", {}, {}};
  for (std::uint32_t i = 0; i < 16; ++i) list.pixels.push_back(i);
  return list;
}

TEST(Ranges, FindThePlantedPart) {
  std::vector<float> errors(16, 0.01f);
  errors[0] = errors[1] = 0.5f; // below .1
  const std::vector<RangeShare> shares = sharesOf("roughness", all(), ramp(), errors);
  double pixels = 0, error = 0;
  for (const RangeShare& share : shares) pixels += share.pixels, error += share.error;
  EXPECT_NEAR(pixels, 1, 1e-12);
  EXPECT_NEAR(error, 1, 1e-12);
  const auto worst = worstPart(shares);
  ASSERT_TRUE(worst.has_value());
  EXPECT_EQ(worst->quantity, "roughness");
  EXPECT_EQ(worst->from, 0);
  EXPECT_NEAR(worst->to, 0.1, 1e-12);
  EXPECT_NEAR(worst->pixels, 2.0 / 16, 1e-12);
  EXPECT_NEAR(worst->error, 1 / 1.14, 1e-6);
}

TEST(Ranges, FindItAtTheOtherEndAndByItsWeights) {
  std::vector<float> errors(16, 0.1f);
  errors[15] = 10;
  base::PixelList list = all();
  list.weights.assign(16, 1.f);
  const auto worst = worstPart(sharesOf("N.V", list, ramp(), errors));
  ASSERT_TRUE(worst.has_value());
  EXPECT_NEAR(worst->from, 0.9, 1e-12);
  EXPECT_EQ(worst->to, 1);
  list.weights[15] = 0.01f; // hardly seen
  EXPECT_FALSE(worstPart(sharesOf("N.V", list, ramp(), errors)).has_value());
}

TEST(Ranges, AnEvenErrorHasNoWorstPartAndNaNCountsAsZero) {
  EXPECT_FALSE(worstPart(sharesOf("metallic", all(), ramp(), std::vector<float>(16, 0.2f))).has_value());
  base::Image values = ramp();
  values.pixels[0] = NAN;
  values.pixels[3 * 15] = 7;
  const std::vector<RangeShare> shares = sharesOf("metallic", all(), values, std::vector<float>(16, 0.f));
  EXPECT_EQ(shares.front().from, 0);
  EXPECT_EQ(shares.back().to, 1);
  for (const RangeShare& share : shares) EXPECT_EQ(share.error, 0);
}

} // namespace
} // namespace parity::explain
