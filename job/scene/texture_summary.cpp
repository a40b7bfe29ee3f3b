#include "job/scene/texture_summary.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"

namespace parity::job {

namespace {

constexpr std::size_t kGrainTexels = std::size_t{1} << 18; // of 32-bit counts, and of work

using Counts32 = std::array<std::array<std::uint32_t, 256>, 4>;

// Two tables in turn: where neighbours are alike, one would wait for its own last sum.
void count(const std::uint8_t* texel, std::size_t texels, Counts32& even, Counts32& odd) {
  for (; texels >= 2; texels -= 2, texel += 8)
    for (std::size_t c = 0; c < 4; ++c) {
      ++even[c][texel[c]];
      ++odd[c][texel[4 + c]];
    }
  if (texels > 0)
    for (std::size_t c = 0; c < 4; ++c) ++even[c][texel[c]];
}

const std::array<double, 256>& linearOfSrgb() {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double v = static_cast<double>(i) / 255;
      values[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
    return values;
  }();
  return table;
}

double valueOf(std::size_t stored, bool isColor) {
  return isColor ? linearOfSrgb()[stored] : static_cast<double>(stored) / 255;
}

std::uint8_t storedOf(double value, bool isColor) {
  if (isColor) value = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::clamp(value * 255 + 0.5, 0.0, 255.0));
}

std::size_t placeOf(char channel) {
  constexpr std::string_view kChannels = "rgba";
  return kChannels.find(channel);
}

// The texels, at most four, that stand for a range of [first, last).
std::vector<int> spread(int first, int last) {
  const int count = std::min(last - first, 4);
  std::vector<int> places;
  for (int i = 0; i < count; ++i) places.push_back(first + (2 * i + 1) * (last - first) / (2 * count));
  return places;
}

} // namespace

std::vector<TextureSummary> summarise(std::span<const base::Image8* const> images) {
  struct Part {
    std::size_t image, first, texels;
  };
  std::vector<Part> parts;
  for (std::size_t i = 0; i < images.size(); ++i) {
    assert(images[i]->channels == 4);
    for (std::size_t first = 0; first < images[i]->pixelCount(); first += kGrainTexels)
      parts.push_back({i, first, std::min(kGrainTexels, images[i]->pixelCount() - first)});
  }
  std::vector<Counts32> counted(parts.size());
  base::parallelFor(parts.size(), 1, [&](std::size_t p, std::size_t) {
    Counts32 even{}, odd{};
    count(images[parts[p].image]->pixels.data() + 4 * parts[p].first, parts[p].texels, even, odd);
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t v = 0; v < 256; ++v) counted[p][c][v] = even[c][v] + odd[c][v];
  });
  std::vector<TextureSummary> summaries(images.size());
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t v = 0; v < 256; ++v) summaries[parts[p].image].counts[c][v] += counted[p][c][v];
  return summaries;
}

ValueRange rangeOf(const ValueCounts& counts, bool isColor) {
  const auto seen = [](std::uint64_t texels) { return texels > 0; };
  const auto first = std::ranges::find_if(counts, seen);
  assert(first != counts.end());
  std::size_t last = counts.size() - 1;
  while (counts[last] == 0) --last;
  double sum = 0, texels = 0;
  for (std::size_t v = 0; v < counts.size(); ++v) {
    sum += static_cast<double>(counts[v]) * valueOf(v, isColor);
    texels += static_cast<double>(counts[v]);
  }
  ValueRange range{valueOf(static_cast<std::size_t>(first - counts.begin()), isColor), valueOf(last, isColor), 0};
  // Of one value alone it is that value, without the rounding of a sum.
  range.mean = range.least == range.most ? range.least : sum / texels;
  return range;
}

base::Image8 makeThumbnail(const base::Image8& image, std::string_view channels, bool isColor) {
  const int longest = std::max(image.width, image.height);
  const auto sideOf = [&](int side) {
    return longest <= kThumbnailSide ? side : std::max(1, (side * kThumbnailSide + longest / 2) / longest);
  };
  base::Image8 out(sideOf(image.width), sideOf(image.height), static_cast<int>(channels.size()));
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(out.width));
  for (int x = 0; x < out.width; ++x)
    columns[static_cast<std::size_t>(x)] = spread(x * image.width / out.width, (x + 1) * image.width / out.width);
  for (int y = 0; y < out.height; ++y) {
    const std::vector<int> rows = spread(y * image.height / out.height, (y + 1) * image.height / out.height);
    for (int x = 0; x < out.width; ++x)
      for (std::size_t c = 0; c < channels.size(); ++c) {
        const std::size_t channel = placeOf(channels[c]);
        double sum = 0;
        for (const int row : rows)
          for (const int column : columns[static_cast<std::size_t>(x)])
            sum += valueOf(image.at(column, row)[channel], isColor);
        out.at(x, y)[c] =
            storedOf(sum / static_cast<double>(rows.size() * columns[static_cast<std::size_t>(x)].size()), isColor);
      }
  }
  return out;
}

} // namespace parity::job
