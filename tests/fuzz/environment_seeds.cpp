// Small sound environment images: Radiance HDR flat and by run lengths, PFM, and OpenEXR by scanlines
// and tiles, whose chunks are stored as they are under every compression (a chunk that does not shrink is stored raw).
#include "fuzz/environment_seeds.h"

#include <bit>
#include <cstdint>

#include "base/file.h"
#include "base/image_io.h"
#include "scenes/gltf_writer.h"

namespace parity::tests {
namespace {

using Bytes = std::vector<std::byte>;

void addText(Bytes& bytes, const std::string& text) {
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
}

void add(Bytes& bytes, std::uint64_t value, int count = 4) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i) & 0xff));
}

// Greg Ward's RGBE; `rows`: the encoded pixels.
Bytes makeHdr(int width, int height, const std::string& orientation, const Bytes& rows) {
  Bytes bytes;
  addText(bytes, "#?RADIANCE\n# made by a test\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n");
  addText(bytes,
          orientation.substr(0, 3) + std::to_string(height) + orientation.substr(2) + std::to_string(width) + "\n");
  bytes.insert(bytes.end(), rows.begin(), rows.end());
  return bytes;
}

Bytes flatRows(int pixels) {
  Bytes bytes;
  for (int i = 0; i < pixels; ++i) add(bytes, 0x80604020u + static_cast<unsigned>(i));
  return bytes;
}

// New run lengths: 2, 2, width; then each of four channels: a run of 8, and the rest as they are.
Bytes runRows(int width, int height) {
  Bytes bytes;
  for (int y = 0; y < height; ++y) {
    add(bytes, 0x0202, 2);
    add(bytes, static_cast<std::uint64_t>(width >> 8 | (width & 0xff) << 8), 2);
    for (int c = 0; c < 4; ++c) {
      add(bytes, 128 + 8, 1);
      add(bytes, 100, 1);
      add(bytes, static_cast<std::uint64_t>(width - 8), 1);
      for (int x = 8; x < width; ++x) add(bytes, static_cast<std::uint64_t>(128 + x), 1);
    }
  }
  return bytes;
}

void addAttribute(Bytes& bytes, const std::string& name, const std::string& type, const Bytes& value) {
  addText(bytes, name + '\0');
  addText(bytes, type + '\0');
  add(bytes, value.size());
  bytes.insert(bytes.end(), value.begin(), value.end());
}

struct ExrLayout {
  int compression = 0;   // 0 none, 1 rle, 2 zips, 3 zip, 4 piz, 5 pxr24, 6 b44, 7 b44a, 8 dwaa, 9 dwab
  int linesAChunk = 1;   // of that compression
  bool isTiled = false;  // 4 x 4 texels
  bool isPacked = false; // rle only: each chunk is a run of 128s
};

// 8 x 4 texels of three half floats.
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
  for (const char* name : {"dataWindow", "displayWindow"})
    addAttribute(bytes, name, "box2i", ints({0, 0, kWidth - 1, kHeight - 1}));
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

Bytes makePfm(const std::string& kind, int channels) {
  Bytes bytes;
  addText(bytes, kind + "\n4 2\n-1.0\n");
  for (int i = 0; i < 8 * channels; ++i) add(bytes, std::bit_cast<std::uint32_t>(0.25f * static_cast<float>(i)));
  return bytes;
}

} // namespace

std::map<std::string, Bytes> makeEnvironmentSeeds() {
  std::map<std::string, Bytes> seeds;
  seeds["flat.hdr"] = makeHdr(4, 2, "-Y +X ", flatRows(8));
  seeds["runs.hdr"] = makeHdr(16, 2, "-Y +X ", runRows(16, 2));
  seeds["upside-down.hdr"] = makeHdr(16, 2, "+Y +X ", runRows(16, 2));
  seeds["raw.exr"] = makeExr({});
  seeds["rle.exr"] = makeExr({.compression = 1, .isPacked = true});
  constexpr int kLines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
  for (int compression = 1; compression < 10; ++compression)
    seeds["stored-" + std::to_string(compression) + ".exr"] =
        makeExr({.compression = compression, .linesAChunk = kLines[compression]});
  seeds["tiled.exr"] = makeExr({.isTiled = true});
  seeds["tiled-rle.exr"] = makeExr({.compression = 1, .isTiled = true, .isPacked = true});
  seeds["grey.pfm"] = makePfm("Pf", 1);
  seeds["colour.pfm"] = makePfm("PF", 3);
  const TempFolder folder; // and as the program itself writes them
  base::Image image(12, 6, 3, 0.5f);
  for (std::size_t i = 0; i < image.pixels.size(); i += 5) image.pixels[i] = static_cast<float>(i);
  for (const char* name : {"written.hdr", "zip.exr"}) {
    base::writeImage(folder / name, image);
    seeds[name] = base::readFile(folder / name);
  }
  return seeds;
}

} // namespace parity::tests
