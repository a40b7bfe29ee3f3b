// A window on pixels that somebody else owns: 8-bit or float, any stride.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/image/image.h"

namespace parity::compare {

// Part of an image: columns x .. x+width-1, rows y .. y+height-1.
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
  bool empty() const { return width <= 0 || height <= 0; }
  bool operator==(const Rect&) const = default;
};

// Interleaved pixels, the top row first. Either of the pointers is set.
struct PixelView {
  const std::uint8_t* bytes = nullptr; // 0..255
  const float* floats = nullptr;
  int width = 0, height = 0, channels = 0;
  std::ptrdiff_t stride = 0; // values from a row to the next; may be more than width*channels, or negative

  PixelView() = default;
  PixelView(const base::Image& image) // NOLINT: an image is a view of itself
      : floats(image.pixels.data()), width(image.width), height(image.height), channels(image.channels),
        stride(static_cast<std::ptrdiff_t>(image.width) * image.channels) {}
  PixelView(const base::Image8& image) // NOLINT
      : bytes(image.pixels.data()), width(image.width), height(image.height), channels(image.channels),
        stride(static_cast<std::ptrdiff_t>(image.width) * image.channels) {}

  bool empty() const { return width <= 0 || height <= 0 || channels <= 0; }
};

} // namespace parity::compare
