// PNG files made by hand, so that reading is not tested against our own writing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace parity::base {

struct PngHeader {
  std::uint32_t width = 1, height = 1;
  std::uint8_t bitDepth = 8;
  std::uint8_t colorType = 2; // 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
};

// samples: the rows as they stand in the file (16 bit: big-endian), without the filter bytes. extra: whole chunks, as
// makePngChunk returns them, that come before the pixels.
std::vector<std::byte> makePng(const PngHeader& header, std::span<const std::uint8_t> samples,
                               const std::string& extra = "");

std::string makePngChunk(const std::string& type, const std::string& data);

} // namespace parity::base
