// ETC2 there and back: blocks put together by hand from the specification's bit layout, and what a foreign encoder
// chose, mode by mode: it measured its own errors by its own decoder.
#include "base/image/etc2.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "base/image/texture_block.h"
#include "base/parallel.h"

namespace parity::base {
namespace {

using Block = std::array<std::uint8_t, 16>;

// An alpha block of one value, then these 64 bits of colour.
Block blockOf(std::uint64_t color, std::uint8_t alpha = 255) {
  Block block{alpha, 0};
  for (int i = 0; i < 8; ++i) block[static_cast<std::size_t>(8 + i)] = static_cast<std::uint8_t>(color >> (56 - 8 * i));
  return block;
}

std::array<int, 4> texel(const Image8& image, int x, int y) {
  const std::uint8_t* t = image.at(x, y);
  return {t[0], t[1], t[2], t[3]};
}
using Rgba = std::array<int, 4>;

// Bits by their place in the specification's tables: high, low, value.
struct Field {
  int low;
  std::uint64_t value;
};
std::uint64_t bitsOf(std::initializer_list<Field> fields) {
  std::uint64_t bits = 0;
  for (const Field& field : fields) bits |= field.value << field.low;
  return bits;
}
// The index of texel (x, y): its high bit at 16 + 4 x + y, its low bit at 4 x + y.
std::uint64_t indexAt(int x, int y, std::uint64_t index) {
  return (index >> 1) << (16 + 4 * x + y) | (index & 1) << (4 * x + y);
}

TEST(Etc2, DecodesIndividualHalvesSideBySide) {
  // R 1 and 15, G 2 and 0, B 3 and 8, in 4 bits; tables 0 (2, 8) and 7 (47, 183); not flipped.
  const std::uint64_t bits = bitsOf({{60, 1}, {56, 15}, {52, 2}, {48, 0}, {44, 3}, {40, 8}, {37, 0}, {34, 7}}) |
                             indexAt(0, 1, 1) | indexAt(1, 3, 2) | indexAt(2, 0, 3) | indexAt(3, 3, 1);
  const Image8 image = decodeEtc2(blockOf(bits, 77), 4, 4);
  EXPECT_EQ(texel(image, 0, 0), (Rgba{17 + 2, 34 + 2, 51 + 2, 77}));
  EXPECT_EQ(texel(image, 0, 1), (Rgba{17 + 8, 34 + 8, 51 + 8, 77}));
  EXPECT_EQ(texel(image, 1, 3), (Rgba{17 - 2, 34 - 2, 51 - 2, 77}));
  EXPECT_EQ(texel(image, 2, 0), (Rgba{255 - 183, 0, 0, 77})) << "clamped at 0";
  EXPECT_EQ(texel(image, 3, 3), (Rgba{255, 183, 255, 77})) << "clamped at 255";
}

TEST(Etc2, DecodesDifferencesOneAboveTheOther) {
  // 5 bits: R 10 and 10 - 1, G 20 and 20 + 3, B 31 and 31 - 4; tables 1 (5, 17) and 2 (9, 29); flipped.
  const std::uint64_t bits =
      bitsOf({{59, 10}, {56, 7}, {51, 20}, {48, 3}, {43, 31}, {40, 4}, {37, 1}, {34, 2}, {33, 1}, {32, 1}});
  const Image8 image = decodeEtc2(blockOf(bits), 4, 4);
  EXPECT_EQ(texel(image, 3, 1), (Rgba{82 + 5, 165 + 5, 255, 255}));     // 10: 01010|010, 20: 10100|101
  EXPECT_EQ(texel(image, 0, 2), (Rgba{74 + 9, 189 + 9, 222 + 9, 255})); // 9: 01001|010, 23: 10111|101, 27: 11011|110
}

TEST(Etc2, DecodesModeT) {
  // R 31 + 3 overflows: the first colour's R is bits 60-59 and 57-56, here 3 and 3 with bits 63-61 set and 58 clear.
  const std::uint64_t bits = bitsOf({{61, 7},
                                     {59, 3},
                                     {58, 0},
                                     {56, 3},
                                     {52, 4},
                                     {48, 5},
                                     {44, 8},
                                     {40, 9},
                                     {36, 10},
                                     {34, 2},
                                     {33, 1},
                                     {32, 1}}) |
                             indexAt(0, 0, 0) | indexAt(1, 0, 1) | indexAt(2, 0, 2) | indexAt(3, 0, 3);
  const Image8 image = decodeEtc2(blockOf(bits), 4, 4);
  EXPECT_EQ(texel(image, 0, 0), (Rgba{255, 68, 85, 255}));
  EXPECT_EQ(texel(image, 1, 0), (Rgba{136 + 32, 153 + 32, 170 + 32, 255})) << "distance 5 of the table";
  EXPECT_EQ(texel(image, 2, 0), (Rgba{136, 153, 170, 255}));
  EXPECT_EQ(texel(image, 3, 0), (Rgba{136 - 32, 153 - 32, 170 - 32, 255}));
}

TEST(Etc2, DecodesModeH) {
  // R 4 bits at 59, G 3 at 56 and 1 at 52, B 1 at 51 and 3 at 47. Bits 63-59 and 58-56 must make no overflow of R (0
  // here), 55-51 and 50-48 one of G: G 31 (11111) + 1. R1 = 0111: bits 62-59; G1 = 001 and 1: 3; B1 = 1 and 010: 10.
  const std::uint64_t bits = bitsOf({{59, 7},
                                     {56, 1},
                                     {53, 7},
                                     {52, 1},
                                     {51, 1},
                                     {50, 0},
                                     {47, 2},
                                     {43, 12},
                                     {39, 4},
                                     {35, 6},
                                     {34, 1},
                                     {33, 1},
                                     {32, 0}}) |
                             indexAt(0, 0, 0) | indexAt(1, 0, 1) | indexAt(2, 0, 2) | indexAt(3, 0, 3);
  const Image8 image = decodeEtc2(blockOf(bits), 4, 4);
  // The first colour (119, 51, 170) is below the second (204, 68, 102): the order adds 0 to the distance's index 4: 23.
  EXPECT_EQ(texel(image, 0, 0), (Rgba{119 + 23, 51 + 23, 170 + 23, 255}));
  EXPECT_EQ(texel(image, 1, 0), (Rgba{119 - 23, 51 - 23, 170 - 23, 255}));
  EXPECT_EQ(texel(image, 2, 0), (Rgba{204 + 23, 68 + 23, 102 + 23, 255}));
  EXPECT_EQ(texel(image, 3, 0), (Rgba{204 - 23, 68 - 23, 102 - 23, 255}));
}

TEST(Etc2, DecodesPlanes) {
  // Origin R 32, G 64, B 32 of 6, 7 and 6 bits; to the right R 48, down G 96; B as it is. B's field 47-43 with 42-40:
  // 00000 and -1 leaves the range: bits 44-43 are B's, 41-39 too. RO 100000: 62-57. GO 1000000: 56, 54-49. BO 100000:
  // 48, 44-43, 41-39. RH 110000: 38-34, 32. GH 1000000: 31-25. BH 100000: 24-19. RV 100000: 18-13. GV 1100000: 12-6. BV
  // 100000: 5-0. Bit 42 set: the difference is -4 at B 0.
  const std::uint64_t bits = bitsOf({{57, 32},
                                     {56, 1},
                                     {49, 0},
                                     {48, 1},
                                     {43, 0},
                                     {42, 1},
                                     {39, 0},
                                     {34, 24},
                                     {33, 1},
                                     {32, 0},
                                     {25, 64},
                                     {19, 32},
                                     {13, 32},
                                     {6, 96},
                                     {0, 32}});
  const Image8 image = decodeEtc2(blockOf(bits), 4, 4);
  // Extended: 32 -> 130, 48 -> 195; 64 -> 129, 96 -> 193.
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_EQ(texel(image, x, y), (Rgba{(x * 65 + 4 * 130 + 2) >> 2, (y * 64 + 4 * 129 + 2) >> 2, 130, 255}))
          << x << " " << y;
}

TEST(Etc2, DecodesAlphaByItsTableAndMultiplier) {
  Block block = blockOf(0, 100);
  block[1] = 0x3d; // multiplier 3, table 13: -1 -2 -3 -10 0 1 2 9
  // Texel 0 (0, 0) takes index 7, texel 1 (0, 1) index 3, the others 0.
  const std::uint64_t indices = std::uint64_t{7} << 45 | std::uint64_t{3} << 42;
  for (int i = 0; i < 6; ++i)
    block[static_cast<std::size_t>(2 + i)] = static_cast<std::uint8_t>(indices >> (40 - 8 * i));
  const Image8 image = decodeEtc2(block, 4, 4);
  EXPECT_EQ(image.at(0, 0)[3], 127);
  EXPECT_EQ(image.at(0, 1)[3], 70);
  EXPECT_EQ(image.at(1, 0)[3], 97);
}

Image8 makePicture(int width, int height, int kind) {
  Image8 image(width, height, 4, 255);
  std::mt19937 random(7);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t* t = image.at(x, y);
      const auto noise = [&] { return static_cast<int>(random() % 9); };
      for (int c = 0; c < 3; ++c) {
        int value = 0;
        if (kind == 0) value = 40 + (x * (c + 2) + y * (3 - c)) / 2;             // smooth
        if (kind == 1) value = (x / 3 + y / 3) % 2 ? 200 - 60 * c : 30 + 70 * c; // two hues
        if (kind == 2) value = 100 + (x * 7 + y * 13) % 60 + noise();            // grain
        t[c] = static_cast<std::uint8_t>(std::clamp(value, 0, 255));
      }
      t[3] = static_cast<std::uint8_t>(kind == 2 ? 128 + 100 * std::sin(0.2 * x + 0.3 * y) : 255);
    }
  return image;
}

std::string modeOf(const std::uint8_t* color) {
  const auto at = [&](int byte, int low, int bits) { return color[byte] >> low & ((1 << bits) - 1); };
  if (!at(3, 1, 1)) return "individual";
  for (const auto& [byte, mode] : {std::pair{0, "T"}, {1, "H"}, {2, "planar"}}) {
    const int step = at(byte, 0, 3), sum = at(byte, 3, 5) + (step >= 4 ? step - 8 : step);
    if (sum < 0 || sum > 31) return mode;
  }
  return "differential";
}

// Root mean square errors by mode: a mode that were decoded wrongly would be off by far more than its encoder let it
// be.
TEST(Etc2, ShowsWhatTheEncoderMeantInEachMode) {
  std::map<std::string, std::pair<double, int>> errors;
  for (const int kind : {0, 1, 2}) {
    const Image8 image = makePicture(96, 64, kind);
    const std::vector<std::uint8_t> blocks = encodeEtc2(image, false);
    ASSERT_EQ(blocks.size(), etc2Bytes(96, 64));
    const Image8 decoded = decodeEtc2(blocks, 96, 64);
    for (int by = 0; by < 16; ++by)
      for (int bx = 0; bx < 24; ++bx) {
        const std::string mode = modeOf(blocks.data() + 16 * (24 * by + bx) + 8);
        // Two hues in a block are for T and H: with little effort the encoder leaves halves of one hue there.
        if (kind == 1 && mode != "T" && mode != "H") continue;
        auto& [sum, count] = errors[mode];
        for (int i = 0; i < 16; ++i)
          for (int c = 0; c < 3; ++c) {
            const int x = 4 * bx + i % 4, y = 4 * by + i / 4;
            sum += std::pow(image.at(x, y)[c] - decoded.at(x, y)[c], 2);
            ++count;
          }
      }
    double alpha = 0;
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) alpha += std::abs(image.pixels[i] - decoded.pixels[i]);
    EXPECT_LT(alpha / static_cast<double>(image.pixelCount()), kind == 2 ? 4 : 0.01) << "an opaque image stays opaque";
  }
  for (const char* mode : {"individual", "differential", "T", "H", "planar"}) {
    EXPECT_GT(errors[mode].second, 0) << mode << " is not exercised";
    EXPECT_LT(std::sqrt(errors[mode].first / errors[mode].second), 12) << mode;
    std::printf("  %-12s %5d blocks, rms %.2f\n", mode, errors[mode].second / 48,
                std::sqrt(errors[mode].first / errors[mode].second));
  }
}

TEST(Etc2, TakesSidesThatAreNoMultiplesOfFour) {
  const Image8 image = makePicture(13, 7, 0);
  const std::vector<std::uint8_t> blocks = encodeEtc2(image, true);
  EXPECT_EQ(blocks.size(), 4u * 2 * 16);
  const Image8 decoded = decodeEtc2(blocks, 13, 7);
  EXPECT_EQ(decoded.width, 13);
  int worst = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    worst = std::max(worst, std::abs(image.pixels[i] - decoded.pixels[i]));
  EXPECT_LT(worst, 16);
  EXPECT_EQ(etc2Bytes(1, 1), 16u);
  EXPECT_EQ(decodeEtc2(encodeEtc2(Image8(1, 1, 4, 100), false), 1, 1).width, 1);
}

TEST(Etc2, IsTheSameOnAnyNumberOfThreads) {
  const Image8 image = makePicture(64, 64, 2);
  const std::vector<std::uint8_t> expected = encodeEtc2(image, true);
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(encodeEtc2(image, true), expected) << threads;
    EXPECT_EQ(decodeEtc2(expected, 64, 64), decodeEtc2(encodeEtc2(image, true), 64, 64));
  }
}

TEST(TextureBlock, HasNamesAndSizesOfItsOwn) {
  EXPECT_EQ(textureBlockNames(), (std::vector<std::string>{"none", "astc4x4", "astc6x6", "etc2"}));
  EXPECT_DOUBLE_EQ(bitsPerTexel(TextureBlock::none), 32);
  EXPECT_DOUBLE_EQ(bitsPerTexel(TextureBlock::astc4x4), 8);
  EXPECT_NEAR(bitsPerTexel(TextureBlock::astc6x6), 3.56, 0.005);
  EXPECT_DOUBLE_EQ(bitsPerTexel(TextureBlock::etc2), 8);
  const Image8 image = makePicture(24, 12, 0);
  for (const TextureBlock block : {TextureBlock::astc4x4, TextureBlock::astc6x6, TextureBlock::etc2})
    for (const bool isColor : {false, true}) {
      const std::vector<std::uint8_t> blocks = encodeTexture(image, block, isColor);
      EXPECT_EQ(blocks.size(), textureBytes(24, 12, block));
      const Image8 decoded = decodeTexture(blocks, 24, 12, block, isColor);
      double sum = 0;
      for (std::size_t i = 0; i < image.pixels.size(); ++i) sum += std::abs(image.pixels[i] - decoded.pixels[i]);
      EXPECT_LT(sum / static_cast<double>(image.pixels.size()), 4);
      EXPECT_NE(decoded, image) << "something is lost";
    }
}

} // namespace
} // namespace parity::base
