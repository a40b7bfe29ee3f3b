// Image files there and back: values, channels and bit depths.
#include "base/image/image_io.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "base/file.h"
#include "expect_error.h"
#include "png_bytes.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

Image makeNoise(int width, int height, int channels, float low, float high) {
  Image image(width, height, channels);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(low, high);
  for (float& v : image.pixels) v = value(random);
  return image;
}

Image8 makeNoise8(int width, int height, int channels) {
  Image8 image(width, height, channels);
  std::mt19937 random(3);
  for (auto& v : image.pixels) v = static_cast<std::uint8_t>(random());
  return image;
}

// The channel list of an OpenEXR header (Technical Introduction to OpenEXR, "File layout"): name\0, then 16 bytes that
// begin with the type (1 half, 2 float).
std::vector<std::pair<std::string, int>> readExrChannels(const std::filesystem::path& file) {
  const std::string bytes = readText(file);
  const std::string attribute("channels\0chlist\0", 16);
  std::size_t at = bytes.find(attribute);
  if (at == std::string::npos) return {};
  at += attribute.size() + 4;
  std::vector<std::pair<std::string, int>> channels;
  while (bytes.at(at) != 0) {
    const std::string name = bytes.c_str() + at;
    at += name.size() + 1;
    channels.emplace_back(name, bytes.at(at));
    at += 16;
  }
  return channels;
}

TEST(Png, Keeps8BitValuesWithAnyNumberOfChannels) {
  const TempFolder folder;
  for (const int channels : {1, 2, 3, 4}) {
    const Image8 image = makeNoise8(37, 21, channels);
    writeImage8(folder / "a.png", image);
    EXPECT_EQ(readImage8(folder / "a.png", channels), image) << channels;
    EXPECT_EQ(decodeImage8(readFile(folder / "a.png"), "embedded", channels), image) << channels;
    EXPECT_TRUE(isIntegerImage(folder / "a.png"));
  }
}

TEST(Png, RoundsAndClampsFloats) {
  const TempFolder folder;
  Image image(7, 1, 1);
  image.pixels = {-1, 0, 0.5f / 255 - 1e-4f, 0.5f / 255 + 1e-4f, 1, 7, std::numeric_limits<float>::quiet_NaN()};
  writeImage(folder / "a.PNG", image); // in any case of letters
  EXPECT_EQ(readImage8(folder / "a.PNG", 1).pixels, (std::vector<std::uint8_t>{0, 0, 0, 1, 255, 255, 0}));
}

TEST(Png, ReadsStoredOverMaximumExactly) {
  const TempFolder folder;
  Image8 image(256, 1, 1);
  for (int i = 0; i < 256; ++i) image.pixels[i] = static_cast<std::uint8_t>(i);
  writeImage8(folder / "a.png", image);
  const Image read = readImage(folder / "a.png");
  for (int i = 0; i < 256; ++i) EXPECT_EQ(read.pixels[i], static_cast<float>(i) / 255.0f) << i;
}

TEST(Png, DoesNotMultiplyAlphaIntoTheColour) {
  const TempFolder folder;
  Image8 image(4, 1, 4);
  image.pixels = {200, 100, 50, 0, 200, 100, 50, 1, 200, 100, 50, 128, 200, 100, 50, 255};
  writeImage8(folder / "ours.png", image);
  EXPECT_EQ(readImage8(folder / "ours.png"), image);
  writeBytes(folder / "theirs.png", makePng({.width = 4, .height = 1, .colorType = 6}, image.pixels));
  EXPECT_EQ(readImage8(folder / "theirs.png"), image);
  EXPECT_EQ(decodeImage8(readFile(folder / "theirs.png"), "embedded"), image);
  EXPECT_EQ(readImage(folder / "theirs.png").at(0, 0)[0], 200 / 255.0f);
}

TEST(Png, ReadsThe16BitKind) {
  const TempFolder folder;
  // 128 is the last that rounds down to 0 (128/257 < 0.5), 129 the first that rounds up.
  const std::vector<std::uint16_t> stored = {0, 128, 129, 32767, 65406, 65407, 65535};
  std::vector<std::uint8_t> samples;
  for (const std::uint16_t v : stored) samples.insert(samples.end(), {std::uint8_t(v >> 8), std::uint8_t(v & 255)});
  writeBytes(folder / "a.png", makePng({.width = 7, .height = 1, .bitDepth = 16, .colorType = 0}, samples));
  EXPECT_TRUE(isIntegerImage(folder / "a.png"));
  const Image exact = readImage(folder / "a.png");
  for (std::size_t i = 0; i < stored.size(); ++i) EXPECT_EQ(exact.pixels[i], stored[i] / 65535.0f);
  EXPECT_EQ(readImage8(folder / "a.png", 1).pixels, (std::vector<std::uint8_t>{0, 0, 1, 127, 254, 255, 255}));
}

TEST(Png, ReadsPalettes) {
  const TempFolder folder;
  const std::string palette = makePngChunk("PLTE", std::string("\x01\x02\x03\xff\x80\x40", 6));
  writeBytes(folder / "a.png",
             makePng({.width = 2, .height = 1, .colorType = 3}, std::vector<std::uint8_t>{1, 0}, palette));
  EXPECT_EQ(readImage8(folder / "a.png", 3).pixels, (std::vector<std::uint8_t>{255, 128, 64, 1, 2, 3}));
}

TEST(Png, IgnoresTheGammaThatAFileDeclares) {
  const TempFolder folder;
  const std::string gamma = makePngChunk("gAMA", std::string("\x00\x01\x86\xa0", 4)); // 1.0
  writeBytes(folder / "a.png",
             makePng({.width = 1, .height = 1, .colorType = 6}, std::vector<std::uint8_t>{9, 99, 199, 77}, gamma));
  EXPECT_EQ(readImage8(folder / "a.png").pixels, (std::vector<std::uint8_t>{9, 99, 199, 77}));
}

TEST(ReadImage8, ConvertsBetweenNumbersOfChannels) {
  const TempFolder folder;
  using Values = std::vector<std::uint8_t>;
  const std::vector<Values> stored = {{10}, {10, 40}, {10, 20, 30}, {10, 20, 30, 40}};
  const std::vector<std::vector<Values>> expected = {
      {{10}, {10, 255}, {10, 10, 10}, {10, 10, 10, 255}},
      {{10}, {10, 40}, {10, 10, 10}, {10, 10, 10, 40}},
      {{10}, {10, 255}, {10, 20, 30}, {10, 20, 30, 255}},
      {{10}, {10, 40}, {10, 20, 30}, {10, 20, 30, 40}},
  };
  for (std::size_t from = 0; from < 4; ++from) {
    Image8 image(1, 1, static_cast<int>(from) + 1);
    image.pixels = stored[from];
    writeImage8(folder / "a.png", image);
    for (std::size_t to = 0; to < 4; ++to)
      EXPECT_EQ(readImage8(folder / "a.png", static_cast<int>(to) + 1).pixels, expected[from][to])
          << from + 1 << " to " << to + 1;
  }
  EXPECT_THROW(readImage8(folder / "a.png", 0), std::invalid_argument);
  EXPECT_THROW(readImage8(folder / "a.png", 5), std::invalid_argument);
}

TEST(Exr, KeepsFloatsBitForBit) {
  const TempFolder folder;
  for (const int channels : {1, 3, 4}) {
    Image image = makeNoise(33, 65, channels, -1000, 1000);
    image.pixels[0] = -0.0f;
    image.pixels[1] = std::numeric_limits<float>::infinity();
    image.pixels[2] = std::numeric_limits<float>::denorm_min();
    writeImage(folder / "a.exr", image);
    EXPECT_EQ(readImage(folder / "a.exr"), image) << channels;
    EXPECT_FALSE(isIntegerImage(folder / "a.exr"));
  }
}

TEST(Exr, KeepsNaN) {
  const TempFolder folder;
  writeImage(folder / "a.exr", Image(1, 1, 3, std::numeric_limits<float>::quiet_NaN()));
  for (const float v : readImage(folder / "a.exr").pixels) EXPECT_TRUE(std::isnan(v));
}

TEST(Exr, RoundsToHalfOnRequest) {
  const TempFolder folder;
  const Image image = makeNoise(40, 40, 3, -100, 100);
  WriteOptions options;
  options.half = true;
  writeImage(folder / "a.exr", image, options);
  EXPECT_EQ(readExrChannels(folder / "a.exr"),
            (std::vector<std::pair<std::string, int>>{{"B", 1}, {"G", 1}, {"R", 1}}));
  const Image read = readImage(folder / "a.exr");
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    ASSERT_NEAR(read.pixels[i], image.pixels[i], std::abs(image.pixels[i]) * 0x1p-11f + 0x1p-25f);
}

TEST(Exr, NamesItsChannels) {
  const TempFolder folder;
  WriteOptions options;
  Image image(2, 2, 6);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i);
  options.channelNames = {"R", "G", "B", "specular.R", "specular.G", "specular.B"};
  writeImage(folder / "a.exr", image, options);
  EXPECT_EQ(readExrChannels(folder / "a.exr"),
            (std::vector<std::pair<std::string, int>>{
                {"B", 2}, {"G", 2}, {"R", 2}, {"specular.B", 2}, {"specular.G", 2}, {"specular.R", 2}}));
  EXPECT_EQ(readImage(folder / "a.exr"), image);
}

TEST(Exr, HoldsManyChannels) {
  const TempFolder folder;
  WriteOptions options;
  for (int i = 10; i < 60; ++i) options.channelNames.push_back("term" + std::to_string(i));
  const Image image = makeNoise(5, 4, 50, 0, 1);
  writeImage(folder / "a.exr", image, options);
  EXPECT_EQ(readImage(folder / "a.exr"), image);
}

TEST(Hdr, KeepsAnEighthBitOfMantissa) {
  const TempFolder folder;
  for (const int width : {1, 7, 64}) { // the narrow ones are stored without runs
    SCOPED_TRACE(width);
    const Image image = makeNoise(width, 20, 3, 0, 500);
    writeImage(folder / "a.hdr", image);
    EXPECT_FALSE(isIntegerImage(folder / "a.hdr"));
    const Image read = readImage(folder / "a.hdr");
    ASSERT_EQ(read.pixels.size(), image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
      // One exponent for all three: the step is 1/128 of the greatest at most.
      const float step = *std::max_element(&image.pixels[i], &image.pixels[i] + 3) / 128;
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(read.pixels[i + c], image.pixels[i + c], step);
    }
  }
}

TEST(Hdr, RefusesWhatItCannotHold) {
  const TempFolder folder;
  for (const float v : {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    expectError([&] { writeImage(folder / "a.hdr", Image(2, 2, 3, v)); }, "a.hdr", "negative or non-finite");
  expectError([&] { writeImage(folder / "a.hdr", Image(2, 2, 3, 0x1p127f)); }, "a.hdr", "1.7e38 and more");
  expectError([&] { writeImage(folder / "a.hdr", Image(2, 2, 1)); }, "a.hdr", "cannot hold 1 channels");
  EXPECT_TRUE(folder.entries().empty());
  writeImage(folder / "a.hdr", Image(2, 2, 3, 0x1p126f)); // the largest power of two that there is
  EXPECT_EQ(readImage(folder / "a.hdr"), Image(2, 2, 3, 0x1p126f));
}

TEST(Jpeg, IsRead) {
  // 16x16, made by OpenImageIO from a four-corner gradient whose top left is (0.2, 0.4, 0.6), at quality 90 with
  // halved chroma.
  const std::filesystem::path file = std::filesystem::path(PARITY_SOURCE_DIR) / "tests/base/data/ramp16.jpg";
  const Image8 image = readImage8(file, 3);
  EXPECT_EQ(image.width, 16);
  EXPECT_EQ(image.height, 16);
  EXPECT_NEAR(image.pixels[0], 51, 12);
  EXPECT_NEAR(image.pixels[1], 102, 12);
  EXPECT_NEAR(image.pixels[2], 153, 12);
  EXPECT_EQ(decodeImage8(readFile(file), "embedded", 3), image);
  EXPECT_TRUE(isIntegerImage(file));
}

TEST(ReadImage, GoesByTheContentWhereTheExtensionLies) {
  const TempFolder folder;
  const Image8 image = makeNoise8(9, 9, 3);
  writeImage8(folder / "a.png", image);
  std::filesystem::rename(folder / "a.png", folder / "a.jpg");
  EXPECT_EQ(readImage8(folder / "a.jpg", 3), image);
}

// Whether a file holds a date (2024:01:31) or names the program that made it: it would differ tomorrow, or elsewhere.
bool saysWhenOrByWhat(const std::string& bytes) {
  const std::string pattern = "dddd:dd:dd";
  const auto fits = [](char c, char p) { return p == 'd' ? c >= '0' && c <= '9' : c == p; };
  return std::search(bytes.begin(), bytes.end(), pattern.begin(), pattern.end(), fits) != bytes.end() ||
         bytes.find("OpenImageIO") != std::string::npos || bytes.find("oftware") != std::string::npos;
}

TEST(WriteImage, GivesTheSameBytesForTheSameImage) {
  const TempFolder folder;
  const Image image = makeNoise(50, 40, 3, 0, 1);
  for (const std::string name : {"a.png", "a.exr", "a.hdr", "a.pfm"}) {
    writeImage(folder / name, image);
    const std::string first = readText(folder / name);
    writeImage(folder / ("other-" + name), image);
    EXPECT_EQ(readText(folder / ("other-" + name)), first) << name;
    EXPECT_FALSE(saysWhenOrByWhat(first)) << name;
  }
}

TEST(ReadImageFile, SaysHowPixelsAreStoredAndWhatAlphaMeans) {
  const TempFolder folder;
  writeImage8(folder / "a.png", makeNoise8(5, 4, 4));
  writeImage(folder / "a.exr", makeNoise(5, 4, 4, 0, 1));
  writeImage(folder / "grey.pfm", makeNoise(5, 4, 1, 0, 1));
  const ImageFile png = readImageFile(folder / "a.png"), exr = readImageFile(folder / "a.exr"),
                  pfm = readImageFile(folder / "grey.pfm");
  EXPECT_EQ(png.pixels, readImage(folder / "a.png"));
  EXPECT_TRUE(png.info.integer);
  EXPECT_EQ(png.info.bits, 8);
  EXPECT_EQ(png.info.alphaChannel, 3);
  EXPECT_FALSE(png.info.alphaAssociated) << "PNG leaves alpha out of the colour";
  EXPECT_FALSE(exr.info.integer);
  EXPECT_EQ(exr.info.bits, 32);
  EXPECT_EQ(exr.info.channelNames, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_TRUE(exr.info.alphaAssociated) << "OpenEXR multiplies it in";
  EXPECT_FALSE(exr.info.chromaticities);
  EXPECT_EQ(pfm.info.alphaChannel, -1);
  EXPECT_EQ(pfm.pixels.channels, 1);
}

TEST(ReadIntegers, AreWhatTheFileStores) {
  const TempFolder folder;
  const Image8 image = makeNoise8(9, 7, 3);
  writeImage8(folder / "a.png", image);
  const BasicImage<std::uint32_t> integers = readIntegers(folder / "a.png");
  ASSERT_EQ(integers.pixels.size(), image.pixels.size());
  EXPECT_TRUE(std::equal(image.pixels.begin(), image.pixels.end(), integers.pixels.begin()));
  for (const char* name : {"a.exr", "a.pfm"}) {
    writeImage(folder / name, makeNoise(5, 4, 3, 0, 1));
    EXPECT_THROW(readIntegers(folder / name), Error) << name;
  }
}

} // namespace
} // namespace parity::base
