// Trilinear reading of a cube map on the CPU, without seams.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "lighting/cube.h"

namespace parity::lighting {

// A cube with all mips down to 1x1, each face with a rim of its neighbours' texels: bilinear reading goes on across
// edges, as Vulkan's does, and where three faces meet it takes the mean of the three corner texels.
class CubeSampler {
public:
  // base: six faces of faceSize^2 texels (a power of two).
  CubeSampler(std::vector<glm::vec4> base, int faceSize);

  int levelCount() const { return static_cast<int>(m_levels.size()); }

  // direction: any length but 0. level: 0 .. levelCount() - 2; blends it with the next by `blend` in [0, 1].
  glm::vec4 sample(const glm::vec3& direction, float lod) const;

private:
  struct Level {
    int stride = 0;               // texels a row: the face's and 2
    std::vector<glm::vec4> faces; // six times stride^2
  };
  static Level makeLevel(const std::vector<glm::vec4>& mip, int n);

  std::vector<Level> m_levels;
};

} // namespace parity::lighting
