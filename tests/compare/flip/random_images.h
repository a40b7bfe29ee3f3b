// Images of many kinds for property tests, each the same for the same seed.
#pragma once

#include <array>
#include <cmath>
#include <random>

#include "base/image/image.h"

namespace parity::test {

// noise: independent values; noise8: whole 255ths; smooth: gradients and waves, with small differences from seed to
// seed; halves: two flat fields; dark: values below the transfer function's straight part.
enum class Kind { noise, noise8, smooth, halves, dark };
inline constexpr std::array kKinds = {Kind::noise, Kind::noise8, Kind::smooth, Kind::halves, Kind::dark};

inline base::Image makeImage(Kind kind, int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.f, 1.f);
  base::Image image(width, height, 3);
  const float phase = uniform(random), bias = 0.1f * uniform(random);
  const std::array<float, 6> flat = {uniform(random), uniform(random), uniform(random),
                                     uniform(random), uniform(random), uniform(random)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
        const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
        float value = uniform(random);
        if (kind == Kind::noise8) value = std::round(value * 255.f) / 255.f;
        if (kind == Kind::dark) value *= 0.06f;
        if (kind == Kind::smooth)
          value = 0.45f + 0.4f * std::sin(7.f * u + static_cast<float>(c) + 5.f * v * u + 0.2f * phase) + bias;
        if (kind == Kind::halves) value = flat[static_cast<std::size_t>(c + (u + v < 1.f ? 0 : 3))];
        image.at(x, y)[c] = value;
      }
  return image;
}

// Linear light over `stops` stops below 4, with highlights.
inline base::Image makeHdrImage(int width, int height, unsigned seed, float stops = 12) {
  base::Image image = makeImage(Kind::noise, width, height, seed);
  const base::Image wave = makeImage(Kind::smooth, width, height, seed + 1);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = std::exp2(2.f - stops * (0.3f * image.pixels[i] + 0.7f * (1.f - wave.pixels[i])));
  return image;
}

} // namespace parity::test
