// Small OpenEXR files made by hand ("OpenEXR File Layout", Academy Software Foundation).
#include "fuzz/exr_bytes.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>

#include "fuzz/byte_parts.h"

namespace parity::tests {
namespace {

void addAttribute(Bytes& bytes, const std::string& name, const std::string& type, const Bytes& value) {
  addText(bytes, name + '\0');
  addText(bytes, type + '\0');
  add(bytes, value.size());
  bytes.insert(bytes.end(), value.begin(), value.end());
}

} // namespace

Bytes makeExr(const ExrLayout& layout) {
  constexpr int kWidth = 8, kHeight = 4, kTile = 4, kChannels = 3, kHalfBytes = 2;
  const auto ints = [](std::initializer_list<std::uint32_t> values) {
    Bytes bytes;
    for (const std::uint32_t value : values) add(bytes, value);
    return bytes;
  };
  Bytes bytes, channels, byte;
  add(bytes, 20000630);
  add(bytes, layout.isTiled ? 0x202 : 2);
  for (const char* name : {"B", "G", "R"}) {
    addText(channels, name + std::string(1, '\0'));
    for (const std::uint32_t value : {1u, 0u, 1u, 1u}) add(channels, value); // half, not perceptual, every texel
  }
  add(channels, 0, 1);
  addAttribute(bytes, "channels", "chlist", channels);
  add(byte, static_cast<std::uint64_t>(layout.compression), 1);
  addAttribute(bytes, "compression", "compression", byte);
  addAttribute(bytes, "dataWindow", "box2i", ints({0, 0, kWidth - 1, kHeight - 1}));
  addAttribute(bytes, "displayWindow", "box2i",
               ints({0, 0, static_cast<std::uint32_t>(layout.displayWidth - 1), kHeight - 1}));
  if (layout.envmap >= 0) addAttribute(bytes, "envmap", "envmap", {static_cast<std::byte>(layout.envmap)});
  addAttribute(bytes, "lineOrder", "lineOrder", {std::byte{0}});
  const std::uint32_t one = std::bit_cast<std::uint32_t>(1.f);
  addAttribute(bytes, "pixelAspectRatio", "float", ints({one}));
  addAttribute(bytes, "screenWindowCenter", "v2f", ints({0, 0}));
  addAttribute(bytes, "screenWindowWidth", "float", ints({one}));
  if (layout.isTiled) {
    Bytes tiles = ints({kTile, kTile});
    add(tiles, 0, 1);
    addAttribute(bytes, "tiles", "tiledesc", tiles);
  }
  add(bytes, 0, 1);

  const int lines = layout.isTiled ? kTile : std::min(layout.linesAChunk, kHeight);
  const int columns = layout.isTiled ? kTile : kWidth;
  std::vector<Bytes> chunks;
  for (int y = 0; y < kHeight; y += lines)
    for (int x = 0; x < kWidth; x += columns) {
      Bytes data;
      const int raw = lines * columns * kChannels * kHalfBytes;
      if (layout.isPacked)
        for (int left = raw; left > 0; left -= 128) {
          add(data, static_cast<std::uint64_t>(std::min(left, 128) - 1), 1); // that many times and once more
          add(data, 128, 1);
        }
      else
        for (int i = 0; i < raw / kHalfBytes; ++i) add(data, 0x3c00 + static_cast<std::uint64_t>(i), kHalfBytes);
      Bytes& chunk = chunks.emplace_back();
      if (layout.isTiled)
        chunk = ints({static_cast<std::uint32_t>(x / kTile), static_cast<std::uint32_t>(y / kTile), 0, 0});
      else
        chunk = ints({static_cast<std::uint32_t>(y)});
      add(chunk, data.size());
      chunk.insert(chunk.end(), data.begin(), data.end());
    }
  std::size_t offset = bytes.size() + 8 * chunks.size();
  for (const Bytes& chunk : chunks) {
    add(bytes, offset, 8);
    offset += chunk.size();
  }
  for (const Bytes& chunk : chunks) bytes.insert(bytes.end(), chunk.begin(), chunk.end());
  return bytes;
}

} // namespace parity::tests
