// Figures per region: closed forms, weights, clipping and light, what is not finite, what is malformed.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "compare/metrics/measure.h"
#include "compare/pooling/region.h"
#include "error_code.h"
#include "support/not_finite.h"

namespace parity::compare {
namespace {

using tests::kInf, tests::kNan;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Pair {
  base::Image reference{4, 2, 3, 0.5f}, test{4, 2, 3, 0.5f};
  ImagePair images() const { return {reference, test}; }
};

std::vector<std::string> allDisplayed() {
  std::vector<std::string> names;
  for (const Metric& metric : metricRegistry())
    if (!metric.needsLinear) names.push_back(metric.name);
  return names;
}

Figures figuresOf(const ImagePair& pair, const base::PixelList& list, const std::vector<std::string>& metrics) {
  return measureRegions(pair, {list}, {.metrics = metrics}).regions[0];
}

double valueOf(const Figures& figures, const std::string& name) {
  const std::optional<double> value = figures.find(name);
  EXPECT_TRUE(value) << name;
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

TEST(Measure, ErrorsOfARegionAreTheirClosedForms) {
  Pair p;
  for (int x = 0; x < 2; ++x)
    for (int c = 0; c < 3; ++c) p.test.at(x, 0)[c] = 0.75f;
  const Figures f = figuresOf(p.images(), {"m", {0, 1, 2, 3}, {}}, {"rmse", "psnr", "maxabs"});
  EXPECT_EQ(f.pixels, 4u);
  EXPECT_EQ(f.nonFinite, 0u);
  EXPECT_NEAR(valueOf(f, "rmse"), 0.25 * std::sqrt(0.5), 1e-8);
  EXPECT_NEAR(valueOf(f, "psnr"), 10 * std::log10(32.), 1e-6);
  EXPECT_EQ(valueOf(f, "maxabs"), 0.25);
  EXPECT_NEAR(f.referenceLuma, 0.5, 1e-7);
  EXPECT_NEAR(f.testLuma, 0.625, 1e-7);
}

TEST(Measure, PixelWeightsCountAsSharesOfAPixel) {
  Pair p;
  p.test.at(1, 0)[1] = 1.f;
  const Figures f = figuresOf(p.images(), {"m", {0, 1, 2}, {1.f, 0.25f, 0.f}}, {"rmse"});
  EXPECT_EQ(f.pixels, 2u); // a weight of 0 is not in the region
  EXPECT_NEAR(valueOf(f, "rmse"), std::sqrt(0.25 * 0.25 / (3 * 1.25)), 1e-8);
  EXPECT_NEAR(f.testLuma, 0.5 + 0.2 * 0.5 * 0.7152, 1e-7);
}

TEST(Measure, FiguresComeInTheRegistrysOrderWhateverTheRequests) {
  const Pair p;
  const Measurement m =
      measureRegions(p.images(), {{"m", {1, 2}, {}}},
                     {.metrics = {"psnr", "flip"},
                      .statistics = {"flip.fraction_over(0.25)", "flip.mean", "maxabs", "flip.fraction_over(0.250)"}});
  std::vector<std::string> names;
  for (const Figure& figure : m.regions[0].values) names.push_back(figure.name);
  EXPECT_EQ(names, (std::vector<std::string>{"flip.mean", "flip.p50", "flip.p95", "flip.p99", "flip.max",
                                             "flip.fraction_over(0.25)", "psnr", "maxabs"}));
  EXPECT_TRUE(m.maps.empty());
}

TEST(Measure, OnlyNamedFiguresOfAMetricThatIsNotAskedFor) {
  const Pair p;
  const Measurement m =
      measureRegions(p.images(), {{"m", {1}, {}}}, {.statistics = {"flip.p95"}, .keepMaps = {"flip"}});
  ASSERT_EQ(m.regions[0].values.size(), 1u);
  EXPECT_EQ(m.regions[0].values[0].name, "flip.p95");
  ASSERT_NE(m.findMap("flip"), nullptr);
  EXPECT_EQ(m.findMap("flip")->width, 4);
  EXPECT_EQ(m.findMap("rmse"), nullptr);
}

TEST(Measure, AnEmptyRegionHasNoPixelsAndNoFigures) {
  const Pair p;
  for (const base::PixelList& list : {base::PixelList{"none", {}, {}}, base::PixelList{"weightless", {1, 2}, {0, 0}}}) {
    const Figures f = figuresOf(p.images(), list, allDisplayed());
    EXPECT_EQ(f.pixels, 0u);
    EXPECT_TRUE(f.values.empty());
    EXPECT_EQ(f.referenceLuma, 0);
  }
}

TEST(Measure, IdenticalRegionsHaveNoErrorInAnyMetric) {
  std::mt19937 random(1);
  base::Image image(64, 48, 3);
  for (float& v : image.pixels) v = static_cast<float>(random() % 256) / 255.f;
  const base::Image copy = image;
  const Figures f = figuresOf({image, copy}, wholeImage(64, 48), allDisplayed());
  for (const Figure& figure : f.values) {
    const Statistic statistic = requireStatistic(figure.name, "test");
    EXPECT_EQ(figure.value, statistic.better == Better::higher ? statistic.most : 0) << figure.name;
  }
}

// Each way of not being finite, in each image; every figure is then a number, and no better than of a sane pixel.
TEST(Measure, NonFinitePixelsAreCountedAndEnterAsTheWorstErrorOfEveryMetric) {
  const int size = 48;
  base::Image reference(size, size, 3, 0.5f), test(size, size, 3, 0.52f), linearReference(size, size, 3, 0.2f),
      linearTest(size, size, 3, 0.21f);
  const base::PixelList list = wholeImage(size, size);
  const Figures sane = figuresOf({reference, test, &linearReference, &linearTest}, list, allDisplayed());
  reference.at(3, 3)[1] = kNan;
  test.at(9, 3)[0] = kInf;
  linearReference.at(20, 30)[2] = -kInf;
  linearTest.at(21, 30)[2] = kNan;
  linearTest.at(3, 3)[0] = kNan; // the same pixel as above
  const std::vector<std::uint32_t> invalid = {47, 46, 47};
  const Figures f = figuresOf({reference, test, &linearReference, &linearTest, invalid}, list, allDisplayed());
  EXPECT_EQ(f.pixels, static_cast<std::uint64_t>(size * size));
  EXPECT_EQ(f.nonFinite, 6u);
  ASSERT_EQ(f.values.size(), sane.values.size());
  for (std::size_t i = 0; i < f.values.size(); ++i) {
    const Statistic statistic = requireStatistic(f.values[i].name, "test");
    const double value = f.values[i].value, before = sane.values[i].value;
    ASSERT_TRUE(std::isfinite(value)) << statistic.name;
    const bool isTail = statistic.name.find(".p") != std::string::npos; // six pixels need not reach a percentile
    const double worse = statistic.better == Better::higher     ? before - value
                         : statistic.better == Better::nearZero ? std::fabs(value) - std::fabs(before)
                                                                : value - before;
    if (isTail)
      EXPECT_GE(worse, -1e-9) << statistic.name;
    else
      EXPECT_GT(worse, 0) << statistic.name;
  }
  EXPECT_EQ(valueOf(f, "flip.max"), 1);
  EXPECT_EQ(valueOf(f, "maxabs"), 1);
  EXPECT_TRUE(std::isfinite(f.referenceLuma) && std::isfinite(f.testLuma));
  const Measurement kept = measureRegions({reference, test}, {}, {.keepMaps = {"flip"}});
  EXPECT_EQ(*kept.findMap("flip")->at(3, 3), 1.f);
  EXPECT_EQ(*kept.findMap("flip")->at(9, 3), 1.f);
}

TEST(Measure, TheExposureMapIsKeptBesideHdrFlip) {
  Pair p;
  for (std::size_t i = 0; i < p.test.pixels.size(); ++i) p.test.pixels[i] = 0.3f + 0.4f * static_cast<float>(i);
  const Measurement kept = measureRegions({p.reference, p.test, &p.test, &p.reference}, {}, {.keepMaps = {"hdrflip"}});
  const HdrFlip direct = flipHdr(p.test, p.reference);
  ASSERT_NE(kept.findMap("hdrflip", 1), nullptr);
  EXPECT_EQ(*kept.findMap("hdrflip"), direct.flip);
  EXPECT_EQ(*kept.findMap("hdrflip", 1), direct.exposure);
  EXPECT_EQ(kept.findMap("hdrflip", 2), nullptr);
}

TEST(Measure, SharesOfPixelsByTheirLargestDifferenceAreCounted) {
  Pair p;
  p.test.at(0, 0)[1] = 0.75f, p.test.at(1, 0)[2] = 0.375f; // differences of 1/4 and 1/8, of 8 pixels
  const Measurement m =
      measureRegions(p.images(), {{"m", {0, 1, 2, 3, 4, 5, 6, 7}, {}}},
                     {.statistics = {"maxabs", "maxabs.fraction_over(0.1)", "maxabs.fraction_over(0.125)"}});
  EXPECT_EQ(valueOf(m.regions[0], "maxabs"), 0.25);
  EXPECT_EQ(valueOf(m.regions[0], "maxabs.fraction_over(0.1)"), 0.25);
  EXPECT_EQ(valueOf(m.regions[0], "maxabs.fraction_over(0.125)"), 0.125) << "strictly above";
}

TEST(Measure, ARegionOfNothingButNonFinitePixelsHasTheWorstFigures) {
  Pair p;
  p.reference.at(0, 0)[0] = kNan;
  const Figures f = figuresOf(p.images(), {"m", {0}, {}}, allDisplayed());
  EXPECT_EQ(valueOf(f, "flip.mean"), 1);
  EXPECT_EQ(valueOf(f, "rmse"), 1);
  EXPECT_EQ(valueOf(f, "psnr"), 0);
  EXPECT_NE(valueOf(f, "bias.ev"), 0);
}

TEST(Measure, BytesAndTheSameValuesAsFloatsGiveTheSameFigures) {
  std::mt19937 random(2);
  base::Image8 reference(70, 50, 3), test(70, 50, 3);
  for (std::uint8_t& v : reference.pixels) v = static_cast<std::uint8_t>(random());
  for (std::uint8_t& v : test.pixels) v = static_cast<std::uint8_t>(random());
  const auto floats = [](const base::Image8& image) {
    base::Image out(image.width, image.height, 3);
    std::transform(image.pixels.begin(), image.pixels.end(), out.pixels.begin(),
                   [](std::uint8_t v) { return static_cast<float>(v) / 255.f; });
    return out;
  };
  const base::Image referenceFloats = floats(reference), testFloats = floats(test);
  const base::PixelList list = wholeImage(70, 50);
  const Figures bytes = figuresOf({reference, test}, list, allDisplayed()),
                same = figuresOf({referenceFloats, testFloats}, list, allDisplayed());
  for (std::size_t i = 0; i < bytes.values.size(); ++i)
    EXPECT_NEAR(bytes.values[i].value, same.values[i].value, 1e-5 * (1 + std::fabs(same.values[i].value)))
        << bytes.values[i].name;
}

TEST(Measure, OnlyTheBoxIsNeededAndTheFiguresAreTheSame) {
  std::mt19937 random(3);
  base::Image reference(120, 90, 3), test(120, 90, 3);
  for (float& v : reference.pixels) v = static_cast<float>(random() % 256) / 255.f;
  for (float& v : test.pixels) v = static_cast<float>(random() % 256) / 255.f;
  base::PixelList list{"m", {}, {}};
  for (std::uint32_t y = 30; y < 60; ++y)
    for (std::uint32_t x = 41; x < 77; ++x) list.pixels.push_back(y * 120 + x);
  MeasureRequest request{.metrics = allDisplayed()};
  const Measurement everywhere = measureRegions({reference, test}, {list}, request);
  request.options.box = Rect{41, 30, 36, 30};
  request.keepMaps = {"rmse"};
  const Measurement boxed = measureRegions({reference, test}, {list}, request);
  for (std::size_t i = 0; i < everywhere.regions[0].values.size(); ++i) {
    const Figure &a = everywhere.regions[0].values[i], &b = boxed.regions[0].values[i];
    EXPECT_NEAR(a.value, b.value, 1e-6 * (1 + std::fabs(a.value))) << a.name;
  }
  EXPECT_EQ(*boxed.findMap("rmse")->at(40, 30), 0);
  EXPECT_GT(*boxed.findMap("rmse")->at(41, 30), 0);
  list.pixels.insert(list.pixels.begin(), 29 * 120 + 41); // just above the box
  EXPECT_EQ(test::codeOf([&] { measureRegions({reference, test}, {list}, request); }), base::ExitCode::failed);
  request.options.box = Rect{100, 0, 30, 10};
  EXPECT_EQ(test::codeOf([&] { measureRegions({reference, test}, {}, request); }), base::ExitCode::failed);
}

TEST(Measure, ManyRegionsAreMeasuredAsEachAlone) {
  std::mt19937 random(4);
  base::Image reference(64, 64, 3), test(64, 64, 3);
  for (float& v : reference.pixels) v = static_cast<float>(random() % 256) / 255.f;
  for (float& v : test.pixels) v = static_cast<float>(random() % 256) / 255.f;
  std::vector<base::PixelList> lists(16);
  for (std::uint32_t pixel = 0; pixel < 64 * 64; ++pixel) lists[random() % 16].pixels.push_back(pixel);
  const MeasureRequest request{.metrics = {"flip", "rmse", "bias"}};
  const Measurement together = measureRegions({reference, test}, lists, request);
  const base::ThreadLimit one(1);
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const Measurement alone = measureRegions({reference, test}, {lists[i]}, request);
    for (std::size_t k = 0; k < alone.regions[0].values.size(); ++k)
      EXPECT_EQ(together.regions[i].values[k].value, alone.regions[0].values[k].value);
  }
}

TEST(Measure, MalformedRegionsUnlikeImagesAndUnknownNamesAreErrors) {
  using base::ExitCode;
  const Pair p;
  const auto code = [&](const base::PixelList& list) {
    return test::codeOf([&] { figuresOf(p.images(), list, {"rmse"}); });
  };
  EXPECT_EQ(code({"m", {8}, {}}), ExitCode::failed);
  EXPECT_EQ(code({"m", {2, 1}, {}}), ExitCode::failed);
  EXPECT_EQ(code({"m", {1, 1}, {}}), ExitCode::failed);
  EXPECT_EQ(code({"m", {1, 2}, {1}}), ExitCode::failed);
  EXPECT_EQ(code({"m", {1, 2}, {1, -1}}), ExitCode::failed);
  EXPECT_EQ(code({"m", {1, 2}, {1, kNan}}), ExitCode::failed);
  const auto codeOfPair = [&](const ImagePair& pair) {
    return test::codeOf([&] { figuresOf(pair, {"m", {1}, {}}, {"rmse"}); });
  };
  const base::Image taller(4, 3, 3), grey(4, 2, 1);
  EXPECT_EQ(codeOfPair({p.reference, taller}), ExitCode::notComparable);
  EXPECT_EQ(codeOfPair({p.reference, grey}), ExitCode::notComparable);
  EXPECT_EQ(codeOfPair({grey, grey}), ExitCode::notComparable);
  EXPECT_EQ(codeOfPair({base::Image(), base::Image()}), ExitCode::notComparable);
  EXPECT_EQ(codeOfPair({p.reference, p.test, &p.reference, nullptr}), ExitCode::notComparable);
  EXPECT_EQ(codeOfPair({p.reference, p.test, &p.reference, &taller}), ExitCode::notComparable);
  const std::vector<std::uint32_t> outside = {8};
  EXPECT_EQ(codeOfPair({p.reference, p.test, nullptr, nullptr, outside}), ExitCode::failed);
  const auto codeOfRequest = [&](const MeasureRequest& request) {
    return test::codeOf([&] { measureRegions(p.images(), {{"m", {1}, {}}}, request); });
  };
  EXPECT_EQ(codeOfRequest({.metrics = {"flap"}}), ExitCode::usage);
  EXPECT_EQ(codeOfRequest({.statistics = {"flip.p96"}}), ExitCode::usage);
  EXPECT_EQ(codeOfRequest({.keepMaps = {""}}), ExitCode::usage);
}

// Two materials side by side; only the right one differs between the images. The left one's FLIP sees it through the
// filters: why materials are measured by the swap (measure_swaps_test.cpp) and not as parts of a picture.
TEST(Measure, ANeighboursErrorBleedsIntoFilteredFiguresOfAPicture) {
  const int size = 64, border = 32;
  std::mt19937 random(8);
  base::Image reference(size, size, 3);
  for (float& v : reference.pixels) v = static_cast<float>(random() >> 8) / 16777216.f;
  base::Image test = reference;
  const int reach = flipFilterRadius({});
  base::PixelList left{"left", {}, {}}, far{"far", {}, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const auto pixel = static_cast<std::uint32_t>(y * size + x);
      if (x < border) left.pixels.push_back(pixel);
      if (x < border - reach) far.pixels.push_back(pixel);
      if (x >= border) test.at(x, y)[1] = 1.f - test.at(x, y)[1];
    }
  const auto regions = measureRegions({reference, test}, {left, far}, {.metrics = {"flip", "rmse"}}).regions;
  EXPECT_EQ(regions[0].pixels, static_cast<std::uint64_t>(border * size));
  EXPECT_GT(valueOf(regions[0], "flip.max"), 0.05);
  EXPECT_EQ(valueOf(regions[0], "rmse"), 0); // not filtered: no bleeding
  EXPECT_EQ(valueOf(regions[1], "flip.max"), 0) << "beyond the filters' reach";
}

// Pixels where both pictures are at the same end of the display's range: no metric of them can tell a difference.
TEST(Measure, ClippedPixelsAreThoseAtTheSameEndInBothPictures) {
  Pair p; // 8 pixels of 0.5
  const auto set = [](base::Image& image, int x, int y, std::array<float, 3> rgb) {
    std::ranges::copy(rgb, image.at(x, y));
  };
  const std::array<float, 3> black = {0, 0, 0}, white = {1, 1, 1};
  set(p.reference, 0, 0, black), set(p.test, 0, 0, black);
  set(p.reference, 1, 0, white), set(p.test, 1, 0, white);
  set(p.reference, 2, 0, white), set(p.test, 2, 0, black);         // all that there can be between them
  set(p.reference, 3, 0, white), set(p.test, 3, 0, {1, 1, 0.99f}); // one channel tells
  set(p.reference, 0, 1, black), set(p.test, 0, 1, {0, 1e-6f, 0});
  set(p.test, 1, 1, white); // of one picture alone
  const Figures f = figuresOf(p.images(), {"m", {0, 1, 2, 3, 4, 5, 6, 7}, {}}, {"rmse"});
  EXPECT_EQ(f.clippedBlack, 1 / 8.);
  EXPECT_EQ(f.clippedWhite, 1 / 8.);
  EXPECT_EQ(f.clipped(), 1 / 4.);
  const Figures weighted = figuresOf(p.images(), {"m", {0, 1, 2}, {0.25f, 0.5f, 0.25f}}, {"rmse"});
  EXPECT_EQ(weighted.clippedBlack, 0.25);
  EXPECT_EQ(weighted.clippedWhite, 0.5);

  base::Image8 bytes(4, 2, 3);
  std::ranges::fill(bytes.pixels, std::uint8_t{255});
  base::Image8 other = bytes;
  other.at(3, 1)[1] = 254;
  const Figures shown = figuresOf({bytes, other}, wholeImage(4, 2), {"rmse"});
  EXPECT_EQ(shown.clippedWhite, 7 / 8.);
  EXPECT_EQ(shown.clippedBlack, 0);
}

// Weights whose sums round: a share of all is 1, not one beside it.
TEST(Measure, AllOfARegionIsAShareOfOneWhateverItsWeights) {
  std::mt19937 random(12);
  base::Image black(64, 64, 3), white(64, 64, 3, 1.f);
  base::PixelList list = wholeImage(64, 64);
  for (std::size_t i = 0; i < list.pixels.size(); ++i)
    list.weights.push_back(std::ldexp(static_cast<float>(random() >> 8) + 1.f, -24 - static_cast<int>(random() % 60)));
  EXPECT_NEAR(figuresOf({black, black}, list, {"rmse"}).clippedBlack, 1, 1e-12);
  EXPECT_LE(figuresOf({black, black}, list, {"rmse"}).clippedBlack, 1);
  EXPECT_LE(figuresOf({white, white}, list, {"rmse"}).clippedWhite, 1);
}

TEST(Measure, LuminancesAreOfTheLightBeforeItIsClipped) {
  Pair p;
  const base::Image shown(4, 2, 3, 1.f);
  base::Image reference(4, 2, 3, 2.f), test(4, 2, 3, 8.f);
  reference.at(1, 0)[0] = 4.f;
  const base::PixelList list{"m", {0, 1}, {1.f, 0.5f}};
  const Figures f = figuresOf({shown, shown, &reference, &test}, list, {"rmse"});
  EXPECT_NEAR(f.referenceLuminance, 2 + 0.2126 * 2 * 0.5 / 1.5, 1e-6);
  EXPECT_NEAR(f.testLuminance, 8, 1e-6);
  EXPECT_EQ(f.referenceLuma, f.testLuma) << "as displayed";
  EXPECT_EQ(f.clippedWhite, 1);

  // Without linear images that of the displayed ones, decoded: IEC 61966-2-1.
  const double decoded = std::pow((0.5 + 0.055) / 1.055, 2.4);
  EXPECT_NEAR(figuresOf(p.images(), list, {"rmse"}).referenceLuminance, decoded, 1e-6);
}

TEST(Measure, PixelsThatAreNotFiniteAreNeitherClippedNorLight) {
  Pair p;
  for (base::Image* image : {&p.reference, &p.test}) std::ranges::fill(image->pixels, 0.f);
  p.test.at(1, 0)[0] = kNan;
  const std::vector<std::uint32_t> invalid = {3};
  const Figures f = figuresOf({p.reference, p.test, nullptr, nullptr, invalid}, {"m", {0, 1, 2, 3}, {}}, {"rmse"});
  EXPECT_EQ(f.nonFinite, 2u);
  EXPECT_EQ(f.clippedBlack, 0.5);
  EXPECT_EQ(f.testLuminance, 0);
}

} // namespace
} // namespace parity::compare
