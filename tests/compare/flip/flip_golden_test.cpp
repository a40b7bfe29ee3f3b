// LDR-FLIP against the maps and figures that NVIDIA's C++ tool v1.6 made of the synthetic pairs in golden/.
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/image/image_io.h"
#include "compare/flip/flip.h"
#include "compare/metrics/metrics.h"
#include "flip_oracle.h"
#include "golden.h"

namespace parity::compare {
namespace {

constexpr double kPixelTolerance = 1e-4, kMeanTolerance = 1e-6; // docs/design.md 10a

// Flat fields have no features, but the tool's float kernels find some 1e-8 there; under the square root of the feature
// difference that is 1e-4, and moves its map by up to 1.8e-5. The double-precision oracle sides with us (below).
constexpr double kToolsNoiseInFlatFields = 2e-5, kDrift = 5e-5;
constexpr double kNotPrinted = std::numeric_limits<double>::quiet_NaN();

// A row of docs/flip-metric.md 8's table: what the tool prints. kNotPrinted where the table has no figure.
struct GoldenCase {
  std::string pair, map;
  float ppd;
  double mean, median, q1, q3, min, max;
};

const GoldenCase kGoldenCases[] = {
    {"ldrsyn256", "ldrsyn256.flip", kDefaultPixelsPerDegree, .155656994, .220928873, .173131, .295348, .000074,
     .998370},
    {"ldrsyn256", "ldrsyn256.ppd20.flip", 20, .143722894, .242412373, .166605458, .30729425, 0, 1},
    {"ldrsyn256", "ldrsyn256.ppd40.flip", 40, .150985320, .221201807, .169799253, .290594518, .0000211, .999705911},
    {"ldrsyn256", "ldrsyn256.ppd120.flip", 120, .149440808, .206826195, .155486211, .286586255, .000512641, .990902185},
    {"ldrext64", "ldrext64.flip", kDefaultPixelsPerDegree, .983983982, .981903732, .967388332, 1, .967380941, 1},
    {"ldrtiny1x1", "ldrtiny1x1.flip", kDefaultPixelsPerDegree, .843659282, kNotPrinted, kNotPrinted, kNotPrinted,
     kNotPrinted, kNotPrinted},
    {"ldrtiny3x2", "ldrtiny3x2.flip", kDefaultPixelsPerDegree, .892178337, .882063448, .875442564, .899585366,
     .853894949, .963716447},
    {"ldrtiny5x64", "ldrtiny5x64.flip", kDefaultPixelsPerDegree, .503269246, .539579511, .433002412, .667879462,
     .128610104, .970408142},
    {"ldrtiny64x5", "ldrtiny64x5.flip", kDefaultPixelsPerDegree, .525993734, .558275521, .456621051, .682173133,
     .193607792, .97091186},
    {"ldrtiny17x11", "ldrtiny17x11.flip", kDefaultPixelsPerDegree, .568955011, .616166055, .508526385, .73638916,
     .144170851, .958795846},
};

void PrintTo(const GoldenCase& c, std::ostream* out) { *out << c.map; }

FlipMaps mapsOf(const std::string& pair, float ppd) {
  const base::Image reference = base::readImage(test::goldenFolder() / (pair + ".ref.png"));
  const base::Image test = base::readImage(test::goldenFolder() / (pair + ".test.png"));
  return flipMaps(reference, test, {.ppd = ppd});
}

class FlipGolden : public ::testing::TestWithParam<GoldenCase> {};

TEST_P(FlipGolden, EveryPixelIsTheReferenceToolsWithin1e4) {
  const GoldenCase& c = GetParam();
  EXPECT_TRUE(test::matchesGolden(mapsOf(c.pair, c.ppd).flip, c.map, kPixelTolerance));
}

TEST_P(FlipGolden, PooledFiguresAreWhatTheReferenceToolPrints) {
  const GoldenCase& c = GetParam();
  const Pooling pooled = poolMap(mapsOf(c.pair, c.ppd).flip);
  const bool isFlat = c.pair == "ldrext64" || c.pair == "ldrtiny1x1";
  EXPECT_NEAR(pooled.mean, c.mean, isFlat ? kToolsNoiseInFlatFields : kMeanTolerance);
  const auto expectPrinted = [](double actual, double printed, const char* what) {
    if (std::isfinite(printed)) {
      EXPECT_NEAR(actual, printed, kPixelTolerance) << what;
    }
  };
  expectPrinted(pooled.weightedMedian, c.median, "weighted median");
  expectPrinted(pooled.weightedQ1, c.q1, "first weighted quartile");
  expectPrinted(pooled.weightedQ3, c.q3, "third weighted quartile");
  expectPrinted(pooled.min, c.min, "minimum");
  expectPrinted(pooled.max, c.max, "maximum");
}

// The pooling alone, on the tool's own map. Its running sums are float32 and drift (docs/flip-metric.md 9a): they stop
// up to 2.9e-5 from where exact ones do.
TEST_P(FlipGolden, PoolingOfTheToolsOwnMapGivesTheDigitsItPrinted) {
  const GoldenCase& c = GetParam();
  const Pooling pooled = poolMap(base::readPfm(test::goldenFolder() / (c.map + ".pfm")));
  EXPECT_NEAR(pooled.mean, c.mean, 1e-9);
  const auto expectPrinted = [](double actual, double printed, const char* what) {
    if (std::isfinite(printed)) {
      EXPECT_NEAR(actual, printed, kDrift) << what;
    }
  };
  expectPrinted(pooled.weightedMedian, c.median, "weighted median");
  expectPrinted(pooled.weightedQ1, c.q1, "first weighted quartile");
  expectPrinted(pooled.weightedQ3, c.q3, "third weighted quartile");
  expectPrinted(pooled.min, c.min, "minimum");
  expectPrinted(pooled.max, c.max, "maximum");
}

// Without the tool's float noise in between: every pair, flat ones too.
TEST_P(FlipGolden, MeanIsTheDoublePrecisionOraclesWithin1e6) {
  const GoldenCase& c = GetParam();
  const base::Image reference = base::readImage(test::goldenFolder() / (c.pair + ".ref.png"));
  const base::Image test = base::readImage(test::goldenFolder() / (c.pair + ".test.png"));
  const std::vector<double> exact = oracle::flip(reference, test, static_cast<double>(c.ppd)).flip;
  const double mean = std::accumulate(exact.begin(), exact.end(), 0.) / static_cast<double>(exact.size());
  EXPECT_NEAR(poolMap(flipMap(reference, test, {.ppd = c.ppd})).mean, mean, kMeanTolerance);
}

INSTANTIATE_TEST_SUITE_P(Pairs, FlipGolden, ::testing::ValuesIn(kGoldenCases), [](const auto& instance) {
  std::string name = instance.param.map;
  for (char& c : name)
    if (c == '.') c = '_';
  return name;
});

TEST(FlipGoldenParts, ColorDifferenceIsTheReferenceToolsWithin1e4) {
  EXPECT_TRUE(
      test::matchesGolden(mapsOf("ldrsyn256", kDefaultPixelsPerDegree).color, "ldrsyn256.colordiff", kPixelTolerance));
}

TEST(FlipGoldenFailure, LeavesActualExpectedAndDifferenceAndTheCommandToUpdate) {
  base::Image wrong = base::readPfm(test::goldenFolder() / "ldrtiny3x2.flip.pfm");
  wrong.pixels[4] += 0.01f;
  const std::filesystem::path folder = test::testOutput() / "wrong-on-purpose";
  const auto result = test::matchesGolden(wrong, "ldrtiny3x2.flip", kPixelTolerance, folder);
  ASSERT_FALSE(result);
  const std::string message = result.message();
  EXPECT_NE(message.find("1 pixels differ"), std::string::npos) << message;
  EXPECT_NE(message.find("x 1, y 1"), std::string::npos) << message;
  EXPECT_NE(message.find("cp " + (folder / "ldrtiny3x2.flip.actual.pfm").string()), std::string::npos) << message;
  EXPECT_EQ(base::readPfm(folder / "ldrtiny3x2.flip.actual.pfm"), wrong);
  EXPECT_EQ(base::readPfm(folder / "ldrtiny3x2.flip.expected.pfm"),
            base::readPfm(test::goldenFolder() / "ldrtiny3x2.flip.pfm"));
  EXPECT_NEAR(base::readPfm(folder / "ldrtiny3x2.flip.difference.pfm").pixels[4], 0.01, 1e-6);
  std::filesystem::remove_all(folder);
}

TEST(FlipGoldenFailure, ANanInTheMapFails) {
  base::Image wrong = base::readPfm(test::goldenFolder() / "ldrtiny3x2.flip.pfm");
  wrong.pixels[0] = std::numeric_limits<float>::quiet_NaN();
  const std::filesystem::path folder = test::testOutput() / "nan-on-purpose";
  EXPECT_FALSE(test::matchesGolden(wrong, "ldrtiny3x2.flip", kPixelTolerance, folder));
  std::filesystem::remove_all(folder);
}

} // namespace
} // namespace parity::compare
