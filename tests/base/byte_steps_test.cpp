// Bytes by a table of steps are those of the function, at each step to the last bit.
#include "base/image/byte_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace parity::base {
namespace {

using ByteOf = std::uint8_t (*)(float);

std::uint8_t toByte(double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 1.0) * 255 + 0.5); }

std::uint8_t srgb(float v) { // IEC 61966-2-1
  return toByte(v <= 0.0031308f ? 12.92 * v : 1.055 * std::pow(static_cast<double>(v), 1 / 2.4) - 0.055);
}
std::uint8_t linear(float v) { return toByte(v); }
std::uint8_t steep(float v) { return toByte(v * 300.0); }                // many steps between neighbours of the table
std::uint8_t coarse(float v) { return v >= 0.5f ? 255 : v > 0 ? 9 : 0; } // most bytes are never shown

ByteSteps stepsOf(ByteOf byteOf) {
  return ByteSteps([&](std::span<const float> values, std::span<std::uint8_t> bytes) {
    std::ranges::transform(values, bytes.begin(), byteOf);
  });
}

TEST(ByteSteps, GiveTheBytesOfTheFunctionBesideEveryStep) {
  for (const ByteOf byteOf : {srgb, linear, steep, coarse}) {
    const ByteSteps steps = stepsOf(byteOf);
    for (unsigned byte = 1; byte < 256; ++byte) {
      float below = 0, above = 1;
      for (float middle = 0.5f; std::nextafter(below, 1.f) < above; middle = below + (above - below) / 2)
        (byteOf(middle) >= byte ? above : below) = middle;
      for (int i = 0; i < 9; ++i, below = std::nextafter(below, -1.f))
        ASSERT_EQ(steps(below), byteOf(std::max(below, 0.f))) << byte << " at " << below;
      for (int i = 0; i < 9; ++i, above = std::nextafter(above, 2.f)) ASSERT_EQ(steps(above), byteOf(above)) << byte;
    }
  }
}

TEST(ByteSteps, GiveTheBytesOfTheFunctionForAnyNumber) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> log2(-30.f, 4.f);
  for (const ByteOf byteOf : {srgb, linear, steep, coarse}) {
    const ByteSteps steps = stepsOf(byteOf);
    for (int i = 0; i < 200000; ++i) {
      const float value = std::exp2(log2(random));
      ASSERT_EQ(steps(value), byteOf(value)) << value;
      ASSERT_EQ(steps(-value), 0);
    }
    constexpr float kInfinity = std::numeric_limits<float>::infinity(), kLeast = 1e-45f;
    EXPECT_EQ(steps(kInfinity), 255);
    EXPECT_EQ(steps(-kInfinity), 0);
    EXPECT_EQ(steps(std::numeric_limits<float>::quiet_NaN()), 0);
    for (const float value : {0.f, -0.f, kLeast, 1.f, std::nextafter(1.f, 0.f), 3e38f})
      EXPECT_EQ(steps(value), byteOf(std::max(value, 0.f))) << value;
  }
}

} // namespace
} // namespace parity::base
