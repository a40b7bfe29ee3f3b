// Small sound environment images: Radiance HDR flat and by run lengths, PFM, and OpenEXR by scanlines
// and tiles, whose chunks are stored as they are under every compression (a chunk that does not shrink is stored raw).
#include "fuzz/environment_seeds.h"

#include <bit>
#include <cstdint>

#include "base/file.h"
#include "base/image/image_io.h"
#include "fuzz/byte_parts.h"
#include "fuzz/exr_bytes.h"
#include "scenes/gltf/gltf_writer.h"

namespace parity::tests {
namespace {

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
  seeds["runs.hdr"] = makeHdr(16, 8, "-Y +X ", runRows(16, 8));
  seeds["upside-down.hdr"] = makeHdr(16, 8, "+Y +X ", runRows(16, 8));
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
