// Figures of the material swap: those of the whole picture in which the one material is swapped, over its pixels.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/gathered.h"
#include "compare/flip/random_images.h"
#include "compare/metrics/measure_swaps.h"
#include "compare/pooling/region.h"
#include "error_code.h"

namespace parity::compare {
namespace {

constexpr int kSwapWidth = 240, kSwapHeight = 200; // MS-SSIM has all of its scales

base::Image8 toBytes(const base::Image& image) {
  base::Image8 out(image.width, image.height, 3);
  std::ranges::transform(image.pixels, out.pixels.begin(),
                         [](float v) { return static_cast<std::uint8_t>(std::clamp(v, 0.f, 1.f) * 255 + 0.5f); });
  return out;
}

template <typename T> base::BasicImage<T> gather(const base::BasicImage<T>& image, const base::PixelList& list) {
  auto out = base::makeGathered<T>(list.pixels.size(), 3);
  for (std::size_t i = 0; i < list.pixels.size(); ++i)
    std::copy_n(&image.pixels[3 * std::size_t{list.pixels[i]}], 3, &out.pixels[3 * i]);
  return out;
}
template <typename T> base::BasicImage<T> swapPixels(base::BasicImage<T> base, const base::BasicImage<T>& other,
                                                     const base::PixelList& list) {
  for (const std::uint32_t p : list.pixels)
    std::copy_n(&other.pixels[3 * std::size_t{p}], 3, &base.pixels[3 * std::size_t{p}]);
  return base;
}

base::PixelList box(int x0, int y0, int x1, int y1, bool weighted = false) {
  base::PixelList list{"box", {}, {}};
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      list.pixels.push_back(static_cast<std::uint32_t>(y * kSwapWidth + x));
      if (weighted) list.weights.push_back(0.25f + 0.25f * static_cast<float>((x + y) % 4));
    }
  return list;
}

// Two pictures as displayed and as linear light.
struct SwapPictures {
  base::Image linear[2] = {test::makeHdrImage(kSwapWidth, kSwapHeight, 1, 8),
                           test::makeHdrImage(kSwapWidth, kSwapHeight, 3, 8)};
  base::Image8 shown[2] = {toBytes(test::makeImage(test::Kind::smooth, kSwapWidth, kSwapHeight, 5)),
                           toBytes(test::makeImage(test::Kind::noise8, kSwapWidth, kSwapHeight, 6))};

  Swap swap(const base::PixelList& list) const { return {&list, gather(shown[1], list), gather(linear[1], list), {}}; }
  SwapReference reference() const { return {shown[0], &linear[0], {}}; }
};

std::vector<std::string> allMetrics() {
  std::vector<std::string> names;
  for (const Metric& metric : metricRegistry()) names.push_back(metric.name);
  return names;
}

TEST(MeasureSwaps, EveryMetricIsThatOfThePictureWithTheOneMaterialSwapped) {
  const SwapPictures pictures;
  const base::PixelList lists[] = {box(20, 30, 90, 110, true), box(100, 5, 103, 190),
                                   box(0, 0, kSwapWidth, kSwapHeight)};
  std::vector<Swap> swaps;
  for (const base::PixelList& list : lists) swaps.push_back(pictures.swap(list));
  const MeasureRequest request{.metrics = allMetrics(), .statistics = {"flip.fraction_over(0.1)"}};
  const SwapMeasurement found = measureSwaps(pictures.reference(), swaps, request);
  for (std::size_t i = 0; i < swaps.size(); ++i) {
    const base::Image8 shown = swapPixels(pictures.shown[0], pictures.shown[1], lists[i]);
    const base::Image linear = swapPixels(pictures.linear[0], pictures.linear[1], lists[i]);
    const Figures whole =
        measureRegions({pictures.shown[0], shown, &pictures.linear[0], &linear, {}}, {lists[i]}, request).regions[0];
    const Figures& swap = found.figures[i];
    EXPECT_EQ(swap.pixels, whole.pixels);
    EXPECT_NEAR(swap.referenceLuma, whole.referenceLuma, 1e-9);
    EXPECT_NEAR(swap.testLuma, whole.testLuma, 1e-9);
    EXPECT_NEAR(swap.referenceLuminance, whole.referenceLuminance, 1e-9 * whole.referenceLuminance);
    EXPECT_NEAR(swap.testLuminance, whole.testLuminance, 1e-9 * whole.testLuminance);
    ASSERT_EQ(swap.values.size(), whole.values.size());
    for (std::size_t k = 0; k < swap.values.size(); ++k) {
      EXPECT_EQ(swap.values[k].name, whole.values[k].name);
      EXPECT_NEAR(swap.values[k].value, whole.values[k].value, 1e-6 * std::max(1., std::abs(whole.values[k].value)))
          << swap.values[k].name << " of list " << i;
    }
  }
}

TEST(MeasureSwaps, AMaterialThatIsEqualHasNoErrorBesideOneThatDiffers) {
  const SwapPictures pictures;
  const base::PixelList equal = box(40, 40, 80, 80), differs = box(80, 40, 120, 80);
  const std::vector<Swap> swaps = {{&equal, gather(pictures.shown[0], equal), gather(pictures.linear[0], equal), {}},
                                   pictures.swap(differs)};
  const SwapMeasurement found = measureSwaps(pictures.reference(), swaps, {.metrics = allMetrics()});
  EXPECT_EQ(found.figures[0].find("flip.max"), 0);
  EXPECT_EQ(found.figures[0].find("hdrflip.max"), 0);
  EXPECT_EQ(found.figures[0].find("ssim.min"), 1);
  EXPECT_EQ(found.figures[0].find("rmse"), 0);
  EXPECT_EQ(found.figures[0].find("bias.ev"), 0);
  EXPECT_GT(found.figures[1].find("flip.mean").value(), 0.05);
}

TEST(MeasureSwaps, OneThatCoversEverythingHasTheWholeImagesFigures) {
  const SwapPictures pictures;
  const base::PixelList all = wholeImage(kSwapWidth, kSwapHeight);
  const Swap swap = pictures.swap(all);
  const MeasureRequest request{.metrics = allMetrics()};
  const Figures one = measureSwaps(pictures.reference(), {&swap, 1}, request).figures[0];
  const Figures whole =
      measureRegions({pictures.shown[0], pictures.shown[1], &pictures.linear[0], &pictures.linear[1], {}}, {all},
                     request)
          .regions[0];
  for (std::size_t k = 0; k < whole.values.size(); ++k)
    EXPECT_NEAR(one.values[k].value, whole.values[k].value, 1e-9 * std::max(1., std::abs(whole.values[k].value)))
        << whole.values[k].name;
  EXPECT_EQ(one.find("flip.max"), whole.find("flip.max"));
}

TEST(MeasureSwaps, PixelsThatAreNotFiniteCountAsTheWorstAndAreCounted) {
  SwapPictures pictures;
  const base::PixelList list = box(10, 10, 20, 20), other = box(30, 10, 40, 20);
  Swap swap = pictures.swap(list);
  swap.nonFinite = {3};
  const std::vector<std::uint32_t> broken = {10 * kSwapWidth + 12, 150 * kSwapWidth}; // in the list, and in neither
  SwapReference reference = pictures.reference();
  reference.nonFinite = broken;
  const std::vector<Swap> swaps = {swap, pictures.swap(other)};
  const SwapMeasurement found = measureSwaps(
      reference, swaps, {.metrics = {"flip", "maxabs"}, .statistics = {}, .options = {}, .keepMaps = {"flip"}});
  EXPECT_EQ(found.figures[0].nonFinite, 2u);
  EXPECT_EQ(found.figures[1].nonFinite, 0u);
  EXPECT_EQ(found.figures[0].find("flip.max"), 1);
  ASSERT_EQ(found.flip.size(), 2u);
  EXPECT_EQ(found.flip[0][3], 1);
  EXPECT_EQ(found.flip[0][2], 1);
  EXPECT_LT(found.figures[1].find("flip.max").value(), 1);
}

TEST(MeasureSwaps, ClippedPixelsAreCountedWhereBothPicturesShowTheSameEnd) {
  SwapPictures pictures;
  std::ranges::fill(pictures.shown[0].pixels, 255);
  const base::PixelList list = box(0, 0, 40, 10);
  Swap swap = pictures.swap(list);
  std::ranges::fill(swap.displayed.pixels, 255);
  for (std::size_t i = 0; i < 100; ++i)
    std::fill_n(&swap.displayed.pixels[3 * i], 3, 0); // black where the other is white
  swap.displayed.pixels[3 * 200] = 254;               // almost
  const Figures found = measureSwaps(pictures.reference(), {&swap, 1}, {.metrics = {"flip"}}).figures[0];
  EXPECT_EQ(found.clippedBlack, 0);
  EXPECT_NEAR(found.clippedWhite, 299. / 400, 1e-12);
  EXPECT_NEAR(found.clipped(), 299. / 400, 1e-12);
}

TEST(MeasureSwaps, AMaterialWithoutPixelsHasNoFigures) {
  const SwapPictures pictures;
  const base::PixelList none{"none", {}, {}}, weightless{"weightless", {7}, {0.f}};
  const std::vector<Swap> swaps = {{&none, {}, {}, {}}, pictures.swap(weightless)};
  for (const Figures& figures : measureSwaps(pictures.reference(), swaps, {.metrics = allMetrics()}).figures) {
    EXPECT_EQ(figures.pixels, 0u);
    EXPECT_TRUE(figures.values.empty());
  }
}

TEST(MeasureSwaps, RefusesListsAndMetricsThatDoNotFit) {
  const SwapPictures pictures;
  const base::PixelList beyond{"beyond", {kSwapWidth * kSwapHeight}, {}}, list = box(0, 0, 2, 2);
  Swap swap = pictures.swap(list);
  EXPECT_EQ(test::codeOf([&] {
              measureSwaps(pictures.reference(), {&swap, 1}, {.metrics = {"nonsense"}});
            }),
            base::ExitCode::usage);
  SwapReference displayed{pictures.shown[0], nullptr, {}};
  EXPECT_EQ(test::codeOf([&] {
              measureSwaps(displayed, {&swap, 1}, {.metrics = {"hdrflip"}});
            }),
            base::ExitCode::notComparable);
  swap.list = &beyond;
  EXPECT_EQ(test::codeOf([&] {
              measureSwaps(pictures.reference(), {&swap, 1}, {.metrics = {"flip"}});
            }),
            base::ExitCode::failed);
}

} // namespace
} // namespace parity::compare
