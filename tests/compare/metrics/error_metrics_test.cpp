// RMSE, PSNR, relMSE and signed bias on closed forms, and which images each metric looks at.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "compare/metrics/measure.h"
#include "compare/pooling/region.h"
#include "error_code.h"

namespace parity::compare {
namespace {

Figures measureWhole(const ImagePair& pair, const std::vector<std::string>& metrics) {
  return measureRegions(pair, {wholeImage(pair.reference.width, pair.reference.height)}, {.metrics = metrics})
      .regions[0];
}

TEST(RelMse, DividesTheSquaredErrorByTheReferencesSquare) {
  base::Image display(2, 1, 3, 0.5f), reference(2, 1, 3, 2.f), test(2, 1, 3, 2.f);
  test.at(1, 0)[0] = 3.f; // an error of 1 where 2 was due, in one channel of six
  const double expected = 1 / (4 + 0.01) / 6;
  EXPECT_NEAR(measureWhole({display, display, &reference, &test}, {"relmse"}).find("relmse").value(), expected, 1e-7);
}

// Squares of 1e20 are no floats: the figure is still a number. (0.5e20)^2 / (1e20)^2 = 0.25.
TEST(RelMse, LightOf1e20IsComparedAsAnyOther) {
  const base::Image display(4, 4, 3, 1.f), reference(4, 4, 3, 1e20f), test(4, 4, 3, 0.5e20f);
  EXPECT_NEAR(measureWhole({display, display, &reference, &test}, {"relmse"}).find("relmse").value(), 0.25, 1e-7);
}

TEST(RelMse, DecodesDisplayedImagesWhereThereAreNoLinearOnes) {
  const base::Image reference(2, 2, 3, 188 / 255.f), test(2, 2, 3, 1.f);
  const double r = std::pow((188 / 255. + 0.055) / 1.055, 2.4); // IEC 61966-2-1
  EXPECT_NEAR(measureWhole({reference, test}, {"relmse"}).find("relmse").value(), (1 - r) * (1 - r) / (r * r + 0.01),
              1e-5);
}

TEST(Rmse, AndPsnrOfAConstantOffsetAndOfOneWrongChannel) {
  const base::Image a(7, 5, 3, 0.25f), b(7, 5, 3, 0.75f), black(4, 4, 3);
  base::Image one = black;
  one.at(2, 1)[0] = 1.f;
  const Figures offset = measureWhole({a, b}, {"rmse", "psnr"}), spread = measureWhole({black, one}, {"rmse", "psnr"});
  EXPECT_DOUBLE_EQ(offset.find("rmse").value(), 0.5);
  EXPECT_NEAR(offset.find("psnr").value(), 6.020599913, 1e-8); // 10 log10(4)
  EXPECT_NEAR(spread.find("rmse").value(), std::sqrt(1. / 48), 1e-8) << "over all pixels and channels, in floats";
  EXPECT_NEAR(spread.find("psnr").value(), 10 * std::log10(48.), 1e-6);
  EXPECT_EQ(measureWhole({one, one}, {"rmse", "psnr"}).find("psnr"), std::numeric_limits<double>::infinity());
}

TEST(Rmse, IsOfDisplayedImagesWhateverTheLinearOnes) {
  const base::Image display(3, 3, 3, 0.5f), reference(3, 3, 3, 1.f), test(3, 3, 3, 9.f);
  EXPECT_EQ(measureWhole({display, display, &reference, &test}, {"rmse"}).find("rmse"), 0);
}

TEST(Bias, OfHalfTheLightIsMinusOneEv) {
  const base::Image display(4, 4, 3, 0.5f);
  base::Image reference(4, 4, 3, 1.f), test(4, 4, 3, 0.5f);
  const auto ev = [&] { return measureWhole({display, display, &reference, &test}, {"bias"}).find("bias.ev").value(); };
  EXPECT_NEAR(ev(), std::log2((0.5 + 1. / 8192) / (1 + 1. / 8192)), 1e-6);
  EXPECT_NEAR(ev(), -1, 2e-4);
  std::swap(reference, test);
  EXPECT_NEAR(ev(), 1, 2e-4);
  // Of means: one bright pixel outweighs many dark ones.
  test = reference;
  test.at(0, 0)[1] += 16.f;
  EXPECT_NEAR(ev(), std::log2((0.5 + 0.7152) / 0.5), 1e-3);
}

TEST(Bias, OfBlackIsFiniteAndOfTwoBlacksNone) {
  const base::Image black(4, 4, 3, 0.f), white(4, 4, 3, 1.f);
  EXPECT_EQ(measureWhole({black, black}, {"bias"}).find("bias.ev"), 0);
  EXPECT_NEAR(measureWhole({black, white}, {"bias"}).find("bias.ev").value(), std::log2(8193.), 1e-6);
  EXPECT_NEAR(measureWhole({white, black}, {"bias"}).find("bias.ev").value(), -std::log2(8193.), 1e-6);
  EXPECT_NEAR(measureWhole({black, white}, {"bias"}).find("bias.dl").value(), 100, 1e-4);
}

// L* = 116 Y^(1/3) - 16; a warmer test has more b*, a redder one more a*.
TEST(Bias, OfLabIsTestMinusReferenceAndErrorsCancel) {
  const base::Image grey(2, 1, 3, 0.5f);
  base::Image test = grey;
  const double y = std::pow((0.5 + 0.055) / 1.055, 2.4), brighter = std::pow((0.6 + 0.055) / 1.055, 2.4);
  for (int c = 0; c < 3; ++c) test.at(1, 0)[c] = 0.6f;
  Figures f = measureWhole({grey, test}, {"bias"});
  EXPECT_NEAR(f.find("bias.dl").value(), 116 * (std::cbrt(brighter) - std::cbrt(y)) / 2, 1e-4);
  EXPECT_NEAR(f.find("bias.da").value(), 0, 1e-4);
  EXPECT_NEAR(f.find("bias.db").value(), 0, 1e-4);

  test = grey;
  test.at(0, 0)[2] = 0.3f;
  EXPECT_GT(measureWhole({grey, test}, {"bias"}).find("bias.db"), 1);
  EXPECT_LT(measureWhole({test, grey}, {"bias"}).find("bias.db"), -1);
  test = grey;
  test.at(0, 0)[0] = 0.7f;
  EXPECT_GT(measureWhole({grey, test}, {"bias"}).find("bias.da"), 1);

  base::Image left(2, 1, 3, 0.2f), right = left;
  for (int c = 0; c < 3; ++c) left.at(0, 0)[c] = right.at(1, 0)[c] = 0.8f;
  f = measureWhole({left, right}, {"bias"});
  for (const Figure& figure : f.values) EXPECT_NEAR(figure.value, 0, 1e-5) << figure.name;
}

TEST(Bias, OfDisplayedLabGoesWithTheDisplayAndEvWithTheLight) {
  const base::Image grey(2, 2, 3, 0.5f), bright(2, 2, 3, 4.f), brighter(2, 2, 3, 16.f);
  const Figures f = measureWhole({grey, grey, &bright, &brighter}, {"bias"}); // both clipped to the same white, say
  EXPECT_EQ(f.find("bias.dl"), 0);
  EXPECT_NEAR(f.find("bias.ev").value(), 2, 1e-3);
}

TEST(HdrFlip, NeedsLinearImagesAndSaysSo) {
  const base::Image grey(32, 32, 3, 0.5f);
  EXPECT_EQ(test::codeOf([&] { measureWhole({grey, grey}, {"hdrflip"}); }), base::ExitCode::notComparable);
  EXPECT_EQ(test::codeOf([&] {
              measureRegions({grey, grey}, {}, {.statistics = {"hdrflip.mean"}});
            }),
            base::ExitCode::notComparable);
}

TEST(HdrFlip, SeesADifferenceThatTheDisplayClipsAndNotesItsExposures) {
  std::mt19937 random(3);
  base::Image reference(48, 48, 3), test(48, 48, 3);
  for (float& v : reference.pixels) v = 1.f + static_cast<float>(random() % 1000) / 100.f;
  test = reference;
  for (int x = 10; x < 30; ++x) test.at(x, 20)[0] *= 3.f;
  const base::Image white(48, 48, 3, 1.f);
  const Measurement m =
      measureRegions({white, white, &reference, &test}, {wholeImage(48, 48)}, {.metrics = {"flip", "hdrflip"}});
  EXPECT_EQ(m.regions[0].find("flip.max"), 0);
  EXPECT_GT(m.regions[0].find("hdrflip.max"), 0.1);
  ASSERT_EQ(m.notes.size(), 1u);
  EXPECT_NE(m.notes[0].find("hdrflip: "), std::string::npos);
  EXPECT_NE(m.notes[0].find("exposures from"), std::string::npos) << m.notes[0];
  // As the engine alone.
  EXPECT_EQ(m.regions[0].find("hdrflip.max"),
            measureRegions({white, white, &reference, &test}, {wholeImage(48, 48)}, {.statistics = {"hdrflip.max"}})
                .regions[0]
                .find("hdrflip.max"));
}

} // namespace
} // namespace parity::compare
