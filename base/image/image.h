// Images in memory: interleaved, row-major, the top row first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"

namespace parity::base {

// Largest side, and largest number of pixels, that any image file or render may have.
inline constexpr int kMaxImageSide = 16384;
inline constexpr std::size_t kMaxImagePixels = std::size_t{1} << 28;
// Largest number of values, over all channels, in one image.
inline constexpr std::size_t kMaxImageValues = std::size_t{1} << 30;

// Pixels of one type. width, height >= 1 unless empty; channels 1..4 (more only for layered files).
template <typename T> struct BasicImage {
  int width = 0, height = 0, channels = 0;
  std::vector<T> pixels;

  BasicImage() = default;
  BasicImage(int w, int h, int c, T value = T{})
      : width(w), height(h), channels(c), pixels(static_cast<std::size_t>(w) * h * c, value) {}

  bool empty() const { return pixels.empty(); }
  std::size_t pixelCount() const { return static_cast<std::size_t>(width) * height; }
  T* at(int x, int y) { return pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels; }
  const T* at(int x, int y) const { return pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels; }
  bool operator==(const BasicImage&) const = default;
};

using Image = BasicImage<float>;         // linear light or data, unless a function says otherwise
using Image8 = BasicImage<std::uint8_t>; // as stored in a file; the user knows the transfer function

// Throws Error (exit 4) naming `name` unless an image of this size has pixels and is within the limits above. For every
// size that comes from outside, before memory is taken.
inline void checkImageSize(const std::string& name, long long width, long long height, long long channels) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (width < 1 || height < 1) throw fileError(name, "", "has no pixels (" + size + ")");
  if (width > kMaxImageSide || height > kMaxImageSide)
    throw fileError(name, "", size + ": the largest allowed side is " + std::to_string(kMaxImageSide));
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (pixels > kMaxImagePixels)
    throw fileError(name, "", size + ": the largest allowed number is " + std::to_string(kMaxImagePixels));
  if (channels < 1) throw fileError(name, "", "has no channels");
  if (static_cast<unsigned long long>(channels) > kMaxImageValues / pixels)
    throw fileError(name, "", size + " of " + std::to_string(channels) + " channels: too many values");
}

} // namespace parity::base
