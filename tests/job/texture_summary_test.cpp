// What is counted of a texture, and its small picture.
#include <cmath>

#include <gtest/gtest.h>

#include "job/scene/texture_summary.h"

namespace parity::job {
namespace {

base::Image8 makeImage(int width, int height, auto&& at) {
  base::Image8 image(width, height, 4);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::array<std::uint8_t, 4> texel = at(x, y);
      std::copy(texel.begin(), texel.end(), image.at(x, y));
    }
  return image;
}

TextureSummary summaryOf(const base::Image8& image) {
  const base::Image8* images[] = {&image};
  return summarise(images).front();
}

TEST(TextureSummary, CountsEachTexelOfEachChannelOnce) {
  // An odd number, of more than one part of the work.
  const base::Image8 image = makeImage(701, 523, [](int x, int y) {
    return std::array<std::uint8_t, 4>{static_cast<std::uint8_t>(x == 0 ? 7 : 9), static_cast<std::uint8_t>(y == 3),
                                       200, static_cast<std::uint8_t>(x == 700 && y == 522 ? 255 : 4)};
  });
  const TextureSummary summary = summaryOf(image);
  EXPECT_EQ(summary.counts[0][7], 523u);
  EXPECT_EQ(summary.counts[0][9], 700u * 523u);
  EXPECT_EQ(summary.counts[1][1], 701u);
  EXPECT_EQ(summary.counts[2][200], 701u * 523u);
  EXPECT_EQ(summary.counts[3][255], 1u);
  EXPECT_EQ(summary.counts[3][4], 701u * 523u - 1);
  EXPECT_EQ(summary.counts[3][5], 0u);
}

TEST(TextureSummary, EachImageHasItsOwn) {
  const auto plain = [](std::uint8_t value) {
    return makeImage(3, 3, [value](int, int) { return std::array{value, value, value, value}; });
  };
  const base::Image8 first = plain(10), second = plain(20);
  const base::Image8* images[] = {&first, &second};
  const std::vector<TextureSummary> summaries = summarise(images);
  EXPECT_EQ(summaries[0].counts[2][10], 9u);
  EXPECT_EQ(summaries[1].counts[2][20], 9u);
  EXPECT_EQ(summaries[1].counts[2][10], 0u);
}

TEST(TextureSummary, RangesAreOfDataOrOfLight) {
  ValueCounts counts{};
  counts[51] = 3;
  counts[255] = 1;
  const ValueRange data = rangeOf(counts, false), light = rangeOf(counts, true);
  EXPECT_EQ(data.least, 0.2);
  EXPECT_EQ(data.most, 1);
  EXPECT_DOUBLE_EQ(data.mean, 0.4);
  const double dark = std::pow((0.2 + 0.055) / 1.055, 2.4);
  EXPECT_DOUBLE_EQ(light.least, dark);
  EXPECT_EQ(light.most, 1);
  EXPECT_DOUBLE_EQ(light.mean, (3 * dark + 1) / 4);
}

TEST(Thumbnail, KeepsASmallPictureAsItIs) {
  const base::Image8 image = makeImage(5, 3, [](int x, int y) {
    return std::array<std::uint8_t, 4>{static_cast<std::uint8_t>(50 * x), static_cast<std::uint8_t>(80 * y), 33, 44};
  });
  for (const bool isColor : {false, true}) {
    const base::Image8 rgb = makeThumbnail(image, "rgb", isColor);
    ASSERT_EQ(rgb.width, 5);
    ASSERT_EQ(rgb.height, 3);
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x)
        for (int c = 0; c < 3; ++c) EXPECT_EQ(rgb.at(x, y)[c], image.at(x, y)[c]) << isColor;
  }
  const base::Image8 alpha = makeThumbnail(image, "a", false);
  EXPECT_EQ(alpha.channels, 1);
  EXPECT_EQ(alpha.at(4, 2)[0], 44);
}

TEST(Thumbnail, AveragesLightOrData) {
  const base::Image8 stripes = makeImage(960, 480, [](int x, int) {
    const std::uint8_t value = x / 10 % 2 == 0 ? (x % 2 == 0 ? 0 : 255) : 255;
    return std::array<std::uint8_t, 4>{value, value, value, 255};
  });
  const base::Image8 color = makeThumbnail(stripes, "rgb", true), data = makeThumbnail(stripes, "rgb", false);
  ASSERT_EQ(color.width, kThumbnailSide);
  ASSERT_EQ(color.height, kThumbnailSide / 2);
  EXPECT_EQ(color.at(1, 0)[0], 255);
  EXPECT_EQ(data.at(1, 0)[0], 255);
  EXPECT_GT(color.at(0, 0)[0], data.at(0, 0)[0]) << "the mean of light is brighter than that of codes";
  EXPECT_GT(data.at(0, 0)[0], 60);
  EXPECT_LT(color.at(0, 0)[0], 240);
}

TEST(Thumbnail, OfALongStripKeepsAPixel) {
  const base::Image8 strip(4000, 2, 4, 100);
  const base::Image8 small = makeThumbnail(strip, "g", false);
  EXPECT_EQ(small.width, kThumbnailSide);
  EXPECT_EQ(small.height, 1);
  EXPECT_EQ(small.at(95, 0)[0], 100);
}

} // namespace
} // namespace parity::job
