// The reads of a cube: a block of a vector belongs to one frame. First its four lanes are four reads, of which the
// places are found; then they are the channels of a texel. All blocks take the same reads in the same order.
#include <algorithm>
#include <bit>
#include <cstdint>

#include "lighting/environment/cube_sampler.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lighting/environment/cube_sampler_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lighting/environment/simd_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace parity::lighting::HWY_NAMESPACE {

// All levels in one list of texels.
struct Levels {
  const float* texels;
  int faceSize, count;
};

// log2(x) for x in [1, 3], off by at most 0.006 (cubic through the Chebyshev nodes).
HWY_INLINE V log2Coarse(V x) {
  V sum = hn::Sub(hn::Mul(set(0.0708230f), x), set(0.6317424f));
  sum = hn::Add(hn::Mul(sum, x), set(2.3970716f));
  return hn::Sub(hn::Mul(sum, x), set(1.8303768f));
}

// Where directions hit; s and t in [-1, 1].
struct Points {
  VI face;
  V s, t, lod;
};

HWY_INLINE Points facePointsOf(const V (&v)[3], V sizeLog2, float last) {
  const D d;
  const DI di;
  const V zero = hn::Zero(d), minus[3] = {hn::Neg(v[0]), hn::Neg(v[1]), hn::Neg(v[2])};
  const auto isBelow = [&](int c) HWY_ATTR { return hn::Lt(v[c], zero); };
  const auto isAbove = [&](int c) HWY_ATTR { return hn::Gt(v[c], zero); };
  const V ax = hn::IfThenElse(isBelow(0), minus[0], v[0]), ay = hn::IfThenElse(isBelow(1), minus[1], v[1]),
          az = hn::IfThenElse(isBelow(2), minus[2], v[2]);
  const M isX = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az)), isY = hn::Ge(ay, az); // isY: where it is not X
  const V k = hn::Div(set(1.f), hn::IfThenElse(isX, ax, hn::IfThenElse(isY, ay, az)));
  Points p;
  const auto faceOf = [&](int first, int c) HWY_ATTR {
    return hn::IfThenElse(hn::RebindMask(di, isBelow(c)), hn::Set(di, first + 1), hn::Set(di, first));
  };
  p.face = hn::IfThenElse(hn::RebindMask(di, isX), faceOf(0, 0),
                          hn::IfThenElse(hn::RebindMask(di, isY), faceOf(2, 1), faceOf(4, 2)));
  const V sOfX = hn::IfThenElse(isAbove(0), minus[2], v[2]), sOfZ = hn::IfThenElse(isAbove(2), v[0], minus[0]);
  p.s = hn::Mul(hn::IfThenElse(isX, sOfX, hn::IfThenElse(isY, v[0], sOfZ)), k);
  const V tOfY = hn::IfThenElse(isAbove(1), v[2], minus[2]);
  p.t = hn::Mul(hn::IfThenElse(isX, minus[1], hn::IfThenElse(isY, tOfY, minus[1])), k);
  // A texel at (s, t) subtends (2/n)^2 (1 + s^2 + t^2)^(-3/2).
  const V stretch = hn::Add(hn::Add(set(1.f), hn::Mul(p.s, p.s)), hn::Mul(p.t, p.t));
  const V lod = hn::Add(sizeLog2, hn::Mul(set(0.75f), log2Coarse(stretch)));
  p.lod = hn::Min(hn::Max(lod, zero), set(last));
  return p;
}

// The four texels around a point of a level, and their shares.
struct Corners {
  alignas(64) std::int32_t upper[kLanes], lower[kLanes]; // the left texel of each row, counted in floats
  V left, right, top, bottom;
};

// faceSize: of the level. s, t: in [0, 1]. before: texels of all finer levels.
HWY_INLINE void findCorners(VI face, V s, V t, V faceSize, VI before, Corners& corners) {
  const D d;
  const DI di;
  // The middle of the rim's first texel lies at 0, that of the face's first at 1. A point is within 1e-7 of its range.
  const V x = hn::Max(hn::Add(hn::Mul(s, faceSize), set(0.5f)), hn::Zero(d)),
          y = hn::Max(hn::Add(hn::Mul(t, faceSize), set(0.5f)), hn::Zero(d));
  const VI x0 = hn::ConvertTo(di, x), y0 = hn::ConvertTo(di, y);
  corners.right = hn::Sub(x, hn::ConvertTo(d, x0));
  corners.bottom = hn::Sub(y, hn::ConvertTo(d, y0));
  corners.left = hn::Sub(set(1.f), corners.right);
  corners.top = hn::Sub(set(1.f), corners.bottom);
  const VI stride = hn::Add(hn::ConvertTo(di, faceSize), hn::Set(di, 2));
  const VI row = hn::Add(hn::Mul(face, stride), y0);
  const VI texel = hn::Add(before, hn::Add(hn::Mul(row, stride), x0));
  hn::Store(hn::ShiftLeft<2>(texel), di, corners.upper);
  hn::Store(hn::ShiftLeft<2>(hn::Add(texel, stride)), di, corners.lower);
}

// Of read `i` of each block.
template <int i> HWY_INLINE V bilinear(const float* texels, const Corners& at) {
  const D d;
  const auto row = [&](const float* from, const std::int32_t(&offsets)[kLanes]) HWY_ATTR {
    return loadBlocks(d, [&](std::size_t block) HWY_ATTR { return from + offsets[4 * block + i]; });
  };
  const V left = hn::Broadcast<i>(at.left), right = hn::Broadcast<i>(at.right);
  const V upper = hn::Add(hn::Mul(row(texels, at.upper), left), hn::Mul(row(texels + 4, at.upper), right));
  const V lower = hn::Add(hn::Mul(row(texels, at.lower), left), hn::Mul(row(texels + 4, at.lower), right));
  return hn::Add(hn::Mul(upper, hn::Broadcast<i>(at.top)), hn::Mul(lower, hn::Broadcast<i>(at.bottom)));
}

// Reads between the two nearest levels.
struct Between {
  Corners fine, coarse;
  V ofFine, ofCoarse;
  bool isFineAlone; // all reads: then the share of the coarse level is 0
};

HWY_INLINE void findLevels(const Levels& levels, const Points& p, Between& between) {
  const D d;
  const DI di;
  const VI level = hn::Min(hn::ConvertTo(di, p.lod), hn::Set(di, levels.count - 2));
  between.ofCoarse = hn::Sub(p.lod, hn::ConvertTo(d, level));
  between.ofFine = hn::Sub(set(1.f), between.ofCoarse);
  between.isFineAlone = hn::AllTrue(d, hn::Eq(between.ofCoarse, hn::Zero(d)));
  const V s = hn::Add(hn::Mul(p.s, set(0.5f)), set(0.5f)), t = hn::Add(hn::Mul(p.t, set(0.5f)), set(0.5f));
  // The exponent of a float makes the powers of two. Levels of n, n / 2 .. 2 m texels a side have together
  // 8 (n^2 - m^2) + 48 (n - m) + 24 log2(n / m) texels with their rims.
  const int n = levels.faceSize, exponent = 127 + levels.count - 1;
  const auto sizeOf = [&](VI l)
                          HWY_ATTR { return hn::BitCast(d, hn::ShiftLeft<23>(hn::Sub(hn::Set(di, exponent), l))); };
  const auto before = [&](VI l, V size) HWY_ATTR {
    const VI m = hn::ConvertTo(di, size), ofThis = hn::Mul(hn::ShiftLeft<3>(m), hn::Add(m, hn::Set(di, 6)));
    return hn::Add(hn::Sub(hn::Set(di, 8 * n * (n + 6)), ofThis), hn::Mul(l, hn::Set(di, 24)));
  };
  const V fine = sizeOf(level);
  findCorners(p.face, s, t, fine, before(level, fine), between.fine);
  if (between.isFineAlone) return;
  const VI next = hn::Add(level, hn::Set(di, 1));
  const V coarse = sizeOf(next);
  findCorners(p.face, s, t, coarse, before(next, coarse), between.coarse);
}

template <int i> HWY_INLINE V trilinear(const float* texels, const Between& between) {
  const V fine = bilinear<i>(texels, between.fine);
  if (between.isFineAlone) return fine;
  return hn::Add(hn::Mul(fine, hn::Broadcast<i>(between.ofFine)),
                 hn::Mul(bilinear<i>(texels, between.coarse), hn::Broadcast<i>(between.ofCoarse)));
}

// kBlocks frames at once.
HWY_INLINE void readSumsOfBlocks(const Levels& levels, const glm::mat3* const (&frames)[kBlocks],
                                 std::span<const FourReads> reads, glm::dvec3 (&totals)[kBlocks]) {
  const D d;
  V frame[3][3];
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c)
      frame[i][c] = fillBlocks(d, [&](std::size_t block) HWY_ATTR { return &(*frames[block])[i][c]; });
  const auto last = static_cast<float>(levels.count - 1);
  // In parts: the rounding of thousands of additions to one float would show.
  constexpr std::size_t kPart = 16;
  for (std::size_t begin = 0; begin < reads.size(); begin += kPart) {
    V sum = hn::Zero(d);
    for (const FourReads& four : reads.subspan(begin, std::min(kPart, reads.size() - begin))) {
      const auto repeat = [](const Float4& v) HWY_ATTR { return repeatBlock(reinterpret_cast<const float*>(&v)); };
      const V x = repeat(four.direction[0]), y = repeat(four.direction[1]), z = repeat(four.direction[2]);
      V direction[3];
      for (int c = 0; c < 3; ++c)
        direction[c] = hn::Add(hn::Add(hn::Mul(frame[0][c], x), hn::Mul(frame[1][c], y)), hn::Mul(frame[2][c], z));
      Between between;
      findLevels(levels, facePointsOf(direction, repeat(four.sizeLog2), last), between);
      const V weight = repeat(four.weight);
      sum = hn::Add(sum, hn::Mul(trilinear<0>(levels.texels, between), hn::Broadcast<0>(weight)));
      sum = hn::Add(sum, hn::Mul(trilinear<1>(levels.texels, between), hn::Broadcast<1>(weight)));
      sum = hn::Add(sum, hn::Mul(trilinear<2>(levels.texels, between), hn::Broadcast<2>(weight)));
      sum = hn::Add(sum, hn::Mul(trilinear<3>(levels.texels, between), hn::Broadcast<3>(weight)));
    }
    alignas(64) float lanes[kLanes];
    hn::Store(sum, d, lanes);
    for (std::size_t block = 0; block < kBlocks; ++block)
      totals[block] += glm::dvec3(lanes[4 * block], lanes[4 * block + 1], lanes[4 * block + 2]);
  }
}

void ReadSums(const float* texels, int faceSize, std::span<const glm::mat3> frames, std::span<const FourReads> reads,
              std::span<glm::vec3> sums) {
  const Levels levels{texels, faceSize, static_cast<int>(std::bit_width(static_cast<unsigned>(faceSize)))};
  for (std::size_t begin = 0; begin < frames.size(); begin += kBlocks) {
    const glm::mat3* blocks[kBlocks]; // what is left over repeats the last
    for (std::size_t i = 0; i < kBlocks; ++i) blocks[i] = &frames[std::min(begin + i, frames.size() - 1)];
    glm::dvec3 totals[kBlocks];
    for (glm::dvec3& total : totals) total = glm::dvec3(0.0);
    readSumsOfBlocks(levels, blocks, reads, totals);
    for (std::size_t i = 0; i < std::min(kBlocks, frames.size() - begin); ++i) sums[begin + i] = glm::vec3(totals[i]);
  }
}

} // namespace parity::lighting::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::lighting {
namespace {

HWY_EXPORT(ReadSums);

} // namespace

void CubeSampler::readSums(std::span<const glm::mat3> frames, std::span<const FourReads> reads,
                           std::span<glm::vec3> sums) const {
  HWY_DYNAMIC_DISPATCH(ReadSums)(&m_levels.front().x, m_faceSize, frames, reads, sums);
}

} // namespace parity::lighting
#endif
