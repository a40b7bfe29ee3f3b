// What each render target makes of a colour, against every number that it can hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "gpu/surface/output_target.h"
#include "shading/shading.h"
#include "support/not_finite.h"

namespace parity::gpu {
namespace {

using tests::kInf, tests::kNan;

// All finite numbers of an unsigned float with 5 exponent bits, by their codes: ascending.
std::vector<double> unsignedFloats(int mantissaBits) {
  std::vector<double> values;
  const int steps = 1 << mantissaBits;
  for (int code = 0; code < 31 * steps; ++code) {
    const int exponent = code / steps, mantissa = code % steps;
    values.push_back(exponent == 0 ? std::ldexp(mantissa, -14 - mantissaBits)
                                   : std::ldexp(steps + mantissa, exponent - 15 - mantissaBits));
  }
  return values;
}

// The nearest of the values, the even code where two are as near.
double nearestOf(const std::vector<double>& values, double x) {
  const auto above = std::lower_bound(values.begin(), values.end(), x);
  if (above == values.begin()) return values.front();
  if (above == values.end()) return values.back();
  const double up = *above - x, down = x - above[-1];
  if (up != down) return up < down ? *above : above[-1];
  return (above - values.begin()) % 2 == 0 ? *above : above[-1];
}

double srgbToLinear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }
double linearToSrgb(double l) { return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055; }

glm::vec3 through(OutputTarget target, const glm::vec3& color, float exposureEv = 0) {
  const TargetCodec codec(target, exposureEv);
  return codec.read(codec.store(codec.write(color)));
}

TEST(UnsignedFloat, RoundsToTheNearestOfAllItsNumbers) {
  for (const int bits : {5, 6}) {
    const std::vector<double> values = unsignedFloats(bits);
    EXPECT_EQ(values.back(), bits == 6 ? 65024 : 64512) << "the specification's own figures";
    std::vector<float> tried;
    for (std::size_t i = 0; i < values.size(); ++i) {
      tried.push_back(static_cast<float>(values[i]));
      if (i == 0) continue;
      const auto middle = static_cast<float>((values[i - 1] + values[i]) / 2); // exact: one bit more
      for (const float x : {middle, std::nextafter(middle, 0.f), std::nextafter(middle, kInf)}) tried.push_back(x);
    }
    std::mt19937 random(3);
    std::uniform_real_distribution<float> exponent(-26, 16);
    for (int i = 0; i < 20000; ++i) tried.push_back(std::exp2(exponent(random)));
    for (const float x : tried)
      ASSERT_EQ(roundToUnsignedFloat(x, bits), nearestOf(values, x)) << x << " to " << bits << " bits";
  }
}

TEST(UnsignedFloat, HasNoSignSaturatesAndKeepsNan) {
  for (const float x : {-1.f, -0.f, -1e-30f, -3e38f}) EXPECT_EQ(roundToUnsignedFloat(x, 6), 0) << x;
  EXPECT_EQ(roundToUnsignedFloat(1e9f, 6), 65024);
  EXPECT_EQ(roundToUnsignedFloat(std::numeric_limits<float>::max(), 5), 64512);
  EXPECT_TRUE(std::isnan(roundToUnsignedFloat(kNan, 6)));
  EXPECT_EQ(roundToUnsignedFloat(kInf, 6), kInf);
}

TEST(OutputTarget, PackedFloatsHaveLessBlue) {
  const glm::vec3 kept = through(OutputTarget::r11g11b10f, glm::vec3(1.02f));
  EXPECT_EQ(kept, glm::vec3(1 + 1 / 64.f, 1 + 1 / 64.f, 1 + 1 / 32.f));
}

TEST(OutputTarget, HalvesAreTheNearestOfAllHalves) {
  const TargetCodec codec(OutputTarget::rgba16f, 0);
  const auto expectNearest = [&](float x) {
    const float half = shading::Half(std::clamp(x, -65504.f, 65504.f)), kept = codec.store({0, x, 0}).y;
    EXPECT_EQ(kept, half) << x;
    EXPECT_EQ(std::signbit(kept), std::signbit(half)) << x;
  };
  for (std::uint16_t bits = 0; bits < 0x7c00; ++bits) {
    const float half = shading::Half::fromBits(bits);
    const float next = bits < 0x7bff ? float(shading::Half::fromBits(bits + 1)) : 65536.f;
    const float middle = half + (next - half) / 2;
    for (const float x : {half, middle, std::nextafter(middle, 0.f), std::nextafter(middle, kInf)})
      expectNearest(x), expectNearest(-x);
  }
  for (const float x : {1e-45f, 1e-30f, 65519.f, 65520.f, 1e9f}) expectNearest(x), expectNearest(-x);
  EXPECT_EQ(codec.store({kInf, -kInf, kNan}).x, kInf);
  EXPECT_EQ(codec.store({kInf, -kInf, kNan}).y, -kInf);
  EXPECT_TRUE(std::isnan(codec.store({kInf, -kInf, kNan}).z));
}

TEST(OutputTarget, HalvesRoundToEvenAndSaturate) {
  const glm::vec3 kept = through(OutputTarget::rgba16f, {1 + 0x1p-11f, 1 + 3 * 0x1p-11f, 1e6f});
  EXPECT_EQ(kept, glm::vec3(1, 1 + 0x1p-9f, 65504));
  EXPECT_EQ(through(OutputTarget::rgba16f, {-2, -1e9f, 65519.9f}), glm::vec3(-2, -65504, 65504));
}

TEST(OutputTarget, SrgbKeepsTheNearestOf256Codes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-0.2f, 1.2f);
  for (int i = 0; i < 20000; ++i) {
    const float x = i < 256 ? static_cast<float>(srgbToLinear(i / 255.)) : uniform(random);
    const double code = 255 * linearToSrgb(std::clamp(double{x}, 0., 1.));
    if (std::abs(code - std::floor(code) - 0.5) < 1e-4) continue; // as near to either, within float
    EXPECT_FLOAT_EQ(through(OutputTarget::rgba8Srgb, glm::vec3(x)).x,
                    static_cast<float>(srgbToLinear(std::floor(code + 0.5) / 255)))
        << x;
  }
}

// sqrt(0.18) = 0.424 is code 108, where sRGB has 118: shown as sRGB that is 0.36 EV less light.
TEST(OutputTarget, GammaTwoIsDarkerAtMidGreyByTenCodes) {
  const float shown = through(OutputTarget::rgba8Gamma2, glm::vec3(0.18f)).x;
  EXPECT_FLOAT_EQ(shown, static_cast<float>(srgbToLinear(108 / 255.)));
  EXPECT_EQ(std::lround(255 * linearToSrgb(shown)), 108);
  EXPECT_EQ(std::lround(255 * linearToSrgb(through(OutputTarget::rgba8Srgb, glm::vec3(0.18f)).x)), 118);
  EXPECT_EQ(through(OutputTarget::rgba8Gamma2, {-1, 0, 7}), glm::vec3(0, 0, 1));
}

// The figures that shading/target.glsl states.
TEST(OutputTarget, GammaTwoIsOffByNineAndAHalfCodesAtMost) {
  double darkest = 0, brightest = 0, darkestAt = 0, brightestAt = 0, equalAt = 0;
  for (int i = 1; i <= 200000; ++i) {
    const double c = i / 200000.0, codes = 255 * (shading::f64::encodeGamma2({c, c, c}).x - linearToSrgb(c));
    if (codes < darkest) darkest = codes, darkestAt = c;
    if (codes > brightest) brightest = codes, brightestAt = c;
    if (codes > 1e-6) equalAt = c; // not the rounding at 1
  }
  EXPECT_NEAR(darkest, -9.5254, 1e-3);
  EXPECT_NEAR(darkestAt, 0.213, 1e-3);
  EXPECT_NEAR(brightest, 4.934, 1e-3);
  EXPECT_NEAR(brightestAt, 0.0015, 1e-5);
  EXPECT_NEAR(equalAt, 0.0101, 1e-5);
}

TEST(OutputTarget, ExposureComesBeforeTheTargetsOfEightBitsOnly) {
  // 3 EV up, 2.0 is 16: white. Read without the exposure that is 1/8.
  for (const OutputTarget target : {OutputTarget::rgba8Srgb, OutputTarget::rgba8Gamma2})
    EXPECT_EQ(through(target, glm::vec3(2), 3), glm::vec3(0.125f));
  EXPECT_FLOAT_EQ(through(OutputTarget::rgba8Srgb, glm::vec3(0.05f), 1).x,
                  static_cast<float>(srgbToLinear(std::floor(255 * linearToSrgb(0.1) + 0.5) / 255) / 2));
  for (const OutputTarget target : {OutputTarget::rgba16f, OutputTarget::r11g11b10f})
    EXPECT_EQ(through(target, glm::vec3(2), 3), glm::vec3(2));
}

TEST(OutputTarget, NeverHidesWhatIsNotFinite) {
  for (int t = 0; t < 4; ++t) {
    const auto target = static_cast<OutputTarget>(t);
    const glm::vec3 kept = through(target, {kNan, kInf, 0.25f});
    EXPECT_TRUE(std::isnan(kept.x)) << outputTargetNames()[static_cast<std::size_t>(t)];
    EXPECT_EQ(kept.y, kInf);
    EXPECT_TRUE(std::isfinite(kept.z));
    EXPECT_EQ(through(target, glm::vec3(-kInf)).x, -kInf);
    // Finite until it is exposed.
    EXPECT_EQ(std::isfinite(through(target, glm::vec3(3e38f), 4).x), !isDisplayed(target));
  }
}

TEST(OutputTarget, HalfPrecisionRoundsBeforeTheRoot) {
  // Between two halves at 0.25: the root of the half is 1/2 exactly.
  const float x = 0.25f + 0x1p-14f;
  EXPECT_EQ(TargetCodec(OutputTarget::rgba8Gamma2, 0, true).write(glm::vec3(x)).x, 0.5f);
  EXPECT_GT(TargetCodec(OutputTarget::rgba8Gamma2, 0, false).write(glm::vec3(x)).x, 0.5f);
}

} // namespace
} // namespace parity::gpu
