// FLIP at 8K: windows drawn at random are the oracle's, wherever they lie in the image.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "compare/flip/flip.h"
#include "flip_oracle.h"

namespace parity::compare {
namespace {

// Cheap, of all frequencies, different for every place and seed.
base::Image8 makeImage(int width, int height, unsigned seed) {
  base::Image8 image(width, height, 3);
  unsigned state = seed;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      state = state * 1664525u + 1013904223u;
      std::uint8_t* pixel = image.at(x, y);
      pixel[0] = static_cast<std::uint8_t>((x / 3 + y) % 200 + static_cast<int>(state >> 26));
      pixel[1] = static_cast<std::uint8_t>((x * x / 512 + y / 2) % 180 + static_cast<int>(state >> 27));
      pixel[2] = static_cast<std::uint8_t>((x + 2 * y) / 5 % 160 + static_cast<int>(state >> 28));
    }
  return image;
}

base::Image crop(const base::Image8& image, const Rect& rect) {
  base::Image out(rect.width, rect.height, 3);
  for (int y = 0; y < rect.height; ++y)
    for (int i = 0; i < 3 * rect.width; ++i)
      out.at(0, y)[i] = static_cast<float>(image.at(rect.x, rect.y + y)[i]) / 255.f;
  return out;
}

TEST(FlipLarge, WindowsOfAn8kPairAreTheOracles) {
  constexpr int kWidth = 7680, kHeight = 4320, kSide = 24;
  const base::Image8 reference = makeImage(kWidth, kHeight, 1), test = makeImage(kWidth, kHeight, 2);
  const base::Image map = flipMap(reference, test);
  const int radius = flipFilterRadius({});
  std::mt19937 random(8);
  for (int round = 0; round < 16; ++round) {
    // The first four in the corners, where the image's own borders are replicated.
    const int x = round < 4 ? (round % 2) * (kWidth - kSide) : static_cast<int>(random() % (kWidth - kSide));
    const int y = round < 4 ? (round / 2) * (kHeight - kSide) : static_cast<int>(random() % (kHeight - kSide));
    const int left = std::max(0, x - radius), top = std::max(0, y - radius);
    const Rect around = {left, top, std::min(kWidth, x + kSide + radius) - left,
                         std::min(kHeight, y + kSide + radius) - top};
    const std::vector<double> exact =
        oracle::flip(crop(reference, around), crop(test, around), static_cast<double>(kDefaultPixelsPerDegree)).flip;
    for (int v = 0; v < kSide; ++v)
      for (int u = 0; u < kSide; ++u)
        ASSERT_NEAR(static_cast<double>(*map.at(x + u, y + v)),
                    exact[static_cast<std::size_t>((y - top + v) * around.width + (x - left + u))], 2e-5)
            << x + u << ", " << y + v;
  }
}

} // namespace
} // namespace parity::compare
