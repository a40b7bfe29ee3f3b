// PNG files that this program writes: any reader finds the same pixels, and the same pixels give the same bytes.
#include "base/image/png_write.h"

#include <algorithm>
#include <random>
#include <utility>

#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include "base/image/fast_deflate.h"
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
Image8 makePicture(int width, int height, int channels) {
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
    for (const int level : {0, 1, 2, 6, 9})
      for (const auto& [width, height] : std::vector<std::pair<int, int>>{{1, 1}, {1, 50}, {7, 3}, {333, 200}}) {
        SCOPED_TRACE(std::to_string(channels) + " channels, level " + std::to_string(level) + ", " +
                     std::to_string(width));
        const Image8 image = makePicture(width, height, channels);
        const std::vector<std::byte> file = encodePng(image, level);
        checkPng(file, "a.png");
        EXPECT_EQ(readByLibpng(file, channels), image);
        EXPECT_EQ(decodeImage8(file, "a.png", channels), image);
        expectAsLibrary("a.png", file);
      }
}

TEST(PngWrite, TheSamePictureGivesTheSameBytesOnAnyNumberOfThreads) {
  const Image8 image = makePicture(500, 400, 3);
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

std::vector<std::uint8_t> inflateByZlib(const std::vector<std::byte>& stream, std::size_t size) {
  std::vector<std::uint8_t> bytes(size + 1);
  uLongf found = bytes.size();
  const int result = uncompress(bytes.data(), &found, reinterpret_cast<const Bytef*>(stream.data()), stream.size());
  EXPECT_EQ(result, Z_OK);
  bytes.resize(found);
  return bytes;
}

TEST(FastDeflate, GivesBackWhateverItIsGiven) {
  std::mt19937 random(9);
  const auto check = [](const std::vector<std::uint8_t>& bytes) {
    std::vector<std::byte> stream;
    appendFastZlib(stream, bytes);
    EXPECT_EQ(inflateByZlib(stream, bytes.size()), bytes) << bytes.size();
    EXPECT_LE(stream.size(), bytes.size() * 17 / 16 + 400) << "nothing grows by much";
  };
  for (const std::size_t size : {0, 1, 2, 7, 8, 9, 11, 12, 258, 259, 266, 267, 65535, 65536, 65537, 65545, 200000}) {
    check(std::vector<std::uint8_t>(size, 0));
    check(std::vector<std::uint8_t>(size, 200));
    std::vector<std::uint8_t> bytes(size);
    for (const unsigned range : {2u, 3u, 7u, 64u, 256u}) {
      for (std::uint8_t& v : bytes) v = static_cast<std::uint8_t>(random() % range);
      check(bytes);
    }
    // Runs of every length, between literals.
    for (std::size_t i = 0; i < size;) {
      for (std::size_t run = random() % 700; run > 0 && i < size; --run) bytes[i++] = 0;
      for (std::size_t run = random() % 20; run > 0 && i < size; --run)
        bytes[i++] = static_cast<std::uint8_t>(random());
    }
    check(bytes);
  }
}

// Counts that grow as Fibonacci's numbers want codes longer than there may be.
TEST(FastDeflate, CutsCodesThatWouldBeTooLong) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t symbol = 1, count = 1, last = 1; symbol < 24; ++symbol) {
    bytes.insert(bytes.end(), count, static_cast<std::uint8_t>(symbol * 9));
    count += std::exchange(last, count);
  }
  std::shuffle(bytes.begin(), bytes.end(), std::mt19937(1));
  bytes.resize(std::min<std::size_t>(bytes.size(), 65536));
  std::vector<std::byte> stream;
  appendFastZlib(stream, bytes);
  EXPECT_EQ(inflateByZlib(stream, bytes.size()), bytes);
}

} // namespace
} // namespace parity::base
