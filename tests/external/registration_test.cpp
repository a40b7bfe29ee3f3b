// Planted shifts, scales and turns of pictures are found and put right.
#include "external/registration.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace parity::external {
namespace {

// Discs of a scene, drawn exactly at any place: each pixel is the mean of 5 x 5 samples.
base::Image draw(const Placement& placement, unsigned seed, bool otherShading = false, int size = 128) {
  struct Disc {
    double x, y, radius;
    float color[3];
  };
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.42 * size, 0.42 * size), radius(4, 12), light(0.05, 0.9);
  std::vector<Disc> discs;
  for (int i = 0; i < 16; ++i)
    discs.push_back(
        {place(random),
         place(random),
         radius(random),
         {static_cast<float>(light(random)), static_cast<float>(light(random)), static_cast<float>(light(random))}});
  base::Image image(size, size, 3);
  const double c = 0.5 * (size - 1), angle = placement.rotationDeg * M_PI / 180;
  constexpr int kSub = 5;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (int s = 0; s < kSub * kSub; ++s) {
        const double px = x - c + (s % kSub + 0.5) / kSub - 0.5 - placement.dx,
                     py = y - c + (s / kSub + 0.5) / kSub - 0.5 - placement.dy;
        // Where it lies on the view: the inverse of the placement.
        double vx = (std::cos(angle) * px + std::sin(angle) * py) / placement.scale;
        const double vy = (-std::sin(angle) * px + std::cos(angle) * py) / placement.scale;
        if (placement.mirrored) vx = -vx;
        const float* color = nullptr;
        for (const Disc& disc : discs)
          if (std::hypot(vx - disc.x, vy - disc.y) < disc.radius) color = disc.color;
        for (int k = 0; k < 3; ++k) {
          float value = color ? color[k] : 0.18f;
          if (color && otherShading) // another engine's: brighter to one side
            value = value * static_cast<float>(0.7 + 0.004 * (vx + vy)) + 0.02f;
          image.at(x, y)[k] += value / (kSub * kSub);
        }
      }
  return image;
}

TEST(Registration, PlantedShiftsAreFoundWithinATwentiethOfAPixel) {
  const base::Image view = edgesOf(draw({}, 1));
  for (const auto& [dx, dy] : {std::pair(0.0, 0.0), std::pair(0.25, -0.1), std::pair(-0.5, 0.5), std::pair(0.8, 0.33),
                               std::pair(1.0, -1.0), std::pair(-7.3, 11.6)}) {
    const Shift shift = findShift(edgesOf(draw({.dx = dx, .dy = dy}, 1)), view);
    EXPECT_NEAR(shift.dx, dx, 0.05) << dx << " " << dy;
    EXPECT_NEAR(shift.dy, dy, 0.05) << dx << " " << dy;
    EXPECT_GT(shift.likeness, 0.9);
  }
}

TEST(Registration, AnotherShadingMovesNothing) {
  const base::Image view = edgesOf(draw({}, 2));
  for (const double d : {0.0, 0.3, 0.7}) {
    const Shift shift = findShift(edgesOf(draw({.dx = d, .dy = -d}, 2, true)), view);
    EXPECT_NEAR(shift.dx, d, 0.05) << d;
    EXPECT_NEAR(shift.dy, -d, 0.05) << d;
    EXPECT_GT(shift.likeness, 0.8);
  }
}

TEST(Registration, AnotherSceneIsUnlike) {
  for (unsigned seed = 10; seed < 14; ++seed)
    EXPECT_LT(findShift(edgesOf(draw({}, seed)), edgesOf(draw({}, seed + 100))).likeness, 0.25) << seed;
}

TEST(Registration, ShiftsArePutRight) {
  const base::Image view = draw({}, 3), moved = draw({.dx = 0.4, .dy = -0.3}, 3);
  const base::Image back = placedOnView(moved, {.dx = 0.4, .dy = -0.3});
  const auto error = [&](const base::Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) sum += std::abs(image.pixels[i] - view.pixels[i]);
    return sum;
  };
  EXPECT_LT(error(back), 0.4 * error(moved)) << "no filter brings edges back that lie within a pixel";
}

TEST(Registration, ScaleTurnAndMirrorArePutRight) {
  const base::Image view = draw({}, 4);
  for (const Placement& each : {Placement{.scale = 1.02}, Placement{.rotationDeg = 3}, Placement{.mirrored = true},
                                Placement{.dx = 2, .dy = 1, .scale = 0.98, .rotationDeg = -2}}) {
    const base::Image back = placedOnView(draw(each, 4), each);
    const Shift shift = findShift(edgesOf(back), edgesOf(view));
    EXPECT_NEAR(shift.dx, 0, 0.05);
    EXPECT_NEAR(shift.dy, 0, 0.05);
    EXPECT_GT(shift.likeness, 0.85);
  }
}

} // namespace
} // namespace parity::external
