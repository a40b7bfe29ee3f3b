// Curves that are read from the greys of a calibration, and what counts as clipped.
#include "external/encoding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace parity::external {
namespace {

double toSrgb(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

// Tone curves that parity does not know: Hable's of "Uncharted 2" (GDC 2010), Hejl's and Burgess-Dawson's (2010), which
// is three.js' Cineon, and two displays.
double hable(double x) {
  const auto f = [](double v) { return (v * (0.15 * v + 0.05) + 0.004) / (v * (0.15 * v + 0.5) + 0.06) - 0.02 / 0.3; };
  return toSrgb(f(2 * x) / f(11.2));
}
double hejl(double x) {
  const double v = std::max(0.0, x - 0.004);
  return (v * (6.2 * v + 0.5)) / (v * (6.2 * v + 1.7) + 0.06);
}
double gamma24(double x) { return std::pow(x, 1 / 2.4); }
double lifted(double x) { return 0.05 + 0.9 * toSrgb(x); } // black is grey

using Curve = std::function<double(double)>;

std::optional<FittedCurve> fitOf(const Curve& curve, double steps) {
  std::array<Rgb, kRampSteps> seen{};
  for (std::size_t i = 0; i < kRampSteps; ++i)
    seen[i].fill(std::round(std::clamp(curve(rampValue(i)), 0.0, 1.0) * steps) / steps);
  return FittedCurve::fit(seen);
}

TEST(FittedCurve, DecodesCurvesThatAreNotKnown) {
  for (const Curve& curve : {Curve(hable), Curve(hejl), Curve(gamma24), Curve(lifted)}) {
    const auto fit = fitOf(curve, 65535);
    ASSERT_TRUE(fit);
    for (double grey = 0.01; grey < 1; grey += 0.013) {
      const double value = curve(grey);
      // As displayed: within half a step of 255.
      EXPECT_NEAR(toSrgb(fit->light({value, value, value})[1]), toSrgb(grey), 0.5 / 255) << grey;
    }
  }
}

// Half a step of a grey of the ramp and half a step of the value itself, where a step of the value is the more light
// the flatter the curve is.
TEST(FittedCurve, OfEightBitsIsWithinWhatRoundingHides) {
  for (const Curve& curve : {Curve(hable), Curve(hejl), Curve(gamma24), Curve(lifted)}) {
    const auto fit = fitOf(curve, 255);
    ASSERT_TRUE(fit);
    for (double grey = 0.01; grey < 0.98; grey += 0.013) {
      const double value = std::round(curve(grey) * 255) / 255;
      const double step = 0.01 * grey;
      const double flatness = (toSrgb(grey + step) - toSrgb(grey - step)) / (curve(grey + step) - curve(grey - step));
      EXPECT_NEAR(toSrgb(fit->light({value, value, value})[0]), toSrgb(grey), (flatness + 0.5) / 255) << grey;
    }
  }
}

// Half way between two greys the cubic is (a + b) / 2 + width / 8 * (slope of a - slope of b), and a slope is the
// harmonic mean of those beside it, weighted as in Fritsch and Butland (1984), equation 5.
TEST(FittedCurve, SlopesAreThoseOfFritschAndButland) {
  const auto valueOf = [](double i) { return 0.1 * i / 16 + 0.9 * std::pow(i / 16, 3); };
  std::array<Rgb, kRampSteps> seen{};
  for (std::size_t i = 0; i < kRampSteps; ++i) seen[i].fill(valueOf(static_cast<double>(i)));
  const auto fit = FittedCurve::fit(seen);
  ASSERT_TRUE(fit);
  for (int i = 1; i < 15; ++i) {
    const auto width = [&](int k) { return valueOf(k + 1) - valueOf(k); };
    const auto slope = [&](int k) {
      const double before = width(k - 1), after = width(k), w1 = 2 * after + before, w2 = after + 2 * before;
      return (w1 + w2) / (w1 * 16 * before + w2 * 16 * after);
    };
    const double middle = (i + 0.5) / 16 + width(i) / 8 * (slope(i) - slope(i + 1));
    const double value = 0.5 * (valueOf(i) + valueOf(i + 1));
    EXPECT_NEAR(fit->light({value, value, value})[0], rampLight(middle), 1e-9) << i;
  }
}

TEST(FittedCurve, ChannelsHaveCurvesOfTheirOwn) {
  std::array<Rgb, kRampSteps> seen{};
  for (std::size_t i = 0; i < kRampSteps; ++i) {
    const double grey = rampValue(i);
    seen[i] = {gamma24(grey), toSrgb(grey), 0.5 * toSrgb(grey)};
  }
  const auto fit = FittedCurve::fit(seen);
  ASSERT_TRUE(fit);
  const Rgb light = fit->light({gamma24(0.3), toSrgb(0.3), 0.5 * toSrgb(0.3)});
  for (const double channel : light) EXPECT_NEAR(channel, 0.3, 1e-3);
  EXPECT_TRUE(fit->isClipped({0.1, 0.1, 0.5})) << "the blue channel's white";
  EXPECT_FALSE(fit->isClipped({0.5, 0.5, 0.4}));
}

TEST(FittedCurve, WhatIsNoCurveIsNone) {
  EXPECT_FALSE(fitOf([](double x) { return 1 - x; }, 255)) << "negative";
  EXPECT_FALSE(fitOf([](double) { return 0.5; }, 255)) << "all alike";
  EXPECT_FALSE(fitOf([](double x) { return x > 0.5 ? NAN : x; }, 255));
  EXPECT_TRUE(fitOf([](double x) { return std::min(2 * x, 1.0); }, 255)) << "clips";
}

TEST(FittedCurve, ClippedGreysAreTheDarkestOfTheirValue) {
  const auto fit = fitOf([](double x) { return toSrgb(std::min(2 * x, 1.0)); }, 255);
  ASSERT_TRUE(fit);
  const double white = fit->light({1, 1, 1})[0];
  EXPECT_GT(white, 0.4);
  EXPECT_LT(white, 0.65) << "the first grey that clips, of steps of about a ninth";
  EXPECT_TRUE(fit->isClipped({1, 0, 0}));
}

TEST(Encoding, SaysItsNameAndWhatIsClipped) {
  EXPECT_EQ(Encoding(Transfer::agx).name(), "agx");
  EXPECT_EQ(Encoding(*fitOf(gamma24, 255)).name(), kFitted);
  EXPECT_TRUE(Encoding(Transfer::srgb).isClipped({0.2, 1, 0.2}));
  EXPECT_FALSE(Encoding(Transfer::srgb).isClipped({254 / 255.0, 0.5, 0}));
  EXPECT_FALSE(Encoding(Transfer::srgb).isClipped({0, 0.5, 0})) << "black is known to half a step";
  EXPECT_FALSE(Encoding(Transfer::linear).isClipped({7, 0, 1}));
  EXPECT_TRUE(Encoding(Transfer::linear).isLinear());
}

} // namespace
} // namespace parity::external
