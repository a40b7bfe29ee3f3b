// The quad with a normal map of random slopes.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "support/small_scenes.h"

namespace parity::tests {

// A normal map of size x size texels whose slopes are Gaussian with this deviation along each axis.
inline scenes::TextureImage makeBumps(int size, double slopeDeviation) {
  scenes::TextureImage image;
  image.name = "bumps";
  image.pixels = base::Image8(size, size, 4, 255);
  std::mt19937 random(17);
  std::normal_distribution<double> slope(0, slopeDeviation);
  for (std::size_t t = 0; t < image.pixels.pixelCount(); ++t) {
    const double x = slope(random), y = slope(random);
    const glm::dvec3 n = glm::normalize(glm::dvec3(-x, -y, 1));
    for (int c = 0; c < 3; ++c)
      image.pixels.pixels[4 * t + c] = static_cast<std::uint8_t>(std::lround(127.5 * (n[c] + 1)));
  }
  return image;
}

// Texels tilted to either side in turn, so that their mean is upright.
inline scenes::TextureImage makeChecker(int size) {
  scenes::TextureImage image;
  image.name = "checker";
  image.pixels = base::Image8(size, size, 4, 255);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const std::uint8_t texel[] = {static_cast<std::uint8_t>((x + y) % 2 ? 88 : 167), 128, 248};
      std::copy_n(texel, 3, image.pixels.at(x, y));
    }
  return image;
}

inline scenes::Scene makeBumpyQuad(int size, double slopeDeviation, float roughness) {
  scenes::Scene scene = makeQuadScene();
  scene.images = {makeBumps(size, slopeDeviation)};
  scenes::Material& material = scene.materials[0];
  material.normalTexture.image = 0;
  material.roughness = roughness;
  return scene;
}

} // namespace parity::tests
