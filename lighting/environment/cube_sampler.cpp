// Trilinear reading of a cube map on the CPU, without seams.
#include "lighting/environment/cube_sampler.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "lighting/environment/float4.h"

namespace parity::lighting {

namespace {

Float4 load(const glm::vec4* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

struct FloatFacePoint {
  int face;
  float s, t; // [-1, 1]
};

// log2(x) for x in [1, 3], off by at most 0.006 (cubic through the Chebyshev nodes).
template <typename T> T log2Coarse(T x) { return ((0.0708230f * x - 0.6317424f) * x + 2.3970716f) * x - 1.8303768f; }

// faces: a level with its rim, n + 2 texels a row.
Float4 bilinear(const glm::vec4* faces, int stride, const FloatFacePoint& p) {
  const float n = static_cast<float>(stride - 2);
  // The middle of the rim's first texel lies at 0, that of the face's first at 1. p is within 1e-7 of [-1, 1].
  const float x = std::max((p.s * 0.5f + 0.5f) * n + 0.5f, 0.f), y = std::max((p.t * 0.5f + 0.5f) * n + 0.5f, 0.f);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const glm::vec4* row = faces + (static_cast<std::size_t>(p.face) * stride + y0) * stride + x0;
  const Float4 upper = load(row) * (1 - fx) + load(row + 1) * fx;
  const Float4 lower = load(row + stride) * (1 - fx) + load(row + stride + 1) * fx;
  return upper * (1 - fy) + lower * fy;
}

// Between the two nearest of `levels`; lod within them.
Float4 trilinear(const std::vector<CubeLevel>& levels, const FloatFacePoint& p, float lod) {
  const std::size_t level = std::min(static_cast<std::size_t>(lod), levels.size() - 2);
  const float blend = lod - static_cast<float>(level);
  const auto& fine = levels[level];
  const auto& coarse = levels[level + 1];
  return bilinear(fine.faces.data(), fine.stride, p) * (1 - blend) +
         bilinear(coarse.faces.data(), coarse.stride, p) * blend;
}

// Four directions at once: where they hit, and at which of the levels 0..last.
struct FourPoints {
  Int4 face;
  Float4 s, t, lod;
};

FourPoints facePointsOf(const std::array<Float4, 3>& d, const Float4& sizeLog2, float last) {
  const Float4 ax = d[0] < 0 ? -d[0] : d[0], ay = d[1] < 0 ? -d[1] : d[1], az = d[2] < 0 ? -d[2] : d[2];
  const Int4 isX = (ax >= ay) & (ax >= az), isY = ~isX & (ay >= az);
  const Float4 k = 1 / (isX ? ax : isY ? ay : az);
  FourPoints p;
  p.face = isX ? -(d[0] < 0) : isY ? 2 - (d[1] < 0) : 4 - (d[2] < 0); // a comparison that holds is -1
  p.s = (isX ? (d[0] > 0 ? -d[2] : d[2]) : isY ? d[0] : d[2] > 0 ? d[0] : -d[0]) * k;
  p.t = (isY ? (d[1] > 0 ? d[2] : -d[2]) : -d[1]) * k;
  // A texel at (s, t) subtends (2/n)^2 (1 + s^2 + t^2)^(-3/2).
  const Float4 lod = sizeLog2 + 0.75f * log2Coarse(1 + p.s * p.s + p.t * p.t);
  p.lod = lod < 0 ? Float4{} : lod > last ? Float4{} + last : lod;
  return p;
}

} // namespace

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

CubeSampler::CubeSampler(std::vector<glm::vec4> base, int faceSize) {
  std::vector<glm::vec4> mip = std::move(base);
  for (int n = faceSize;; n /= 2) {
    m_levels.push_back(makeCubeLevel(mip, n));
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
  // In parts: the rounding of thousands of additions to one float would show.
  constexpr std::size_t kPart = 16;
  const auto last = static_cast<float>(m_levels.size() - 1);
  glm::dvec3 total{0.0};
  for (std::size_t begin = 0; begin < reads.size(); begin += kPart) {
    Float4 sum{};
    for (const FourReads& four : reads.subspan(begin, std::min(kPart, reads.size() - begin))) {
      std::array<Float4, 3> direction;
      for (int c = 0; c < 3; ++c)
        direction[c] =
            frame[0][c] * four.direction[0] + frame[1][c] * four.direction[1] + frame[2][c] * four.direction[2];
      const FourPoints points = facePointsOf(direction, four.sizeLog2, last);
      for (int i = 0; i < 4; ++i)
        sum += trilinear(m_levels, {points.face[i], points.s[i], points.t[i]}, points.lod[i]) * four.weight[i];
    }
    total += glm::dvec3(sum[0], sum[1], sum[2]);
  }
  return glm::vec3(total);
}

} // namespace parity::lighting
