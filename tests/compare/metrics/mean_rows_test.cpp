// Means that are added up without maps are those of the maps.
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "compare/metrics/mean_rows.h"
#include "compare/pooling/pooling.h"

namespace parity::compare {
namespace {

base::Image makeNoise(unsigned seed) {
  base::Image image(700, 300, 3);
  std::mt19937 random(seed);
  for (float& v : image.pixels) v = static_cast<float>(random() % 1000) / 900.f;
  return image;
}

TEST(MeanRows, AreTheMeansOfTheMapsToTheBit) {
  base::Image reference = makeNoise(1);
  const base::Image test = makeNoise(2);
  reference.at(5, 7)[1] = std::numeric_limits<float>::quiet_NaN();
  const MetricInput input({reference, test});
  base::PixelList all{"all", {}, {}}, some{"some", {}, {}};
  for (std::uint32_t pixel = 0; pixel < 700 * 300; ++pixel) {
    all.pixels.push_back(pixel);
    if (pixel % 7 == 3) continue;
    some.pixels.push_back(pixel);
    some.weights.push_back(static_cast<float>(pixel % 5) / 4);
  }
  const std::vector<RegionRuns> regions{runsOf(all, 700, 300), runsOf(some, 700, 300)};
  const std::vector<const MeanRows*> rows{biasOfMeans().rows, rmseOfMeans().rows};
  const auto means = meansOf(rows, input, regions);
  ASSERT_EQ(means.size(), regions.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    std::size_t k = 0;
    for (const MeanRows* each : rows)
      for (const base::Image& map : mapsOf(*each, input, {0, 0, 700, 300})) {
        ASSERT_LT(k, means[r].size());
        EXPECT_EQ(means[r][k++], meanOf(map, regions[r])) << "region " << r;
      }
    EXPECT_EQ(k, means[r].size());
  }
}

} // namespace
} // namespace parity::compare
