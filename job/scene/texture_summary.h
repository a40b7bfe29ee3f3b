// What a decoded texture holds: of each channel how often each value occurs, and a small picture.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/image/image.h"

namespace parity::job {

// Of one channel how many texels have each of the 256 values.
using ValueCounts = std::array<std::uint64_t, 256>;

struct TextureSummary {
  std::array<ValueCounts, 4> counts{}; // r, g, b, a
};

// images: of 4 channels. All cores; the counts are exact.
std::vector<TextureSummary> summarise(std::span<const base::Image8* const> images);

struct ValueRange {
  double least = 0, most = 0, mean = 0;
};

// Of counts that hold a texel. isColor: of linear light by the sRGB transfer function, else value / 255.
ValueRange rangeOf(const ValueCounts& counts, bool isColor);

// At most so many texels a side.
inline constexpr int kThumbnailSide = 96;

// channels: "rgb", or one of "r", "g", "b", "a", which makes a grey picture. Each of its pixels is the mean over at
// most 4 x 4 texels that are spread over its place, isColor: in linear light.
base::Image8 makeThumbnail(const base::Image8& image, std::string_view channels, bool isColor);

} // namespace parity::job
