// LDR-FLIP against the plain double-precision oracle, over random images, odd sizes and viewing distances; and the
// functions it is made of against the standard library.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "compare/flip.h"
#include "compare/flip_color.h"
#include "compare/flip_filters.h"
#include "compare/vector_math.h"
#include "flip_oracle.h"

namespace parity::compare {
namespace {

constexpr double kTolerance = 1e-4; // DESIGN 10

enum class Kind { noise, noise8, smooth, halves };

// noise: independent values; noise8: whole 255ths; smooth: gradients and waves, with small differences; halves: two
// flat fields. `seed` 2n and 2n+1 give a pair.
base::Image makeImage(Kind kind, int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.f, 1.f);
  base::Image image(width, height, 3);
  const float phase = uniform(random), bias = 0.1f * uniform(random);
  const std::array<float, 6> flat = {uniform(random), uniform(random), uniform(random),
                                     uniform(random), uniform(random), uniform(random)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
        const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
        float value = uniform(random);
        if (kind == Kind::noise8) value = std::round(value * 255.f) / 255.f;
        if (kind == Kind::smooth)
          value = 0.45f + 0.4f * std::sin(7.f * u + static_cast<float>(c) + 5.f * v * u + 0.2f * phase) + bias;
        if (kind == Kind::halves) value = flat[static_cast<std::size_t>(c + (u + v < 1.f ? 0 : 3))];
        image.at(x, y)[c] = value;
      }
  return image;
}

void expectOracle(const base::Image& reference, const base::Image& test, float ppd, const std::string& what) {
  const FlipMaps fast = flipMaps(reference, test, {.ppd = ppd});
  const oracle::Flip slow = oracle::flip(reference, test, static_cast<double>(ppd));
  double worstFlip = 0, worstColor = 0;
  for (std::size_t i = 0; i < slow.flip.size(); ++i) {
    ASSERT_TRUE(std::isfinite(fast.flip.pixels[i])) << what;
    worstFlip = std::max(worstFlip, std::fabs(static_cast<double>(fast.flip.pixels[i]) - slow.flip[i]));
    worstColor = std::max(worstColor, std::fabs(static_cast<double>(fast.color.pixels[i]) - slow.color[i]));
  }
  EXPECT_LE(worstFlip, kTolerance) << what;
  EXPECT_LE(worstColor, kTolerance) << what;
}

TEST(FlipOracle, randomImagesOfOddSizesAtAllDistancesMatch) {
  constexpr int kSizes[][2] = {{1, 1}, {1, 9}, {9, 1}, {2, 3}, {7, 5}, {8, 8}, {31, 17}, {33, 64}, {65, 23}};
  unsigned seed = 0;
  for (const auto& size : kSizes)
    for (float ppd : {10.f, 20.f, 33.3f, 67.0206451f, 120.f, 200.f})
      for (Kind kind : {Kind::noise, Kind::noise8, Kind::smooth, Kind::halves}) {
        const base::Image reference = makeImage(kind, size[0], size[1], seed++);
        const base::Image test = makeImage(kind, size[0], size[1], seed++);
        expectOracle(reference, test, ppd,
                     std::to_string(size[0]) + " x " + std::to_string(size[1]) + ", ppd " + std::to_string(ppd) +
                         ", kind " + std::to_string(static_cast<int>(kind)));
      }
}

// Tiles are 256 pixels wide and high: a seam would show here.
TEST(FlipOracle, imagesOfSeveralTilesMatchAcrossTheSeams) {
  expectOracle(makeImage(Kind::noise, 530, 40, 1), makeImage(Kind::noise, 530, 40, 2), 67.f, "wide");
  expectOracle(makeImage(Kind::noise8, 30, 521, 3), makeImage(Kind::noise8, 30, 521, 4), 90.f, "high");
  expectOracle(makeImage(Kind::smooth, 257, 259, 5), makeImage(Kind::smooth, 257, 259, 6), 67.f, "one over");
}

TEST(FlipOracle, valuesOutsideTheRangeCountAsClamped) {
  base::Image wide = makeImage(Kind::noise, 20, 20, 7), other = makeImage(Kind::noise, 20, 20, 8);
  for (std::size_t i = 0; i < wide.pixels.size(); i += 7) wide.pixels[i] = i % 2 == 0 ? -3.f : 1e30f;
  base::Image clamped = wide;
  for (float& v : clamped.pixels) v = std::clamp(v, 0.f, 1.f);
  EXPECT_EQ(flipMap(wide, other), flipMap(clamped, other));
}

TEST(FlipParts, theLargestColorDifferenceIsGreenAgainstBlue) {
  EXPECT_NEAR(static_cast<double>(kMaxColorDifference), oracle::largestColorDifference(), 1e-5);
}

TEST(FlipParts, filtersSumToWhatTheyMust) {
  const auto sum = [](const std::vector<float>& half) {
    double total = static_cast<double>(half[0]);
    for (std::size_t i = 1; i < half.size(); ++i) total += 2 * static_cast<double>(half[i]);
    return total;
  };
  for (float ppd : {1.f, 10.f, 67.0206451f, 200.f, 1000.f}) {
    const FlipFilters f = makeFlipFilters(ppd);
    EXPECT_NEAR(sum(f.luma), 1, 1e-6) << ppd;
    EXPECT_NEAR(sum(f.redGreen), 1, 1e-6) << ppd;
    EXPECT_NEAR(std::pow(sum(f.blueYellowA), 2) + std::pow(sum(f.blueYellowB), 2), 1, 1e-6) << ppd;
    EXPECT_NEAR(sum(f.gauss), 1, 1e-6) << ppd;
    EXPECT_NEAR(sum(f.point), 0, 1e-6) << ppd;
    double edge = 0;
    for (float w : f.edge) edge += static_cast<double>(w);
    EXPECT_NEAR(edge, -1, 1e-6) << ppd;
    for (const std::vector<float>* half :
         {&f.luma, &f.redGreen, &f.blueYellowA, &f.blueYellowB, &f.gauss, &f.edge, &f.point}) {
      EXPECT_GE(half->size(), 2u) << ppd;
      EXPECT_LE(half->size(), static_cast<std::size_t>(f.radius) + 1) << ppd;
    }
  }
}

TEST(FlipParts, theFilterRadiusIsTenAtTheDefaultDistance) {
  EXPECT_EQ(flipFilterRadius({}), 10);
  EXPECT_EQ(makeFlipFilters(kDefaultPixelsPerDegree).gauss.size(), 10u); // radius 9
  EXPECT_EQ(flipFilterRadius({.ppd = 120}), 17);                         // ceil(0.13505 * 120 = 16.2)
}

TEST(FlipParts, pixelsPerDegreeOfTheDefaultScreen) {
  EXPECT_FLOAT_EQ(pixelsPerDegree(0.7f, 3840.f, 0.7f), kDefaultPixelsPerDegree);
}

TEST(FlipParts, vectorMathStaysWithinItsStatedErrors) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> exponent(-19.9, 1), any(-125, 125);
  for (int i = 0; i < 200000; ++i) {
    const float x = static_cast<float>(std::exp2(exponent(random))), wide = static_cast<float>(std::exp2(any(random)));
    const double exactCbrt = std::cbrt(static_cast<double>(x));
    ASSERT_NEAR(static_cast<double>(fastCbrt(x)) / exactCbrt, 1, 1.5e-7) << x;
    const double exactLog = std::log2(static_cast<double>(wide));
    ASSERT_NEAR(static_cast<double>(fastLog2(wide)), exactLog, 2e-7 + 6e-8 * std::fabs(exactLog)) << wide;
    const float e = static_cast<float>(any(random));
    ASSERT_NEAR(static_cast<double>(fastExp2(e)) / std::exp2(static_cast<double>(e)), 1, 3e-7) << e;
    ASSERT_NEAR(static_cast<double>(fastPow(x, 2.4f)) / std::pow(static_cast<double>(x), 2.4f), 1,
                4e-7 + 1.5e-7 * 2.4 * std::fabs(std::log2(static_cast<double>(x))))
        << x;
  }
}

TEST(FlipParts, decodingByTableAndByFormulaAgree) {
  const base::Image image = makeImage(Kind::noise8, 100, 1, 5);
  ASSERT_TRUE(isEightBit(image));
  float byTable[3][100], byFormula[3][100];
  RowDecoder(true).decode(image.at(0, 0), 100, byTable[0], byTable[1], byTable[2]);
  RowDecoder(false).decode(image.at(0, 0), 100, byFormula[0], byFormula[1], byFormula[2]);
  for (int x = 0; x < 100; ++x) {
    const float* rgb = image.at(x, 0);
    const auto linear = [&](int c) { return oracle::decodeSrgb(static_cast<double>(rgb[c])); };
    const oracle::Pixel exact = oracle::toYCxCz({linear(0), linear(1), linear(2)});
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(static_cast<double>(byTable[c][x]), exact[c], 5e-5) << x; // of 100: float rounding
      EXPECT_NEAR(static_cast<double>(byFormula[c][x]), exact[c], 3e-4) << x;
    }
  }
}

TEST(FlipParts, aValueBetweenTwo255thsIsNotEightBit) {
  base::Image image(64, 2, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = i % 2 == 0 ? static_cast<float>(i % 256) / 255.f : static_cast<float>(i % 256) * (1.f / 255.f);
  EXPECT_TRUE(isEightBit(image));
  image.pixels[100] += 1e-5f;
  EXPECT_FALSE(isEightBit(image));
}

} // namespace
} // namespace parity::compare
