// WebP by libwebp itself: the image library multiplies the colour of what it reads by alpha, and cannot be told not to.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "base/image/image.h"
#include "base/image/image_io.h"

namespace parity::base {

// The image, 8 bit; an animation is refused; `channels` as decodeImage8 (image_io.h) gives them. Throws Error (exit 4):
// truncated, damaged, beyond the limits.
Image8 decodeWebp(std::span<const std::byte> bytes, const std::string& name, int channels,
                  const ImageLimits& limits = {});

// The same as readImageFile (image_io.h) gives it: RGB, and alpha where the file has some.
ImageFile readWebp(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits);

// By the header, which the bytes at least hold. Throws Error (exit 4).
ImageShape readWebpShape(std::span<const std::byte> head, const std::string& name, const ImageLimits& limits);

} // namespace parity::base
