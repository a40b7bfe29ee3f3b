// OpenEXR files of any kind that the core library can write.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <openexr.h>

namespace parity::base {

struct ExrKind {
  exr_compression_t compression = EXR_COMPRESSION_ZIP;
  int width = 1, height = 1;
  int x = 0, y = 0;                  // of the data window; the display window is larger by 3 pixels on each side
  int tileWidth = 0, tileHeight = 0; // 0: scanlines
  std::vector<std::string> names = {"B", "G", "R"}; // in order
  std::vector<bool> halves = {true};                // of each channel, or one for all; else floats
  bool hasChromaticities = false;
  int orientation = 0;         // 0: not said
  std::string colorSpace = {}; // as the image library notes it; empty: not said
};

// The bytes of such a file, which is written there; its samples are `bits`, of each channel in turn, over and over.
std::vector<std::byte> makeExr(const std::filesystem::path& file, const ExrKind& kind,
                               const std::vector<std::uint32_t>& bits);

} // namespace parity::base
