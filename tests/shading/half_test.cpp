// Half against the definition of binary16 and, where the compiler has one, its own half type.
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "shading/half.h"
#include "shading/math.h"

namespace parity::tests {
namespace {

using shading::Half;

// The value of 16 bits by IEEE 754-2008, 3.4.
double valueByTheStandard(unsigned bits) {
  const unsigned exponent = bits >> 10 & 31u, fraction = bits & 1023u;
  const double sign = bits >> 15 ? -1 : 1;
  if (exponent == 31) return fraction != 0 ? std::numeric_limits<double>::quiet_NaN() : sign * INFINITY;
  return exponent == 0 ? sign * std::ldexp(fraction, -24)
                       : sign * std::ldexp(1024 + fraction, static_cast<int>(exponent) - 25);
}

TEST(Half, EveryPatternMeansWhatTheStandardSaysAndComesBack) {
  for (unsigned bits = 0; bits < 65536; ++bits) {
    const Half h = Half::fromBits(static_cast<std::uint16_t>(bits));
    const double expected = valueByTheStandard(bits);
    if (std::isnan(expected)) {
      EXPECT_TRUE(std::isnan(float(h)));
      EXPECT_TRUE(std::isnan(float(Half(float(h)))));
    } else {
      EXPECT_EQ(float(h), expected);
      EXPECT_EQ(Half(float(h)).bits(), bits);
    }
  }
}

// Between any two neighbours: below the middle goes down, above goes up, the middle goes to the even pattern.
TEST(Half, RoundsToNearestWithTiesToEven) {
  for (unsigned bits = 0; bits < 0x7bff; ++bits) {
    const double low = valueByTheStandard(bits), high = valueByTheStandard(bits + 1), middle = (low + high) / 2;
    EXPECT_EQ(Half(middle).bits(), bits + (bits & 1u));
    EXPECT_EQ(Half(std::nextafter(middle, 0.0)).bits(), bits);
    EXPECT_EQ(Half(std::nextafter(middle, 1e9)).bits(), bits + 1);
    EXPECT_EQ(Half(-middle).bits(), (bits + (bits & 1u)) | 0x8000u);
  }
  EXPECT_EQ(Half(65519.99).bits(), 0x7bff);
  EXPECT_EQ(Half(65520.0).bits(), 0x7c00);
  EXPECT_EQ(Half(1e300).bits(), 0x7c00);
  EXPECT_EQ(Half(1e-300).bits(), 0);
}

// Sums and products of two halves are exact in double, so this is rounding once. Quotients and roots are not: there the
// double's own rounding is 2^42 times finer than the half's.
TEST(Half, OperationsAreRoundedOnce) {
  std::mt19937 random(1);
  for (int i = 0; i < 200000; ++i) {
    const Half a = Half::fromBits(static_cast<std::uint16_t>(random() & 0xffffu));
    const Half b = Half::fromBits(static_cast<std::uint16_t>(random() & 0xffffu));
    const double x = float(a), y = float(b);
    if (std::isnan(x) || std::isnan(y)) continue;
    const auto same = [](Half actual, double expected) {
      return std::isnan(expected) ? std::isnan(float(actual)) : actual.bits() == Half(expected).bits();
    };
    ASSERT_TRUE(same(a + b, x + y)) << x << " + " << y;
    ASSERT_TRUE(same(a - b, x - y)) << x << " - " << y;
    ASSERT_TRUE(same(a * b, x * y)) << x << " * " << y;
    ASSERT_TRUE(same(a / b, x / y)) << x << " / " << y;
    ASSERT_TRUE(same(shading::sqrt(a), std::sqrt(x))) << x;
    ASSERT_EQ(a < b, x < y);
    ASSERT_EQ(a == b, x == y);
  }
}

#ifdef __FLT16_MANT_DIG__
TEST(Half, AgreesWithTheCompilersOwnHalf) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 200000; ++i) {
    const auto value =
        std::bit_cast<double>((random() & ~(std::uint64_t{0x7ff} << 52)) | (std::uint64_t{990} + random() % 60) << 52);
    ASSERT_EQ(Half(value).bits(), std::bit_cast<std::uint16_t>(static_cast<_Float16>(value))) << value;
  }
}
#endif

TEST(Half, LimitsOfEachPrecisionAreItsNormalRange) {
  EXPECT_EQ(float(shading::kSmallestNormal<Half>), 0x1p-14f);
  EXPECT_EQ(float(shading::kLargestFinite<Half>), 65504.0f);
  // What real.glsl relies on: 1/kSmallest is finite.
  EXPECT_TRUE(std::isfinite(float(Half(1) / shading::kSmallestNormal<Half>)));
  EXPECT_TRUE(std::isfinite(1 / shading::kSmallestNormal<float>));
  EXPECT_TRUE(std::isfinite(1 / shading::kSmallestNormal<double>));
}

} // namespace
} // namespace parity::tests
