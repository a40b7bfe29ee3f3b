// Trilinear reading of a cube map on the CPU, without seams.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "lighting/environment/cube.h"
#include "lighting/environment/float4.h"

namespace parity::lighting {

// A mip of a cube, its faces with a rim of their neighbours' texels: bilinear reading goes on across edges, as Vulkan's
// does, and where three faces meet it takes the mean of the three corner texels.
struct CubeLevel {
  int stride = 0;               // texels a row: the face's and 2
  std::vector<glm::vec4> faces; // six times stride^2
};

// mip: six faces of n^2 texels.
CubeLevel makeCubeLevel(const std::vector<glm::vec4>& mip, int n);

// One reading of many: a direction in some frame, the size of what is to be averaged there, and its weight in the sum.
struct WeightedRead {
  glm::vec3 direction{0.f};
  float sizeLog2 = 0; // log2 of the width of the footprint, sqrt(solid angle), over that of a base texel at a face's
                      // middle, 2 / faceSize
  float weight = 0;
};

// Four of them side by side.
struct FourReads {
  std::array<Float4, 3> direction;
  Float4 sizeLog2, weight;
};
std::vector<FourReads> packReads(const std::vector<WeightedRead>& reads);

// A cube with all mips down to 1x1.
class CubeSampler {
public:
  // base: six faces of faceSize^2 texels (a power of two, at least 2).
  CubeSampler(std::vector<glm::vec4> base, int faceSize);

  int faceSize() const { return m_faceSize; }

  // The weighted sum of the radiance in many directions, turned by each of `frames`: each from the mip whose texels
  // there are 2^sizeLog2 times as wide as a base texel at a face's middle. Texels towards a face's corners are smaller
  // by up to 3^(3/4): a finer mip at the middle serves the same size at a corner. Finite where all texels and their sum
  // are. sums: one for each frame; it does not depend on the other frames, nor on the processor.
  void readSums(std::span<const glm::mat3> frames, std::span<const FourReads> reads, std::span<glm::vec3> sums) const;
  glm::vec3 readSum(const glm::mat3& frame, std::span<const FourReads> reads) const;

private:
  int m_faceSize;
  std::vector<glm::vec4> m_levels; // CubeLevel::faces of one after the other, the finest first
};

} // namespace parity::lighting
