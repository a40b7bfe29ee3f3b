// PNG files that this program writes: any reader finds the same pixels, and the same pixels give the same bytes.
#include "base/image/png_write.h"

#include <random>
#include <utility>

#include <gtest/gtest.h>
#include <png.h>

#include "base/image/image_io.h"
#include "base/image/png_check.h"
#include "base/parallel.h"
#include "reader_match.h"

namespace parity::base {
namespace {

// By libpng's simplified interface.
Image8 readByLibpng(const std::vector<std::byte>& file, int channels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, file.data(), file.size())) return {};
  constexpr png_uint_32 kFormats[] = {PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB, PNG_FORMAT_RGBA};
  EXPECT_EQ(image.format, kFormats[channels - 1]);
  Image8 pixels(static_cast<int>(image.width), static_cast<int>(image.height), channels);
  return png_image_finish_read(&image, nullptr, pixels.pixels.data(), 0, nullptr) ? pixels : Image8{};
}

// A picture with smooth, flat and noisy parts.
Image8 makePictureOf(int width, int height, int channels) {
  Image8 image(width, height, channels);
  std::mt19937 random(3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c)
        image.at(x, y)[c] = static_cast<std::uint8_t>(x < width / 3    ? 17
                                                      : y < height / 2 ? x + 2 * y + 40 * c
                                                                       : static_cast<int>(random() % 256));
  return image;
}

TEST(PngWrite, AnyReaderFindsTheSamePixels) {
  for (const int channels : {1, 2, 3, 4})
    for (const int level : {1, 2, 6, 12})
      for (const auto& [width, height] : std::vector<std::pair<int, int>>{{1, 1}, {1, 50}, {7, 3}, {333, 200}}) {
        SCOPED_TRACE(std::to_string(channels) + " channels, level " + std::to_string(level) + ", " +
                     std::to_string(width));
        const Image8 image = makePictureOf(width, height, channels);
        const std::vector<std::byte> file = encodePng(image, level);
        checkPng(file, "a.png");
        EXPECT_EQ(readByLibpng(file, channels), image);
        EXPECT_EQ(decodeImage8(file, "a.png", channels), image);
        expectAsLibrary("a.png", file);
      }
}

TEST(PngWrite, TheSamePictureGivesTheSameBytesOnAnyNumberOfThreads) {
  const Image8 image = makePictureOf(500, 400, 3);
  const std::vector<std::byte> file = encodePng(image, 1);
  const ThreadLimit one(1);
  EXPECT_EQ(encodePng(image, 1), file);
}

TEST(PngWrite, IsSmallerThanOfZlibOnSmoothPictures) {
  Image8 image(256, 256, 3);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<std::uint8_t>((x * x + y * y) / (300 + 50 * c));
  const std::size_t bound = image.pixels.size() / 6; // one row filter and zlib's level 1: a fifth
  EXPECT_LT(encodePng(image, 1).size(), bound);
  EXPECT_LT(encodePng(Image8(1024, 1024, 3, 7), 1).size(), 10000u) << "a flat picture";
}

} // namespace
} // namespace parity::base
