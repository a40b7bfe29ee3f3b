// ASTC, the block compression of phones' textures: what is left of an image once it went through it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/image/image.h"

namespace parity::base {

// Blocks of 16 bytes that stand for so many texels each; none: 8 bits a channel, nothing is lost.
enum class AstcBlock { none, astc4x4, astc6x6 };

// What the texels hold, which is the profile that a phone would decode by (ASTC specification, Khronos Data Format 1.3,
// chapter 23): color is sRGB with a linear alpha; data and lightmap are linear, four channels of equal weight, those of
// data without regard to each other.
enum class AstcUse { color, data, lightmap };

// Texels along the side of a block; 1 for none.
int blockSide(AstcBlock block);

// Of an image's blocks.
std::size_t astcBytes(int width, int height, AstcBlock block);

// The image's blocks, row by row, 16 bytes each. rgba: 4 channels, at least 1 x 1; the last blocks of a row or column
// may hang over. On all threads; the same bytes for any number of them. block: not none. Throws Error (exit 4) where
// the codec fails.
std::vector<std::uint8_t> encodeAstc(const Image8& rgba, AstcBlock block, AstcUse use);

// What these blocks show, 8 bits a channel: as many as an image of this size has. Throws Error (exit 4).
Image8 decodeAstc(std::span<const std::uint8_t> blocks, int width, int height, AstcBlock block, AstcUse use);

// The image there and back; itself for none.
Image8 throughAstc(const Image8& rgba, AstcBlock block, AstcUse use);

} // namespace parity::base
