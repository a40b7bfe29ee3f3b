// Both paths against the truth: closed forms, its noise, what is not finite, terms.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "compare/measure_truth.h"

namespace parity::compare {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
constexpr int kWidth = 32, kHeight = 24; // an interior of 12 x 4 pixels

// Grey pictures; the truth is 0.5 with a relative standard error of 2 %.
struct Trio {
  base::Image truth{kWidth, kHeight, 3, 0.5f}, highend{kWidth, kHeight, 3, 0.5f}, mobile{kWidth, kHeight, 3, 0.5f};
  base::Image error{kWidth, kHeight, 1, 0.02f}, samples{kWidth, kHeight, 1, 400};
  std::vector<std::uint32_t> broken, mobileBroken; // known to be, though the pictures do not show it

  TruthInput input() const {
    return {{truth, &truth, broken}, {highend, &highend, {}}, {mobile, &mobile, mobileBroken}};
  }
  TruthMeasurement measure(const std::vector<base::PixelList>& lists, double wanted = 0.02) const {
    return measureTruth(input(), {&error, &samples}, lists, {.wantedError = wanted});
  }
};

base::PixelList allPixels() {
  base::PixelList list{"all", {}, {}};
  for (std::uint32_t p = 0; p < kWidth * kHeight; ++p) list.pixels.push_back(p);
  return list;
}

double figure(const Figures& figures, const char* name) { return figures.find(name).value_or(NAN); }

TEST(Truth, BothPathsHaveTheirClosedForms) {
  Trio trio;
  trio.highend = base::Image(kWidth, kHeight, 3, 0.6f);
  trio.mobile = base::Image(kWidth, kHeight, 3, 0.25f);
  const Truth truth = trio.measure({allPixels()}).regions.at(0);
  for (const TruthRegion* region : {&truth.all, &truth.interior}) {
    EXPECT_NEAR(figure(region->highend, "relmse"), 0.1 * 0.1 / 0.26, 1e-7); // (t-r)^2 / (r^2 + 0.01)
    EXPECT_NEAR(figure(region->mobile, "relmse"), 0.25 * 0.25 / 0.26, 1e-7);
    EXPECT_NEAR(figure(region->highend, "bias.ev"), std::log2(0.6 / 0.5), 1e-3);
    EXPECT_NEAR(figure(region->mobile, "bias.ev"), -1, 1e-3);
    EXPECT_GT(figure(region->mobile, "flip.mean"), figure(region->highend, "flip.mean"));
    EXPECT_NEAR(region->highend.referenceLuma, 0.5, 1e-6) << "the truth is the reference";
    EXPECT_NEAR(region->highend.testLuma, 0.6, 1e-6);
    EXPECT_EQ(region->nonFinite, 0u);
  }
  EXPECT_EQ(truth.all.highend.pixels, 768u);
  EXPECT_EQ(truth.interior.highend.pixels, 768u) << "the image's edge does not erode";
  EXPECT_TRUE(truth.notes.empty()) << truth.notes[0];
}

TEST(Truth, ItsErrorIsThatOfItsPixelsByWeight) {
  Trio trio;
  trio.highend = base::Image(kWidth, kHeight, 3, 5.f); // far away: no note
  trio.mobile = trio.highend;
  trio.error.pixels = std::vector<float>(trio.error.pixels.size(), 0.f);
  const float errors[] = {0.01f, 0.04f, 0.03f};
  for (std::size_t p = 0; p < 3; ++p) {
    trio.error.pixels[p] = errors[p];
    trio.samples.pixels[p] = static_cast<float>(100 * (p + 1));
  }
  const auto errorOf = [&](const base::PixelList& list) {
    return trio.measure({allPixels(), list}, 1).regions.at(1).all.error;
  };
  const TruthError even = errorOf({"m", {0, 1, 2}, {}}), weighted = errorOf({"m", {0, 1, 2}, {0.1f, 1.f, 0.1f}});
  EXPECT_FLOAT_EQ(static_cast<float>(even.median), 0.03f);
  EXPECT_FLOAT_EQ(static_cast<float>(even.worst), 0.04f);
  EXPECT_NEAR(even.samples, 200, 1e-9);
  const double share = 0.25 / 0.26; // r^2 / (r^2 + 0.01)
  EXPECT_NEAR(even.relmse, share * (1e-4 + 16e-4 + 9e-4) / 3, 1e-8);
  EXPECT_FLOAT_EQ(static_cast<float>(weighted.median), 0.04f);
  EXPECT_NEAR(weighted.relmse, share * (0.1 * 1e-4 + 16e-4 + 0.1 * 9e-4) / 1.2, 1e-8);
}

TEST(Truth, ADifferenceWithinTwoStandardErrorsIsSaid) {
  // The truth is off by 2 % of 0.5 in root mean square: two of that are 0.02.
  Trio trio;
  trio.highend = base::Image(kWidth, kHeight, 3, 0.5f + 0.0199f);
  trio.mobile = base::Image(kWidth, kHeight, 3, 0.5f - 0.0201f);
  const Truth truth = trio.measure({allPixels()}).regions.at(0);
  EXPECT_TRUE(isWithinNoise(truth.all.highend, truth.all.error));
  EXPECT_FALSE(isWithinNoise(truth.all.mobile, truth.all.error));
  ASSERT_EQ(truth.notes.size(), 1u);
  EXPECT_EQ(truth.notes[0], "high-end: the difference to the truth, relMSE 0.0015, is within 2 standard errors of the "
                            "truth, whose noise alone gives 0.00038");
}

TEST(Truth, AnExactTruthHidesNothing) {
  Trio trio;
  trio.error = base::Image(kWidth, kHeight, 1);
  const Truth truth = trio.measure({allPixels()}).regions.at(0);
  EXPECT_EQ(truth.all.error.worst, 0);
  EXPECT_FALSE(isWithinNoise(truth.all.highend, truth.all.error));
  EXPECT_TRUE(truth.notes.empty());
}

TEST(Truth, NoiseIsTheSameInALightAndInADarkExposure) {
  // relMSE's 0.01 is a floor in exposed light, for noise and difference alike.
  for (const float light : {0.001f, 1.f, 1000.f}) {
    Trio trio;
    trio.truth = base::Image(kWidth, kHeight, 3, light);
    trio.highend = base::Image(kWidth, kHeight, 3, light * 1.0399f);
    trio.mobile = base::Image(kWidth, kHeight, 3, light * 1.0401f);
    const Truth truth = trio.measure({allPixels()}).regions.at(0);
    EXPECT_TRUE(isWithinNoise(truth.all.highend, truth.all.error)) << light;
    EXPECT_FALSE(isWithinNoise(truth.all.mobile, truth.all.error)) << light;
  }
}

TEST(Truth, APixelThatDidNotReachItsErrorIsSaid) {
  Trio trio;
  trio.highend = trio.mobile = base::Image(kWidth, kHeight, 3, 0.9f);
  trio.error.pixels[5] = 0.0201f;
  const auto regions = trio.measure({allPixels(), {"with", {5, 6}, {}}, {"without", {6, 7}, {}}}).regions;
  EXPECT_EQ(regions[0].notes,
            std::vector<std::string>{"the truth did not reach a standard error of 2 % at 1 of 768 pixels"});
  EXPECT_EQ(regions[1].notes,
            std::vector<std::string>{"the truth did not reach a standard error of 2 % at 1 of 2 pixels"});
  EXPECT_TRUE(regions[2].notes.empty());
}

TEST(Truth, ATruthThatIsNotFiniteIsCountedWhereItIs) {
  Trio trio;
  trio.broken = {5};
  const auto regions = trio.measure({allPixels(), {"with", {5, 6}, {}}, {"without", {6, 7}, {}}}).regions;
  EXPECT_EQ(regions[0].all.nonFinite, 1u);
  EXPECT_EQ(regions[1].all.nonFinite, 1u);
  EXPECT_EQ(regions[1].all.highend.nonFinite, 1u);
  EXPECT_GT(figure(regions[1].all.highend, "relmse"), 1) << "the worst value, never an equal one";
  EXPECT_TRUE(std::isnan(regions[1].all.error.median));
  EXPECT_FALSE(isWithinNoise(regions[1].all.highend, regions[1].all.error));
  EXPECT_EQ(regions[2].all.nonFinite, 0u);
  EXPECT_EQ(figure(regions[2].all.highend, "relmse"), 0);
}

TEST(Truth, APathThatIsNotFiniteIsNotTheTruths) {
  Trio trio;
  trio.mobile.pixels[15] = kInf;
  trio.mobileBroken = {6};
  const Truth truth = trio.measure({allPixels()}).regions.at(0);
  EXPECT_EQ(truth.all.nonFinite, 0u);
  EXPECT_EQ(truth.all.mobile.nonFinite, 2u);
  EXPECT_EQ(truth.all.highend.nonFinite, 0u);
}

TEST(Truth, AnErrorThatIsNotKnownIsNotNone) {
  Trio trio;
  trio.error.pixels[5] = kInf;
  const Truth truth = trio.measure({{"m", {5, 6}, {}}}).regions.at(0);
  for (const double value : {truth.all.error.median, truth.all.error.worst, truth.all.error.relmse})
    EXPECT_TRUE(std::isnan(value));
  ASSERT_EQ(truth.notes.size(), 1u);
  EXPECT_EQ(truth.notes[0], "the truth's error is not known at 1 of 2 pixels");
}

TEST(Truth, WhatIsNotSeenHasNoFigures) {
  const Truth truth = Trio().measure({allPixels(), {"m", {}, {}}}).regions.at(1);
  EXPECT_EQ(truth.all.highend.pixels, 0u);
  EXPECT_TRUE(truth.all.highend.values.empty());
  EXPECT_TRUE(truth.notes.empty());
  EXPECT_EQ(&mainRegion(truth), &truth.all);
}

TEST(Truth, ATermThatTheTruthLacksCountsAHundredTimesItsSquaredLight) {
  Trio trio;
  trio.truth = base::Image(kWidth, kHeight, 3);
  trio.highend = base::Image(kWidth, kHeight, 3, 0.1f);
  trio.mobile = base::Image(kWidth, kHeight, 3);
  const TruthTerm term = measureTerm("fog", trio.input(), {allPixels()}, {}).at(0);
  EXPECT_EQ(term.name, "fog");
  EXPECT_NEAR(figure(term.highendFigures.all, "relmse"), 1, 1e-6);
  EXPECT_EQ(figure(term.mobileFigures.all, "relmse"), 0) << "black in both is alike";
  EXPECT_GT(figure(term.highendFigures.interior, "flip.mean"), 0.1);
  EXPECT_EQ(term.highendFigures.all.values.size(), 2u);
}

TEST(Truth, LuminanceIsRec709sByWeight) {
  base::Image image(2, 1, 3);
  image.pixels = {1, 0, 0, 0, 2, 1};
  EXPECT_NEAR(meanLuminance(image, {"m", {0}, {}}), 0.2126, 1e-12);
  EXPECT_NEAR(meanLuminance(image, {"m", {0, 1}, {1.f, 0.5f}}), (0.2126 + 0.5 * (2 * 0.7152 + 0.0722)) / 1.5, 1e-12);
}

TEST(Truth, OnlyZeroIsBlack) {
  base::Image image(3, 1, 3);
  image.pixels[5] = 1e-30f;
  image.pixels[7] = kNan;
  EXPECT_TRUE(isBlack(image, {"m", {0}, {}}));
  EXPECT_FALSE(isBlack(image, {"m", {0, 1}, {}}));
  EXPECT_FALSE(isBlack(image, {"m", {2}, {}}));
}

TEST(Truth, MapsAreKeptWhereAskedFor) {
  Trio trio;
  trio.mobile = base::Image(kWidth, kHeight, 3, 0.9f);
  const TruthMeasurement kept =
      measureTruth(trio.input(), {&trio.error, &trio.samples}, {allPixels()}, {.keepMaps = true});
  EXPECT_EQ(kept.highendFlip.at(5, 5)[0], 0);
  EXPECT_GT(kept.mobileFlip.at(5, 5)[0], 0.1f);
  EXPECT_TRUE(trio.measure({allPixels()}).mobileFlip.empty());
}

} // namespace
} // namespace parity::compare
