// The display transforms against closed forms and the Academy's own formulas.
#include "base/image/color.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "aces_reference.h"
#include "base/parallel.h"
#include "expect_error.h"

namespace parity::base {
namespace {

// Values from `low` to `high` in equal steps, as an image of several bands.
Image makeRamp(float low, float high) {
  Image image(1000, 100, 3);
  const auto last = static_cast<double>(image.pixels.size() - 1);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(low + (high - low) * static_cast<double>(i) / last);
  return image;
}

Image makeLogNoise(double lowEv, double highEv) {
  Image image(301, 77, 3);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> ev(lowEv, highEv);
  for (float& v : image.pixels) v = static_cast<float>(std::exp2(ev(random)));
  return image;
}

// IEC 61966-2-1.
double encodeSrgb(double v) {
  v = std::clamp(v, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

TEST(DisplayTransform, SrgbFollowsTheStandardOverARampBeyondBothEnds) {
  // OpenColorIO joins the two pieces without a step: its slope near black is 12.9232 where the standard rounds to
  // 12.92, which makes 9.8e-6 where they meet.
  const Image ramp = makeRamp(-0.5f, 2.0f), shown = DisplayTransform("sRGB").apply(ramp);
  for (std::size_t i = 0; i < ramp.pixels.size(); ++i)
    ASSERT_NEAR(shown.pixels[i], encodeSrgb(ramp.pixels[i]), 1e-5) << "of " << ramp.pixels[i];
}

TEST(DisplayTransform, SrgbHoldsTheSameCloseToBlack) {
  const Image ramp = makeRamp(0.0f, 0.01f), shown = DisplayTransform("sRGB").apply(ramp);
  for (std::size_t i = 0; i < ramp.pixels.size(); ++i)
    ASSERT_NEAR(shown.pixels[i], encodeSrgb(ramp.pixels[i]), 1e-5) << "of " << ramp.pixels[i];
}

TEST(DisplayTransform, AcesFollowsTheAcademysFormulasOnGreys) {
  const DisplayTransform aces("ACES SDR");
  // NOLINTNEXTLINE(clang-analyzer-security.FloatLoopCounter): steps of an eighth are exact
  for (double ev = -14; ev < 9; ev += 0.125) {
    const double grey = 0.18 * std::exp2(ev);
    const Image shown = aces.apply(Image(1, 1, 3, static_cast<float>(grey)));
    const auto expected = acesReference({grey, grey, grey});
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(shown.pixels[c], expected[c], 1e-5) << "of " << grey;
  }
  // The one number that many sources print: middle grey is shown as 0.356 (4.8 nits of 48, less black, in dim
  // surround).
  EXPECT_NEAR(aces.apply(Image(1, 1, 3, 0.18f)).pixels[0], 0.356, 5e-4);
}

TEST(DisplayTransform, AcesFollowsTheAcademysFormulasOnColours) {
  const Image noise = makeLogNoise(-9, 5), shown = DisplayTransform("ACES SDR").apply(noise);
  for (std::size_t i = 0; i < noise.pixels.size(); i += 3) {
    const auto expected = acesReference({noise.pixels[i], noise.pixels[i + 1], noise.pixels[i + 2]});
    // In dark reds OpenColorIO takes the saturation after the glow, the CTL before: seen up to 5.3e-4.
    const bool dark = std::max({noise.pixels[i], noise.pixels[i + 1], noise.pixels[i + 2]}) < 0.05f;
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(shown.pixels[i + c], expected[c], dark ? 8e-4 : 2e-5)
          << noise.pixels[i] << " " << noise.pixels[i + 1] << " " << noise.pixels[i + 2];
  }
}

TEST(DisplayTransform, RawOnlyClamps) {
  const Image ramp = makeRamp(-0.5f, 2.0f), shown = DisplayTransform("raw").apply(ramp);
  for (std::size_t i = 0; i < ramp.pixels.size(); ++i)
    ASSERT_EQ(shown.pixels[i], std::clamp(ramp.pixels[i], 0.0f, 1.0f));
}

TEST(DisplayTransform, ExposureDoublesTheLightPerStop) {
  const Image noise = makeLogNoise(-9, 2);
  Image brighter = noise;
  for (float& v : brighter.pixels) v *= 4;
  for (const std::string& name : DisplayTransform::names()) {
    const DisplayTransform display(name);
    EXPECT_EQ(display.apply(noise, 2), display.apply(brighter)) << name;
    EXPECT_EQ(display.apply(brighter, -2), display.apply(noise)) << name;
  }
}

// Runs of equal pixels are encoded once: at the ends, in between, next to each other, short ones and NaN among them.
TEST(DisplayTransform, EncodesPixelsInARunAsAlone) {
  Image image(0, 1, 3);
  const auto append = [&](int count, float red, float green) {
    for (int i = 0; i < count; ++i) image.pixels.insert(image.pixels.end(), {red, green, 0.7f});
    image.width += count;
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [count, red] :
       {std::pair(40, 0.1f), {1, 0.2f}, {15, 0.3f}, {16, 0.4f}, {17, 0.5f}, {3, 0.6f}, {90, 0.f}})
    append(count, red, 0.25f);
  append(30, 0.f, kNan);
  append(20, 0.f, 0.26f);
  for (const std::string& name : DisplayTransform::names()) {
    const DisplayTransform display(name);
    const Image shown = display.apply(image, 0.5f);
    for (int x = 0; x < image.width; ++x) {
      Image one(1, 1, 3);
      std::copy_n(image.at(x, 0), 3, one.pixels.begin());
      const Image alone = display.apply(one, 0.5f);
      // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): NaN is to keep its bits
      ASSERT_EQ(0, std::memcmp(shown.at(x, 0), alone.pixels.data(), 3 * sizeof(float))) << name << " " << x;
    }
  }
}

// The bytes equal the rounded values of `apply`, at each step of sRGB and for noise.
TEST(DisplayTransform, EncodesTheBytesOfTheEncodedValues) {
  Image image = makeLogNoise(-20, 6);
  for (int code = 1; code < 256; ++code) { // the light where the byte steps up, and 40 numbers on both sides
    float light = static_cast<float>(std::pow((code - 0.5) / 255 / 1.055 + 0.055 / 1.055, 2.4));
    if (code <= 10) light = static_cast<float>((code - 0.5) / 255 / 12.92);
    for (int i = 0; i < 40; ++i) light = std::nextafter(light, 0.f);
    for (int i = 0; i < 80; ++i, light = std::nextafter(light, 1.f)) image.pixels[code * 80 + i] = light;
  }
  for (const std::string& name : DisplayTransform::names())
    for (const float exposureEv : {0.f, -1.5f}) {
      const DisplayTransform display(name);
      const Image encoded = display.apply(image, exposureEv);
      std::vector<std::uint8_t> bytes(image.pixels.size());
      std::vector<std::uint32_t> nonFinite;
      display.encodeBytes(image.pixels, exposureEv, bytes, nonFinite);
      EXPECT_TRUE(nonFinite.empty());
      for (std::size_t i = 0; i < bytes.size(); ++i)
        ASSERT_EQ(bytes[i], static_cast<int>(encoded.pixels[i] * 255 + 0.5f)) << name << " of " << image.pixels[i];
    }
}

TEST(DisplayTransform, KeepsNonFiniteValuesSoThatTheyCanBeRefused) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Image image(3, 40, 3, 0.25f);
  image.at(1, 0)[0] = std::numeric_limits<float>::quiet_NaN();
  image.at(2, 20)[1] = kInfinity;
  image.at(0, 39)[2] = -kInfinity;
  for (const std::string& name : DisplayTransform::names()) {
    const DisplayTransform display(name);
    const Image shown = display.apply(image);
    EXPECT_TRUE(std::isnan(shown.at(1, 0)[0])) << name;
    EXPECT_EQ(shown.at(2, 20)[1], kInfinity) << name;
    EXPECT_EQ(shown.at(0, 39)[2], -kInfinity) << name;
    // Nobody else suffers: not even the other pixels of the same row.
    EXPECT_EQ(shown.at(0, 0)[0], display.apply(Image(1, 1, 3, 0.25f)).pixels[0]) << name;
    EXPECT_EQ(std::count_if(shown.pixels.begin(), shown.pixels.end(), [](float v) { return !std::isfinite(v); }), 3);
  }
}

TEST(DisplayTransform, KeepsWhatTheExposureMakesInfinite) {
  const Image shown = DisplayTransform("sRGB").apply(Image(1, 1, 3, 1e38f), 10);
  EXPECT_TRUE(std::isinf(shown.pixels[0]));
}

TEST(DisplayTransform, StaysWithinZeroAndOne) {
  const Image noise = makeLogNoise(-20, 20);
  for (const std::string& name : DisplayTransform::names()) {
    const Image shown = DisplayTransform(name).apply(noise);
    const auto [least, most] = std::minmax_element(shown.pixels.begin(), shown.pixels.end());
    EXPECT_GE(*least, 0) << name;
    EXPECT_LE(*most, 1) << name;
  }
}

TEST(DisplayTransform, GivesTheSameBitsWithAnyNumberOfThreads) {
  const Image noise = makeLogNoise(-9, 5);
  for (const std::string& name : DisplayTransform::names()) {
    const DisplayTransform display(name);
    const Image expected = display.apply(noise);
    for (const int threads : {1, 2, 3}) {
      const ThreadLimit limit(threads);
      EXPECT_EQ(display.apply(noise), expected) << name << " with " << threads;
    }
  }
}

TEST(DisplayTransform, SurvivesBeingMoved) {
  DisplayTransform display("sRGB");
  const Image expected = display.apply(Image(2, 2, 3, 0.5f));
  const DisplayTransform moved = std::move(display);
  EXPECT_EQ(moved.name(), "sRGB");
  EXPECT_EQ(moved.apply(Image(2, 2, 3, 0.5f)), expected);
}

TEST(DisplayTransform, NamesTheKnownOnesForAnUnknown) {
  for (const std::string& name : DisplayTransform::names())
    expectError([] { DisplayTransform("sRGB2"); }, "'sRGB2'", name, ExitCode::usage);
  expectError([] { DisplayTransform(""); }, "display", "unknown", ExitCode::usage);
}

TEST(DisplayTransform, RefusesImagesThatAreNotRgb) {
  const DisplayTransform display("sRGB");
  expectError([&] { display.apply(Image(2, 2, 1)); }, "sRGB", "1 channel");
  expectError([&] { display.apply(Image(2, 2, 4)); }, "sRGB", "4 channels");
  expectError([&] { display.apply(Image()); }, "sRGB", "RGB");
}

TEST(ColorSpace, SrgbIsDecodedByTheStandard) {
  const Image ramp = makeRamp(0.0f, 1.0f), linear = toLinearRec709(ramp, "srgb");
  for (std::size_t i = 0; i < ramp.pixels.size(); ++i) {
    const double v = ramp.pixels[i], expected = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    ASSERT_NEAR(linear.pixels[i], expected, 1e-5) << "of " << v;
  }
}

// The Academy's matrices, Bradford-adapted (aces-dev, ACEScsc; four digits of AP1 to Rec.709).
TEST(ColorSpace, AcesPrimariesComeOutInRec709) {
  const double matrix[3][3] = {
      {1.70505, -0.62179, -0.08326}, {-0.13026, 1.14080, -0.01055}, {-0.02400, -0.12897, 1.15297}};
  for (int c = 0; c < 3; ++c) {
    Image one(1, 1, 3);
    one.pixels[c] = 2;
    const Image linear = toLinearRec709(one, "acescg");
    for (int row = 0; row < 3; ++row) EXPECT_NEAR(linear.pixels[row], 2 * matrix[row][c], 1e-4) << row << " of " << c;
  }
  // Greys are greys in each of them.
  for (const char* space : {"linear", "acescg", "aces2065-1"})
    for (const float v : toLinearRec709(Image(1, 1, 3, 0.18f), space).pixels) EXPECT_NEAR(v, 0.18f, 1e-5) << space;
}

TEST(ColorSpace, NonFinitePixelsStayUnusable) {
  Image image(3, 1, 3, 0.5f);
  image.at(1, 0)[2] = std::numeric_limits<float>::infinity();
  image.at(2, 0)[0] = std::numeric_limits<float>::quiet_NaN();
  for (const char* space : {"srgb", "acescg"}) {
    const Image linear = toLinearRec709(image, space);
    EXPECT_TRUE(std::isfinite(linear.at(0, 0)[0]));
    for (const int x : {1, 2})
      for (int c = 0; c < 3; ++c) EXPECT_FALSE(std::isfinite(linear.at(x, 0)[c])) << space << x << c;
  }
}

TEST(ColorSpace, UnknownOneIsRefusedWithTheKnownOnes) {
  expectError([] { toLinearRec709(Image(1, 1, 3), "rec2020"); }, "rec2020", "acescg", ExitCode::usage);
}

} // namespace
} // namespace parity::base
