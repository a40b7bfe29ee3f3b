// Both paths against the truth: closed forms, its noise, what is not finite, terms.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/gathered.h"
#include "compare/metrics/measure_truth.h"
#include "support/not_finite.h"

namespace parity::compare {
namespace {

using tests::kInf, tests::kNan;
constexpr int kWidth = 32, kHeight = 24;

// Grey pictures; the truth is 0.5 with a relative standard error of 2 %.
struct Trio {
  base::Image truth{kWidth, kHeight, 3, 0.5f}, reference{kWidth, kHeight, 3, 0.5f}, test{kWidth, kHeight, 3, 0.5f};
  base::Image error{kWidth, kHeight, 1, 0.02f}, samples{kWidth, kHeight, 1, 400};
  std::vector<std::uint32_t> broken, testBroken; // known to be, though the pictures do not show it

  TruthInput input() const { return {{truth, &truth, broken}, {reference, &reference, {}}, {test, &test, testBroken}}; }
  Truth measure(const base::PixelList& list, double wanted = 0.02) const {
    return measureTruth(input(), {&error, &samples}, list,
                        {.wantedError = wanted, .reference = "high-end", .test = "mobile"})
        .truth;
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
  trio.reference = base::Image(kWidth, kHeight, 3, 0.6f);
  trio.test = base::Image(kWidth, kHeight, 3, 0.25f);
  const Truth truth = trio.measure(allPixels());
  const TruthFigures& found = truth.figures;
  EXPECT_NEAR(figure(found.reference, "relmse"), 0.1 * 0.1 / 0.26, 1e-7); // (t-r)^2 / (r^2 + 0.01)
  EXPECT_NEAR(figure(found.test, "relmse"), 0.25 * 0.25 / 0.26, 1e-7);
  EXPECT_NEAR(figure(found.reference, "bias.ev"), std::log2(0.6 / 0.5), 1e-3);
  EXPECT_NEAR(figure(found.test, "bias.ev"), -1, 1e-3);
  EXPECT_GT(figure(found.test, "flip.mean"), figure(found.reference, "flip.mean"));
  EXPECT_NEAR(found.reference.referenceLuma, 0.5, 1e-6) << "the truth is the reference";
  EXPECT_NEAR(found.reference.testLuma, 0.6, 1e-6);
  EXPECT_EQ(found.nonFinite, 0u);
  EXPECT_EQ(found.reference.pixels, 768u);
  EXPECT_TRUE(truth.notes.empty()) << truth.notes[0];
}

TEST(Truth, ItsErrorIsThatOfItsPixelsByWeight) {
  Trio trio;
  trio.reference = base::Image(kWidth, kHeight, 3, 5.f); // far away: no note
  trio.test = trio.reference;
  trio.error.pixels = std::vector<float>(trio.error.pixels.size(), 0.f);
  const float errors[] = {0.01f, 0.04f, 0.03f};
  for (std::size_t p = 0; p < 3; ++p) {
    trio.error.pixels[p] = errors[p];
    trio.samples.pixels[p] = static_cast<float>(100 * (p + 1));
  }
  const auto errorOf = [&](const base::PixelList& list) { return trio.measure(list, 1).figures.error; };
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
  trio.reference = base::Image(kWidth, kHeight, 3, 0.5f + 0.0199f);
  trio.test = base::Image(kWidth, kHeight, 3, 0.5f - 0.0201f);
  const Truth truth = trio.measure(allPixels());
  EXPECT_TRUE(isWithinNoise(truth.figures.reference, truth.figures.error));
  EXPECT_FALSE(isWithinNoise(truth.figures.test, truth.figures.error));
  ASSERT_EQ(truth.notes.size(), 1u);
  EXPECT_EQ(truth.notes[0], "high-end: the difference to the truth, relMSE 0.0015, is within 2 standard errors of the "
                            "truth; the noise of the truth alone gives 0.00038");
}

TEST(Truth, AnExactTruthHidesNothing) {
  Trio trio;
  trio.error = base::Image(kWidth, kHeight, 1);
  const Truth truth = trio.measure(allPixels());
  EXPECT_EQ(truth.figures.error.worst, 0);
  EXPECT_FALSE(isWithinNoise(truth.figures.reference, truth.figures.error));
  EXPECT_TRUE(truth.notes.empty());
}

TEST(Truth, NoiseIsTheSameInALightAndInADarkExposure) {
  // relMSE's 0.01 is a floor in exposed light, for noise and difference alike.
  for (const float light : {0.001f, 1.f, 1000.f}) {
    Trio trio;
    trio.truth = base::Image(kWidth, kHeight, 3, light);
    trio.reference = base::Image(kWidth, kHeight, 3, light * 1.0399f);
    trio.test = base::Image(kWidth, kHeight, 3, light * 1.0401f);
    const Truth truth = trio.measure(allPixels());
    EXPECT_TRUE(isWithinNoise(truth.figures.reference, truth.figures.error)) << light;
    EXPECT_FALSE(isWithinNoise(truth.figures.test, truth.figures.error)) << light;
  }
}

TEST(Truth, APixelThatDidNotReachItsErrorIsSaid) {
  Trio trio;
  trio.reference = trio.test = base::Image(kWidth, kHeight, 3, 0.9f);
  trio.error.pixels[5] = 0.0201f;
  const Truth regions[] = {trio.measure(allPixels()), trio.measure({"with", {5, 6}, {}}),
                           trio.measure({"without", {6, 7}, {}})};
  EXPECT_EQ(regions[0].notes,
            std::vector<std::string>{"the truth did not reach a standard error of 2 % at 1 of 768 pixels"});
  EXPECT_EQ(regions[1].notes,
            std::vector<std::string>{"the truth did not reach a standard error of 2 % at 1 of 2 pixels"});
  EXPECT_TRUE(regions[2].notes.empty());
}

TEST(Truth, ATruthThatIsNotFiniteIsCountedWhereItIs) {
  Trio trio;
  trio.broken = {5};
  const Truth regions[] = {trio.measure(allPixels()), trio.measure({"with", {5, 6}, {}}),
                           trio.measure({"without", {6, 7}, {}})};
  EXPECT_EQ(regions[0].figures.nonFinite, 1u);
  EXPECT_EQ(regions[1].figures.nonFinite, 1u);
  EXPECT_EQ(regions[1].figures.reference.nonFinite, 1u);
  EXPECT_GT(figure(regions[1].figures.reference, "relmse"), 1) << "the worst value, never an equal one";
  EXPECT_TRUE(std::isnan(regions[1].figures.error.median));
  EXPECT_FALSE(isWithinNoise(regions[1].figures.reference, regions[1].figures.error));
  EXPECT_EQ(regions[2].figures.nonFinite, 0u);
  EXPECT_EQ(figure(regions[2].figures.reference, "relmse"), 0);
}

TEST(Truth, APathThatIsNotFiniteIsNotTheTruths) {
  Trio trio;
  trio.test.pixels[15] = kInf;
  trio.testBroken = {6};
  const Truth truth = trio.measure(allPixels());
  EXPECT_EQ(truth.figures.nonFinite, 0u);
  EXPECT_EQ(truth.figures.test.nonFinite, 2u);
  EXPECT_EQ(truth.figures.reference.nonFinite, 0u);
}

TEST(Truth, AnErrorThatIsNotKnownIsNotNone) {
  Trio trio;
  trio.error.pixels[5] = kInf;
  const Truth truth = trio.measure({"m", {5, 6}, {}});
  for (const double value : {truth.figures.error.median, truth.figures.error.worst, truth.figures.error.relmse})
    EXPECT_TRUE(std::isnan(value));
  ASSERT_EQ(truth.notes.size(), 1u);
  EXPECT_EQ(truth.notes[0], "the error of the truth is unknown at 1 of 2 pixels");
}

TEST(Truth, WhatIsNotSeenHasNoFigures) {
  const Truth truth = Trio().measure({"m", {}, {}});
  EXPECT_EQ(truth.figures.reference.pixels, 0u);
  EXPECT_TRUE(truth.figures.reference.values.empty());
  EXPECT_TRUE(truth.notes.empty());
}

TEST(Truth, ATermThatTheTruthLacksCountsAHundredTimesItsSquaredLight) {
  Trio trio;
  trio.truth = base::Image(kWidth, kHeight, 3);
  trio.reference = base::Image(kWidth, kHeight, 3, 0.1f);
  trio.test = base::Image(kWidth, kHeight, 3);
  const TruthTerm term = measureTerm("fog", trio.input(), allPixels(), {});
  EXPECT_EQ(term.name, "fog");
  EXPECT_NEAR(figure(term.referenceFigures, "relmse"), 1, 1e-6);
  EXPECT_EQ(figure(term.testFigures, "relmse"), 0) << "black in both is alike";
  EXPECT_GT(figure(term.referenceFigures, "flip.mean"), 0.1);
  EXPECT_EQ(term.referenceFigures.values.size(), 2u);
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
  trio.test = base::Image(kWidth, kHeight, 3, 0.9f);
  const TruthMeasurement kept =
      measureTruth(trio.input(), {&trio.error, &trio.samples}, allPixels(), {.keepMaps = true});
  EXPECT_EQ(kept.referenceFlip.at(5, 5)[0], 0);
  EXPECT_GT(kept.testFlip.at(5, 5)[0], 0.1f);
  EXPECT_TRUE(measureTruth(trio.input(), {&trio.error, &trio.samples}, allPixels(), {}).testFlip.empty());
}

// Materials, by the swap: the truth's picture in bytes in which one material alone has a path's colours.
struct SwappedTrio {
  Trio trio;
  base::Image8 shown{kWidth, kHeight, 3};

  SwappedTrio() { std::ranges::fill(shown.pixels, std::uint8_t{128}); }
  TruthPicture truth() const { return {shown, &trio.truth, trio.broken}; }
  // Greys of a path at the list.
  static Swap greys(const base::PixelList& list, float grey, std::uint8_t displayed) {
    Swap swap{&list,
              base::makeGathered<std::uint8_t>(list.pixels.size(), 3),
              base::makeGathered<float>(list.pixels.size(), 3),
              {}};
    std::fill_n(swap.displayed.pixels.begin(), 3 * list.pixels.size(), displayed);
    std::fill_n(swap.linear.pixels.begin(), 3 * list.pixels.size(), grey);
    return swap;
  }
  std::vector<Truth> measure(const std::vector<TruthSwap>& swaps, double wanted = 0.02) const {
    return measureTruthSwaps(truth(), {&trio.error, &trio.samples}, swaps,
                             {.wantedError = wanted, .reference = "high-end", .test = "mobile"});
  }
};

base::PixelList columns(const char* name, int begin, int end) {
  base::PixelList list{name, {}, {}};
  for (int y = 0; y < kHeight; ++y)
    for (int x = begin; x < end; ++x) list.pixels.push_back(static_cast<std::uint32_t>(y * kWidth + x));
  return list;
}

TEST(TruthSwaps, EachMaterialHasItsClosedFormsAndNothingOfItsNeighbours) {
  const SwappedTrio trio;
  const base::PixelList left = columns("left", 0, 16), right = columns("right", 16, kWidth), none{"none", {}, {}};
  const auto found = trio.measure({{SwappedTrio::greys(left, 0.6f, 140), SwappedTrio::greys(left, 0.25f, 90)},
                                   {SwappedTrio::greys(none, 0, 0), SwappedTrio::greys(none, 0, 0)},
                                   {SwappedTrio::greys(right, 0.5f, 128), SwappedTrio::greys(right, 5.f, 255)}});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].figures.reference.pixels, 16u * kHeight);
  EXPECT_NEAR(figure(found[0].figures.reference, "relmse"), 0.1 * 0.1 / 0.26, 1e-7);
  EXPECT_NEAR(figure(found[0].figures.test, "relmse"), 0.25 * 0.25 / 0.26, 1e-7);
  EXPECT_NEAR(figure(found[0].figures.test, "bias.ev"), -1, 1e-3);
  EXPECT_NEAR(found[0].figures.reference.referenceLuminance, 0.5, 1e-6) << "the truth is the reference";
  EXPECT_EQ(found[1].figures.reference.pixels, 0u);
  EXPECT_TRUE(found[1].figures.test.values.empty());
  EXPECT_TRUE(found[1].notes.empty());
  EXPECT_EQ(figure(found[2].figures.reference, "flip.max"), 0) << "the other material's error stays where it is";
  EXPECT_EQ(figure(found[2].figures.reference, "relmse"), 0);
  EXPECT_GT(figure(found[2].figures.test, "flip.mean"), 0.1);
}

TEST(TruthSwaps, ErrorAndNotesAreThoseOfTheMaterialsPixels) {
  SwappedTrio trio;
  const base::PixelList left = columns("left", 0, 16), right = columns("right", 16, kWidth);
  trio.trio.error.pixels[3] = 0.5f; // of the left one
  trio.trio.broken = {20};          // of the right one
  const auto swapsOf = [](const base::PixelList& list) {
    return TruthSwap{SwappedTrio::greys(list, 0.9f, 200), SwappedTrio::greys(list, 0.505f, 129)};
  };
  const auto found = trio.measure({swapsOf(left), swapsOf(right)});
  EXPECT_FLOAT_EQ(static_cast<float>(found[0].figures.error.worst), 0.5f);
  EXPECT_FLOAT_EQ(static_cast<float>(found[0].figures.error.median), 0.02f);
  EXPECT_EQ(found[0].figures.error.samples, 400);
  EXPECT_EQ(found[0].figures.nonFinite, 0u);
  ASSERT_EQ(found[0].notes.size(), 2u);
  EXPECT_EQ(found[0].notes[0], "the truth did not reach a standard error of 2 % at 1 of 384 pixels");
  EXPECT_EQ(found[0].notes[1].find("mobile: the difference to the truth, relMSE "), 0u) << found[0].notes[1];
  EXPECT_EQ(found[1].figures.nonFinite, 1u);
  EXPECT_EQ(found[1].figures.reference.nonFinite, 1u);
  EXPECT_TRUE(std::isnan(found[1].figures.error.median));
  EXPECT_TRUE(found[1].notes.empty()) << "an error that is not known hides nothing: " << found[1].notes[0];
}

TEST(TruthSwaps, AMaterialThatIsAllOfThePictureHasTheWholeImagesFigures) {
  SwappedTrio trio;
  for (std::size_t p = 0; p < trio.trio.error.pixels.size(); ++p)
    trio.trio.error.pixels[p] = 0.001f * static_cast<float>(p % 40);
  const base::PixelList list = allPixels();
  const auto found = trio.measure({{SwappedTrio::greys(list, 0.6f, 140), SwappedTrio::greys(list, 0.25f, 90)}});
  base::Image8 highend(kWidth, kHeight, 3), mobile(kWidth, kHeight, 3);
  std::ranges::fill(highend.pixels, std::uint8_t{140});
  std::ranges::fill(mobile.pixels, std::uint8_t{90});
  const base::Image highendLight(kWidth, kHeight, 3, 0.6f), mobileLight(kWidth, kHeight, 3, 0.25f);
  const Truth whole = measureTruth({trio.truth(), {highend, &highendLight, {}}, {mobile, &mobileLight, {}}},
                                   {&trio.trio.error, &trio.trio.samples}, list, {.wantedError = 0.02})
                          .truth;
  for (const auto& [swap, picture] : {std::pair{&found[0].figures.reference, &whole.figures.reference},
                                      {&found[0].figures.test, &whole.figures.test}}) {
    ASSERT_EQ(swap->values.size(), picture->values.size());
    for (std::size_t i = 0; i < swap->values.size(); ++i)
      EXPECT_NEAR(swap->values[i].value, picture->values[i].value, 1e-6) << swap->values[i].name;
  }
  EXPECT_EQ(found[0].figures.error.relmse, whole.figures.error.relmse);
  EXPECT_EQ(found[0].notes, whole.notes);
}

TEST(TruthSwaps, TermsHaveFlipAndRelMseOfEachMaterial) {
  const SwappedTrio trio;
  const base::PixelList left = columns("left", 0, 16), right = columns("right", 16, kWidth);
  const std::vector<TruthSwap> swaps = {{SwappedTrio::greys(left, 0.6f, 140), SwappedTrio::greys(left, 0.25f, 90)},
                                        {SwappedTrio::greys(right, 0.5f, 128), SwappedTrio::greys(right, 0.5f, 128)}};
  const auto terms = measureTermSwaps("fog", trio.truth(), swaps);
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_EQ(terms[0].name, "fog");
  EXPECT_EQ(terms[0].referenceFigures.values.size(), 2u);
  EXPECT_NEAR(figure(terms[0].referenceFigures, "relmse"), 0.1 * 0.1 / 0.26, 1e-7);
  EXPECT_GT(figure(terms[0].testFigures, "flip.mean"), figure(terms[0].referenceFigures, "flip.mean"));
  EXPECT_EQ(figure(terms[1].referenceFigures, "flip.mean"), 0);
  EXPECT_EQ(figure(terms[1].testFigures, "relmse"), 0);
}

} // namespace
} // namespace parity::compare
