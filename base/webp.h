// WebP by libwebp itself: the image library multiplies the colour of what it reads by alpha, and cannot be told not to.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "base/image.h"

namespace parity::base {

// Whether the bytes begin as a WebP file does (RFC 9649).
bool isWebp(std::span<const std::byte> bytes);

// The image, 8 bit; an animation is refused; `channels` as
// decodeImage8 (image_io.h) gives them. Throws Error (exit 4): truncated, damaged, too large.
Image8 decodeWebp(std::span<const std::byte> bytes, const std::string& name, int channels);

} // namespace parity::base
