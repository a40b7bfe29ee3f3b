// What reading one image file may ask for, checked by its header before memory is taken.
#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/image/image.h"

namespace parity::base {

// Beside the limits of any image (image.h).
struct ImageLimits {
  std::size_t maxSide = kMaxImageSide;     // pixels (--max-image)
  std::size_t maxPixels = kMaxImagePixels; // of one image (--max-image)
  // Bytes of the values that are handed on and of what decoding takes beside them (--max-memory).
  std::size_t maxBytes = std::numeric_limits<std::size_t>::max();
};

// checkImageSize() (image.h), and the limits of side and pixels. Throws Error (exit 4).
inline void checkImageSize(const std::string& name, long long width, long long height, long long channels,
                           const ImageLimits& limits) {
  checkImageSize(name, width, height, channels);
  const auto across = static_cast<std::size_t>(width), down = static_cast<std::size_t>(height);
  const auto refuse = [&](const char* what, std::size_t most) {
    throw fileError(name, "",
                    std::to_string(width) + " x " + std::to_string(height) + " pixels: " + what + std::to_string(most) +
                        " (--max-image)");
  };
  if (across > limits.maxSide || down > limits.maxSide) refuse("the largest allowed side is ", limits.maxSide);
  if (across * down > limits.maxPixels) refuse("the largest allowed number is ", limits.maxPixels);
}

// Throws Error (exit 4) where `what` ("an image of 3 x 2 pixels") takes more bytes than the limit.
inline void checkImageBytes(const std::string& name, const std::string& what, std::size_t bytes, std::size_t limit) {
  if (bytes <= limit) return;
  throw fileError(name, "",
                  what + " needs " + std::to_string((bytes >> 20) + 1) + " MiB; the limit is " +
                      std::to_string(limit >> 20) + " MiB (--max-memory)");
}

} // namespace parity::base
