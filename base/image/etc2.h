// ETC2, the block compression that every phone with OpenGL ES 3 has (Khronos Data Format 1.3, chapters 21 and 22): RGB
// in blocks of 8 bytes, alpha in EAC blocks of 8 bytes before them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/image/image.h"

namespace parity::base {

inline constexpr int kEtc2BlockSide = 4;

// Of an image's RGBA blocks: 16 for each 4 x 4 texels, begun ones included.
std::size_t etc2Bytes(int width, int height);

// The image's blocks, row by row, by Google's etc2comp as Debian's libfilament holds it, which is loaded on first use.
// rgba: 4 channels, at least 1 x 1. isColor: errors count as eyes see them (Rec.709), else each channel's alike. The
// codes are compressed as they are: the format is the same for sRGB and linear. On all threads; the same bytes for any
// number of them. Throws Error (exit 4) where the codec is missing or fails.
std::vector<std::uint8_t> encodeEtc2(const Image8& rgba, bool isColor);

// What these blocks show, 8 bits a channel: as many as an image of this size has. Throws Error (exit 4).
Image8 decodeEtc2(std::span<const std::uint8_t> blocks, int width, int height);

} // namespace parity::base
