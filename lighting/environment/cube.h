// The geometry of a cube map in Vulkan's layout: directions, texels, solid angles; and its mips by exact averaging.
#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "lighting/environment/environment_light.h"

namespace parity::lighting {

// Order of the faces: +X -X +Y -Y +Z -Z (Vulkan 1.3 specification, "Cube Map Face Selection and Transformations").
inline constexpr int kCubeFaces = 6;

// A point of a cube face: s to the right and t down, both in [-1, 1].
struct FacePoint {
  int face = 0;
  double s = 0, t = 0;
};

// The direction, not normalised (its largest component is +-1), of a face's point.
glm::dvec3 directionOf(const FacePoint& point);

// The face that a direction hits, and where. direction: not zero, any length.
FacePoint facePointOf(const glm::dvec3& direction);

// Coordinate in [-1, 1] of the middle of texel i of n.
constexpr double texelCenter(int i, int n) { return (2.0 * i + 1.0) / n - 1.0; }

// Texel (x, y) of a face whose mip is n texels wide.
inline glm::dvec3 texelDirection(int face, int x, int y, int n) {
  return glm::normalize(directionOf({face, texelCenter(x, n), texelCenter(y, n)}));
}

// Index into CubeMap::mips[m] of a texel.
constexpr std::size_t texelIndex(int face, int x, int y, int n) {
  return (static_cast<std::size_t>(face) * n + y) * n + x;
}

// Solid angles in steradian of one face's n x n texels, row by row; the same for every face. The six sum to 4 pi.
std::vector<double> texelSolidAngles(int n);

// Halves a cube's mip of `n` texels a side: each texel is the mean of four, weighted by their solid angles.
std::vector<glm::vec4> halveMip(const std::vector<glm::vec4>& mip, int n);

} // namespace parity::lighting
