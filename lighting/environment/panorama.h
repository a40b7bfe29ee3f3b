// An equirectangular panorama as it is resampled and integrated: in columns, checked, at a width that suits a cube.
#pragma once

#include <numbers>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::lighting {

// The azimuth atan2(z, x), in radians, in the panorama of what is seen at azimuth `a` in the world: the environment is
// turned by +rotationDeg about +Y (right-handed: +Z goes to +X at 90 degrees), as glm::rotate does.
double panoramaAzimuth(double a, float rotationDeg);

// Throws base::Error (exit 4) where the radiance is empty, has not 3 channels, or holds a value that is negative or not
// finite, and for a rotation that is not finite.
void checkRadiance(const scenes::Environment& environment);

// Bilinear, wrapped around horizontally and clamped at the poles; values above 1e30 taken as 1e30. x, y in texels of
// the panorama, the middle of the first at 0.5.
glm::vec3 interpolateRadiance(const base::Image& image, double x, double y);

// Cells of constant radiance (linear Rec.709) in columns, each from +Y down, turned as told.
struct Panorama {
  int width = 0, height = 0;
  std::vector<glm::vec3> columns;
  std::vector<double> rowY; // height + 1 bounds of the rows, cos(theta): 1 .. -1
  float rotationDeg = 0;

  const glm::vec3* column(long long i) const {
    const long long wrapped = ((i % width) + width) % width;
    return columns.data() + static_cast<std::size_t>(wrapped) * height;
  }
  // In columns; grows with the azimuth (radians, world) without wrapping around.
  double columnAt(double azimuth) const {
    return (azimuth + rotation() + std::numbers::pi) / (2 * std::numbers::pi) * width;
  }
  double azimuthAt(double columnPosition) const {
    return columnPosition / width * 2 * std::numbers::pi - std::numbers::pi - rotation();
  }
  double rotation() const { return panoramaAzimuth(0, rotationDeg); }
};

// Between about 4 and 16 columns for each of a face's: fewer would show as blocks, more would only cost time. What is
// coarser is interpolated bilinearly, what is finer is averaged over solid angle. Throws
// as checkRadiance does. Values above 1e30 are taken
// as 1e30, so that no sum overflows.
Panorama makePanorama(const scenes::Environment& environment, int faceSize);

} // namespace parity::lighting
