// A pair of images as metrics see it: checked, and with numbers in place of NaN.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/image/image.h"
#include "compare/pooling/pixel_view.h"

namespace parity::compare {

// What is compared. The pixels must outlive whatever is made of the pair.
struct ImagePair {
  PixelView reference, test; // display-encoded sRGB, 0..1 or bytes 0..255, 3 channels
  // The same as linear Rec.709 light, 3 channels; both or neither. Null: metrics that can do without them decode the
  // displayed images.
  const base::Image *referenceLinear = nullptr, *testLinear = nullptr;
  // Pixels (y*width+x) known to be unusable though the images do not show it: bytes cannot hold NaN.
  std::span<const std::uint32_t> invalid = {};
};

// The pair with 0 in every pixel that is NaN or infinite in that image.
struct MetricInput {
  PixelView reference, test;
  const base::Image *referenceLinear = nullptr, *testLinear = nullptr; // null where the pair has none
  std::vector<std::uint32_t> nonFinite; // pixels that are not finite in any of the images, or invalid; ascending

  // Throws Error: notComparable for empty images, unlike sizes, channels other than 3, or only one linear image; failed
  // for an invalid pixel outside the image.
  explicit MetricInput(const ImagePair& pair);
  MetricInput(const MetricInput&) = delete;
  MetricInput& operator=(const MetricInput&) = delete;

  int width() const { return reference.width; }
  int height() const { return reference.height; }
  std::size_t pixelCount() const { return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()); }

private:
  base::Image m_copies[4]; // of images that have non-finite pixels
};

// Sets those pixels of a one-channel map.
void setPixels(base::Image& map, std::span<const std::uint32_t> pixels, float value);

} // namespace parity::compare
