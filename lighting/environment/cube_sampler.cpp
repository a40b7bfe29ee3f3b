// Trilinear reading of a cube map on the CPU, without seams.
#include "lighting/environment/cube_sampler.h"

#include <algorithm>
#include <array>
#include <utility>

namespace parity::lighting {

CubeLevel makeCubeLevel(const std::vector<glm::vec4>& mip, int n) {
  CubeLevel level;
  level.stride = n + 2;
  const auto indexOf = [&](int face, int x, int y) {
    return (static_cast<std::size_t>(face) * level.stride + y + 1) * level.stride + x + 1;
  };
  level.faces.resize(static_cast<std::size_t>(kCubeFaces) * level.stride * level.stride);
  const double inside = 1 - 1.0 / n; // middle of the outermost texels
  const auto neighbour = [&](int face, double s, double t) {
    // The edge's point, moved back behind this face by half a texel: the middle of the texel across the edge.
    glm::dvec3 d = directionOf({face, s, t});
    d[face / 2] *= inside;
    const FacePoint p = lighting::facePointOf(d);
    const auto texel = [n](double c) { return std::min(n - 1, static_cast<int>((c + 1) / 2 * n)); };
    return mip[texelIndex(p.face, texel(p.s), texel(p.t), n)];
  };
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) level.faces[indexOf(face, x, y)] = mip[texelIndex(face, x, y, n)];
    for (int i = 0; i < n; ++i) {
      const double c = texelCenter(i, n);
      level.faces[indexOf(face, -1, i)] = neighbour(face, -1, c);
      level.faces[indexOf(face, n, i)] = neighbour(face, 1, c);
      level.faces[indexOf(face, i, -1)] = neighbour(face, c, -1);
      level.faces[indexOf(face, i, n)] = neighbour(face, c, 1);
    }
    for (const int x : {-1, n})
      for (const int y : {-1, n}) {
        const int innerX = x < 0 ? 0 : n - 1, innerY = y < 0 ? 0 : n - 1;
        const glm::dvec4 sum = glm::dvec4(level.faces[indexOf(face, innerX, innerY)]) +
                               glm::dvec4(level.faces[indexOf(face, x, innerY)]) +
                               glm::dvec4(level.faces[indexOf(face, innerX, y)]);
        level.faces[indexOf(face, x, y)] = glm::vec4(sum / 3.0);
      }
  }
  return level;
}

CubeSampler::CubeSampler(std::vector<glm::vec4> base, int faceSize) : m_faceSize(faceSize) {
  std::vector<glm::vec4> mip = std::move(base);
  std::size_t texels = 0;
  for (int n = faceSize; n > 0; n /= 2) texels += static_cast<std::size_t>(kCubeFaces) * (n + 2) * (n + 2);
  m_levels.reserve(texels);
  for (int n = faceSize;; n /= 2) {
    const CubeLevel level = makeCubeLevel(mip, n);
    m_levels.insert(m_levels.end(), level.faces.begin(), level.faces.end());
    if (n == 1) break;
    mip = halveMip(mip, n);
  }
}

std::vector<FourReads> packReads(const std::vector<WeightedRead>& reads) {
  std::vector<FourReads> packed((reads.size() + 3) / 4);
  for (std::size_t i = 0; i < 4 * packed.size(); ++i) {
    // What is left over of the last four repeats the first read at no weight.
    const WeightedRead& read = reads[i < reads.size() ? i : 0];
    FourReads& four = packed[i / 4];
    for (int c = 0; c < 3; ++c) four.direction[c][i % 4] = read.direction[c];
    four.sizeLog2[i % 4] = read.sizeLog2;
    four.weight[i % 4] = i < reads.size() ? read.weight : 0;
  }
  return packed;
}

glm::vec3 CubeSampler::readSum(const glm::mat3& frame, std::span<const FourReads> reads) const {
  glm::vec3 sum;
  readSums({&frame, 1}, reads, {&sum, 1});
  return sum;
}

} // namespace parity::lighting
