// The block compressions that phones store textures in, by name: what is left of an image once it went through one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/image/image.h"

namespace parity::base {

// none: 8 bits a channel, nothing is lost. ASTC: blocks of 16 bytes for 4 x 4 or 6 x 6 texels (base/image/astc.h).
// ETC2: RGBA8 with EAC alpha, blocks of 16 bytes for 4 x 4 texels (base/image/etc2.h).
enum class TextureBlock { none, astc4x4, astc6x6, etc2 };
// "none", "astc4x4", "astc6x6", "etc2", in the enumerators' order.
const std::vector<std::string>& textureBlockNames();

// 32, 8, 3.56 and 8. An opaque texture of ETC2 takes 4: its blocks without those of alpha.
double bitsPerTexel(TextureBlock block);

// Of an image's blocks. block: not none, here and below.
std::size_t textureBytes(int width, int height, TextureBlock block);

// The image's blocks, row by row. rgba: 4 channels, at least 1 x 1. isColor: sRGB with a linear alpha, else four
// numbers that have nothing to do with each other. The same bytes for any number of threads. Throws Error (exit 4)
// where the codec fails.
std::vector<std::uint8_t> encodeTexture(const Image8& rgba, TextureBlock block, bool isColor);

// What these blocks show, 8 bits a channel: as many as an image of this size has. Throws Error (exit 4).
Image8 decodeTexture(std::span<const std::uint8_t> blocks, int width, int height, TextureBlock block, bool isColor);

} // namespace parity::base
