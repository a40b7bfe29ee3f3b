// What this program writes as OpenEXR is what its own reader and the image library read.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/image/exr_write.h"
#include "base/parallel.h"
#include "expect_error.h"
#include "reader_match.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

// Floats of any bits but those of NaN: what is compared is values.
Image makeNoise(int width, int height, int channels, unsigned seed) {
  std::mt19937 random(seed);
  Image image(width, height, channels);
  for (float& v : image.pixels) {
    v = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isnan(v)) v = 0.1f;
  }
  return image;
}

// To the nearest half, ties to even (IEEE 754): by the spacing of halves around the value.
float roundedToHalf(float v) {
  const double magnitude = std::fabs(static_cast<double>(v));
  const double spacing = magnitude < 0x1p-14 ? 0x1p-24 : std::ldexp(1, std::ilogb(magnitude) - 10);
  const double rounded = std::isinf(magnitude) ? magnitude : std::nearbyint(magnitude / spacing) * spacing;
  return std::copysign(static_cast<float>(rounded > 65504 ? std::numeric_limits<double>::infinity() : rounded), v);
}

// Noise, which ZIP makes no smaller, and a flat picture; one line, a whole chunk of 16, and a last one that is shorter.
TEST(ExrEncoder, FloatsComeBackAsTheyAre) {
  const TempFolder folder;
  for (const int channels : {1, 2, 3, 4, 7})
    for (const auto& [width, height] : std::vector<std::pair<int, int>>{{1, 1}, {33, 16}, {40, 50}})
      for (const bool isFlat : {false, true}) {
        SCOPED_TRACE(std::to_string(channels) + " channels, height " + std::to_string(height));
        const Image image = isFlat ? Image(width, height, channels, .3f) : makeNoise(width, height, channels, 7);
        const auto file = folder / "a.exr";
        writeImage(file, image);
        EXPECT_EQ(readImage(file), image);
        EXPECT_TRUE(expectAsLibrary(file, readFile(file)));
      }
}

TEST(ExrEncoder, HalvesAreTheNearest) {
  const TempFolder folder;
  Image image = makeNoise(64, 48, 3, 11);
  std::mt19937 random(3);
  for (std::size_t i = 0; i < image.pixels.size(); i += 2) // within the range of halves, subnormal ones included
    image.pixels[i] = std::ldexp(static_cast<float>(random() % 8192) - 4096, static_cast<int>(random() % 30) - 26);
  // Between two halves, over the largest, and where it turns infinite.
  const float edges[] = {1 + 0x1p-11f, 1 + 3 * 0x1p-11f, 0x1p-25f, 3 * 0x1p-25f, 65504, 65519, 65520, -1e9f, -0.f};
  std::copy(std::begin(edges), std::end(edges), image.pixels.begin());
  Image expected = image;
  for (float& v : expected.pixels) v = roundedToHalf(v);
  const auto file = folder / "a.exr";
  writeImage(file, image, {.channelNames = {}, .half = true});
  EXPECT_EQ(readImage(file), expected);
  EXPECT_EQ(readImageFile(file).info.bits, 16);
  EXPECT_TRUE(expectAsLibrary(file, readFile(file)));
}

// Values are compared above, in which -0 is 0 and NaN is nothing.
TEST(ExrEncoder, KeepsTheSignOfZeroAndNan) {
  const TempFolder folder;
  const auto file = folder / "a.exr";
  const auto bitsOf = [&](const Image& image, bool half) {
    writeImage(file, image, {.channelNames = {}, .half = half});
    std::vector<std::uint32_t> bits;
    for (const float v : readImage(file).pixels) bits.push_back(std::bit_cast<std::uint32_t>(v));
    return bits;
  };
  const std::vector<std::uint32_t> written{0x80000000u, 0x7fc00000u, 0xffc00000u,
                                           0x7f802000u, 0x7f800001u, 0xff800fffu};
  Image image(6, 1, 1);
  for (std::size_t i = 0; i < written.size(); ++i) image.pixels[i] = std::bit_cast<float>(written[i]);
  EXPECT_EQ(bitsOf(image, false), written);
  // A payload that a half has no room for becomes the smallest there is.
  EXPECT_EQ(bitsOf(image, true),
            (std::vector<std::uint32_t>{0x80000000u, 0x7fc00000u, 0xffc00000u, 0x7f802000u, 0x7f802000u, 0xff802000u}));
}

// The file has its channels sorted; the picture's order comes from the names. A name of 40 letters needs a flag.
TEST(ExrEncoder, ChannelsGoByTheirNames) {
  const TempFolder folder;
  const Image image = makeNoise(5, 20, 4, 2);
  const auto file = folder / "a.exr";
  const std::string longName(40, 'n');
  writeImage(file, image, {.channelNames = {"R", "G", "B", longName}});
  EXPECT_EQ(readImage(file), image);
  EXPECT_EQ(readImageFile(file).info.channelNames, (std::vector<std::string>{"R", "G", "B", longName}));
  EXPECT_TRUE(expectAsLibrary(file, readFile(file)));
  writeImage(file, image, {.channelNames = {"B", "A", "R", "G"}}); // read as R, G, B, A
  const Image read = readImage(file);
  for (std::size_t p = 0; p < image.pixelCount(); ++p) {
    const float* const written = image.pixels.data() + 4 * p;
    const std::vector<float> sorted{written[2], written[3], written[0], written[1]};
    EXPECT_TRUE(std::equal(sorted.begin(), sorted.end(), read.pixels.begin() + static_cast<std::ptrdiff_t>(4 * p)));
  }
  EXPECT_TRUE(expectAsLibrary(file, readFile(file)));
}

TEST(ExrEncoder, BytesDoNotDependOnTheThreads) {
  const Image image = makeNoise(100, 200, 3, 5);
  const std::vector<std::byte> all = encodeExr(image, {}, "a.exr");
  const ThreadLimit one(1);
  EXPECT_EQ(encodeExr(image, {}, "a.exr"), all);
}

// A flat picture is one difference over and over; a picture like a render shrinks, too.
TEST(ExrEncoder, Compresses) {
  EXPECT_LT(encodeExr(Image(256, 256, 3, .4f), {}, "a.exr").size(), 12000u);
  Image ramp(256, 256, 3);
  for (std::size_t i = 0; i < ramp.pixels.size(); ++i) ramp.pixels[i] = static_cast<float>(i / 3 % 256) / 256;
  EXPECT_LT(encodeExr(ramp, {}, "a.exr").size(), ramp.pixels.size() * sizeof(float) / 4);
}

TEST(ExrEncoder, WhatTheFormatRefusesIsAnError) {
  expectError([] { encodeExr(Image(2, 2, 1), {.channelNames = {std::string(300, 'n')}}, "a.exr"); }, "a.exr",
              "cannot be written");
}

} // namespace
} // namespace parity::base
