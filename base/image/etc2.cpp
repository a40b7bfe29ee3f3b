#include "base/image/etc2.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>

#include "base/image/etc2_module.h"
#include "base/module_file.h"
#include "base/parallel.h"

namespace parity::base {

namespace {

constexpr std::size_t kEtc2BlockBytes = 16;
// Of 0 to 100: how many of the worst blocks are tried again. etc2comp's own default is 40; docs/textures.md has what
// more effort is worth.
constexpr int kEffort = 10;

EncodeEtc2 loadEncoder() {
  return reinterpret_cast<EncodeEtc2>(moduleFunction("parity_etc2.so", kEncodeEtc2,
                                                     "the ETC2 codec of libfilament1.9 is needed: install it",
                                                     "textures cannot be compressed as ETC2"));
}

// Up to whole blocks, which the codec asks for: the last column and row go on.
std::vector<float> padded(const Image8& rgba, int width, int height) {
  std::vector<float> values;
  values.reserve(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* texel = rgba.at(std::min(x, rgba.width - 1), std::min(y, rgba.height - 1));
      for (int c = 0; c < 4; ++c) values.push_back(static_cast<float>(texel[c]) / 255);
    }
  return values;
}

int roundUp(int side) { return (side + kEtc2BlockSide - 1) / kEtc2BlockSide * kEtc2BlockSide; }

// ---- decoding: Khronos Data Format 1.3, chapters 21 (ETC1) and 22 (ETC2); bit 63 is the first byte's highest

using Bits = std::uint64_t;
using Color = std::array<int, 3>;

Bits bitsAt(const std::uint8_t* bytes) {
  Bits bits = 0;
  for (int i = 0; i < 8; ++i) bits = bits << 8 | bytes[i];
  return bits;
}

int field(Bits bits, int high, int low) { return static_cast<int>(bits >> low & ((Bits{1} << (high - low + 1)) - 1)); }
int signed3(int value) { return value >= 4 ? value - 8 : value; }
int extend(int value, int bits) { return value << (8 - bits) | value >> (2 * bits - 8); }
std::uint8_t clamped(int value) { return static_cast<std::uint8_t>(std::clamp(value, 0, 255)); }

// Which of four a texel takes. Texels run down the columns.
int indexOf(Bits bits, int x, int y) {
  const int k = 4 * x + y;
  return 2 * field(bits, 16 + k, 16 + k) + field(bits, k, k);
}

void put(std::uint8_t* texel, const Color& color, int modifier) {
  for (std::size_t c = 0; c < 3; ++c) texel[c] = clamped(color[c] + modifier);
}

// Texels of a block, row by row, 4 channels.
using Texels = std::array<std::uint8_t, 64>;
std::uint8_t* at(Texels& texels, int x, int y) { return texels.data() + 4 * (4 * y + x); }

// Two halves, each a colour and a table of modifiers (table 21.2).
void decodeHalves(Bits bits, const Color& first, const Color& second, Texels& texels) {
  constexpr int kModifiers[8][2] = {{2, 8}, {5, 17}, {9, 29}, {13, 42}, {18, 60}, {24, 80}, {33, 106}, {47, 183}};
  const int tables[2] = {field(bits, 39, 37), field(bits, 36, 34)};
  const bool flipped = field(bits, 32, 32) != 0;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      const bool isSecond = (flipped ? y : x) >= 2;
      const int index = indexOf(bits, x, y), size = kModifiers[tables[isSecond ? 1 : 0]][index % 2];
      put(at(texels, x, y), isSecond ? second : first, index < 2 ? size : -size);
    }
}

// Four colours to choose from: modes T and H.
void decodePainted(Bits bits, const std::array<Color, 4>& paint, Texels& texels) {
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) put(at(texels, x, y), paint[static_cast<std::size_t>(indexOf(bits, x, y))], 0);
}

constexpr int kDistances[8] = {3, 6, 11, 16, 23, 32, 41, 64}; // table 22.8

Color moved(const Color& color, int by) { return {color[0] + by, color[1] + by, color[2] + by}; }

void decodeT(Bits bits, Texels& texels) {
  const Color a = {extend(field(bits, 60, 59) << 2 | field(bits, 57, 56), 4), extend(field(bits, 55, 52), 4),
                   extend(field(bits, 51, 48), 4)};
  const Color b = {extend(field(bits, 47, 44), 4), extend(field(bits, 43, 40), 4), extend(field(bits, 39, 36), 4)};
  const int d = kDistances[field(bits, 35, 34) << 1 | field(bits, 32, 32)];
  decodePainted(bits, {a, moved(b, d), b, moved(b, -d)}, texels);
}

void decodeH(Bits bits, Texels& texels) {
  const Color a = {extend(field(bits, 62, 59), 4), extend(field(bits, 58, 56) << 1 | field(bits, 52, 52), 4),
                   extend(field(bits, 51, 51) << 3 | field(bits, 49, 47), 4)};
  const Color b = {extend(field(bits, 46, 43), 4), extend(field(bits, 42, 39), 4), extend(field(bits, 38, 35), 4)};
  const int order = a >= b ? 1 : 0; // as 24-bit numbers: the order of the colours is a bit of the distance
  const int d = kDistances[field(bits, 34, 34) << 2 | field(bits, 32, 32) << 1 | order];
  decodePainted(bits, {moved(a, d), moved(a, -d), moved(b, d), moved(b, -d)}, texels);
}

void decodePlanar(Bits bits, Texels& texels) {
  const Color o = {extend(field(bits, 62, 57), 6), extend(field(bits, 56, 56) << 6 | field(bits, 54, 49), 7),
                   extend(field(bits, 48, 48) << 5 | field(bits, 44, 43) << 3 | field(bits, 41, 39), 6)};
  const Color h = {extend(field(bits, 38, 34) << 1 | field(bits, 32, 32), 6), extend(field(bits, 31, 25), 7),
                   extend(field(bits, 24, 19), 6)};
  const Color v = {extend(field(bits, 18, 13), 6), extend(field(bits, 12, 6), 7), extend(field(bits, 5, 0), 6)};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        at(texels, x, y)[c] = clamped((x * (h[c] - o[c]) + y * (v[c] - o[c]) + 4 * o[c] + 2) >> 2);
}

void decodeRgb(Bits bits, Texels& texels) {
  if (field(bits, 33, 33) == 0) {
    decodeHalves(bits, {extend(field(bits, 63, 60), 4), extend(field(bits, 55, 52), 4), extend(field(bits, 47, 44), 4)},
                 {extend(field(bits, 59, 56), 4), extend(field(bits, 51, 48), 4), extend(field(bits, 43, 40), 4)},
                 texels);
    return;
  }
  // Differences; where one leaves its range, another mode stands in its place.
  const Color first = {field(bits, 63, 59), field(bits, 55, 51), field(bits, 47, 43)};
  const Color second = {first[0] + signed3(field(bits, 58, 56)), first[1] + signed3(field(bits, 50, 48)),
                        first[2] + signed3(field(bits, 42, 40))};
  const auto isOutside = [](int value) { return value < 0 || value > 31; };
  if (isOutside(second[0])) return decodeT(bits, texels);
  if (isOutside(second[1])) return decodeH(bits, texels);
  if (isOutside(second[2])) return decodePlanar(bits, texels);
  decodeHalves(bits, {extend(first[0], 5), extend(first[1], 5), extend(first[2], 5)},
               {extend(second[0], 5), extend(second[1], 5), extend(second[2], 5)}, texels);
}

// EAC: base + modifier times multiplier (table 22.13).
void decodeAlpha(Bits bits, Texels& texels) {
  constexpr int kModifiers[16][8] = {
      {-3, -6, -9, -15, 2, 5, 8, 14}, {-3, -7, -10, -13, 2, 6, 9, 12}, {-2, -5, -8, -13, 1, 4, 7, 12},
      {-2, -4, -6, -13, 1, 3, 5, 12}, {-3, -6, -8, -12, 2, 5, 7, 11},  {-3, -7, -9, -11, 2, 6, 8, 10},
      {-4, -7, -8, -11, 3, 6, 7, 10}, {-3, -5, -8, -11, 2, 4, 7, 10},  {-2, -6, -8, -10, 1, 5, 7, 9},
      {-2, -5, -8, -10, 1, 4, 7, 9},  {-2, -4, -8, -10, 1, 3, 7, 9},   {-2, -5, -7, -10, 1, 4, 6, 9},
      {-3, -4, -7, -10, 2, 3, 6, 9},  {-1, -2, -3, -10, 0, 1, 2, 9},   {-4, -6, -8, -9, 3, 5, 7, 8},
      {-3, -5, -7, -9, 2, 4, 6, 8}};
  const int base = field(bits, 63, 56), multiplier = field(bits, 55, 52), table = field(bits, 51, 48);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y) {
      const int low = 45 - 3 * (4 * x + y);
      at(texels, x, y)[3] = clamped(base + kModifiers[table][field(bits, low + 2, low)] * multiplier);
    }
}

} // namespace

std::size_t etc2Bytes(int width, int height) {
  return kEtc2BlockBytes * static_cast<std::size_t>(roundUp(width) / kEtc2BlockSide) *
         static_cast<std::size_t>(roundUp(height) / kEtc2BlockSide);
}

std::vector<std::uint8_t> encodeEtc2(const Image8& rgba, bool isColor) {
  assert(rgba.channels == 4 && !rgba.empty());
  static const EncodeEtc2 encode = loadEncoder(); // once, whichever thread comes first; tried again after a failure
  const int width = roundUp(rgba.width), height = roundUp(rgba.height);
  const std::vector<float> values = padded(rgba, width, height);
  std::vector<std::uint8_t> blocks(etc2Bytes(width, height));
  if (!encode(values.data(), static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), kEffort, isColor,
              blocks.data()))
    throw Error(ExitCode::failed, "ETC2", "", "the codec returned no blocks");
  return blocks;
}

Image8 decodeEtc2(std::span<const std::uint8_t> blocks, int width, int height) {
  assert(blocks.size() == etc2Bytes(width, height));
  Image8 result(width, height, 4);
  const int columns = roundUp(width) / kEtc2BlockSide, rows = roundUp(height) / kEtc2BlockSide;
  parallelFor(static_cast<std::size_t>(rows), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int column = 0; column < columns; ++column) {
        const std::uint8_t* block = blocks.data() + kEtc2BlockBytes * (row * static_cast<std::size_t>(columns) +
                                                                       static_cast<std::size_t>(column));
        Texels texels{};
        decodeAlpha(bitsAt(block), texels);
        decodeRgb(bitsAt(block + 8), texels);
        const int left = kEtc2BlockSide * column, top = kEtc2BlockSide * static_cast<int>(row);
        for (int y = 0; y < std::min(4, height - top); ++y)
          for (int x = 0; x < std::min(4, width - left); ++x)
            std::copy_n(at(texels, x, y), 4, result.at(left + x, top + y));
      }
  });
  return result;
}

} // namespace parity::base
