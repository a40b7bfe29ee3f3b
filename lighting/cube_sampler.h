// Trilinear reading of a cube map on the CPU, without seams.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "lighting/cube.h"

namespace parity::lighting {

// One reading of many: a direction in some frame, the size of what is to be averaged there, and its weight in the sum.
struct WeightedRead {
  glm::vec3 direction{0.f};
  float sizeLog2 = 0; // log2 of the width of the footprint, sqrt(solid angle), over that of a base texel at a face's
                      // middle, 2 / faceSize
  float weight = 0;
};

// A cube with all mips down to 1x1, each face with a rim of its neighbours' texels: bilinear reading goes on across
// edges, as Vulkan's does, and where three faces meet it takes the mean of the three corner texels.
class CubeSampler {
public:
  // base: six faces of faceSize^2 texels (a power of two, at least 2).
  CubeSampler(std::vector<glm::vec4> base, int faceSize);

  // The radiance in a direction (any length but 0) at the mip whose texels there are 2^sizeLog2 times as wide as a base
  // texel at a face's middle. Texels towards a face's corners are smaller by up to 3^(3/4): a finer mip at the middle
  // serves the same size at a corner.
  glm::vec3 read(const glm::vec3& direction, float sizeLog2) const;

  // The weighted sum of many, their directions turned by `frame`. Finite where all texels and their sum are.
  glm::vec3 readSum(const glm::mat3& frame, std::span<const WeightedRead> reads) const;

private:
  struct Level {
    int stride = 0;               // texels a row: the face's and 2
    std::vector<glm::vec4> faces; // six times stride^2
  };
  static Level makeLevel(const std::vector<glm::vec4>& mip, int n);

  std::vector<Level> m_levels;
};

} // namespace parity::lighting
