#include "compare/flip_rows.h"

#include <cmath>
#include <cstring>

namespace parity::compare {
namespace {

// Four lanes, by the compilers' vector extension: it keeps a block of accumulators in registers across the taps.
using Vec = float __attribute__((vector_size(16)));
constexpr std::size_t kLanes = 4, kVecs = static_cast<std::size_t>(kRowStep) / kLanes;

inline Vec load(const float* from) {
  Vec v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store(float* to, Vec v) { std::memcpy(to, &v, sizeof v); }

// A block of kRowStep neighbouring values.
struct Block {
  Vec v[kVecs];
};
inline Block loadBlock(const float* from) {
  Block b;
  for (std::size_t i = 0; i < kVecs; ++i) b.v[i] = load(from + i * kLanes);
  return b;
}
inline void storeBlock(float* to, const Block& b) {
  for (std::size_t i = 0; i < kVecs; ++i) store(to + i * kLanes, b.v[i]);
}
inline Block operator+(Block a, const Block& b) {
  for (std::size_t i = 0; i < kVecs; ++i) a.v[i] += b.v[i];
  return a;
}
inline Block operator-(Block a, const Block& b) {
  for (std::size_t i = 0; i < kVecs; ++i) a.v[i] -= b.v[i];
  return a;
}
inline Block operator*(float w, Block b) {
  for (std::size_t i = 0; i < kVecs; ++i) b.v[i] *= w;
  return b;
}

// Sum of weight(k) * (a(+k) + a(-k)), the centre once; tap(k) loads the block k steps away.
template <typename Tap> inline Block symmetric(const std::vector<float>& half, Tap tap) {
  Block sum = half[0] * tap(0);
  for (std::ptrdiff_t k = 1; k < static_cast<std::ptrdiff_t>(half.size()); ++k)
    sum = sum + half[static_cast<std::size_t>(k)] * (tap(k) + tap(-k));
  return sum;
}

// Sum of weight(k) * (a(+k) - a(-k)).
template <typename Tap> inline Block antisymmetric(const std::vector<float>& half, Tap tap) {
  Block sum = half[1] * (tap(1) - tap(-1));
  for (std::ptrdiff_t k = 2; k < static_cast<std::ptrdiff_t>(half.size()); ++k)
    sum = sum + half[static_cast<std::size_t>(k)] * (tap(k) - tap(-k));
  return sum;
}

// As symmetric(), for weights that sum to 0: taken relative to the centre, so that a constant gives exactly 0. (The
// feature difference is under a square root: noise of 1e-8 would show as 1e-4.)
template <typename Tap> inline Block symmetricZeroSum(const std::vector<float>& half, Tap tap) {
  const Block twice = 2.f * tap(0);
  Block sum = half[1] * (tap(1) + tap(-1) - twice);
  for (std::ptrdiff_t k = 2; k < static_cast<std::ptrdiff_t>(half.size()); ++k)
    sum = sum + half[static_cast<std::size_t>(k)] * (tap(k) + tap(-k) - twice);
  return sum;
}

inline std::size_t roundUp(std::size_t n) { return (n + kRowStep - 1) / kRowStep * kRowStep; }

} // namespace

int paddedRow(int width, int radius) {
  return static_cast<int>(roundUp(static_cast<std::size_t>(width)) + roundUp(2 * static_cast<std::size_t>(radius)));
}

RowFilter::RowFilter(const FlipFilters& filters, int width) : m_filters(filters), m_width(width) {
  const std::size_t padded = static_cast<std::size_t>(paddedRow(width, filters.radius));
  for (std::vector<float>& plane : m_planes) plane.assign(padded, 0.f);
  for (std::vector<float>* plane : {&m_out.y, &m_out.cx, &m_out.cz, &m_out.edge, &m_out.point})
    plane->assign(roundUp(static_cast<std::size_t>(width)), 0.f);
}

const FilteredRow& RowFilter::apply(const float* const* y, const float* const* cx, const float* const* cz) {
  filterAcrossRows(y, cx, cz);
  filterAlongRow();
  return m_out;
}

void RowFilter::filterAcrossRows(const float* const* y, const float* const* cx, const float* const* cz) {
  const FlipFilters& f = m_filters;
  // To the centre row: taps are then counted from it.
  y += f.radius, cx += f.radius, cz += f.radius;
  const std::size_t padded = m_planes[luma].size();
  for (std::size_t x = 0; x < padded; x += kRowStep) {
    const auto tapY = [&](std::ptrdiff_t k) { return loadBlock(y[k] + x); };
    const auto tapCx = [&](std::ptrdiff_t k) { return loadBlock(cx[k] + x); };
    const auto tapCz = [&](std::ptrdiff_t k) { return loadBlock(cz[k] + x); };
    storeBlock(&m_planes[luma][x], symmetric(f.luma, tapY));
    storeBlock(&m_planes[redGreen][x], symmetric(f.redGreen, tapCx));
    storeBlock(&m_planes[blueYellowA][x], symmetric(f.blueYellowA, tapCz));
    storeBlock(&m_planes[blueYellowB][x], symmetric(f.blueYellowB, tapCz));
    storeBlock(&m_planes[gauss][x], symmetric(f.gauss, tapY));
    storeBlock(&m_planes[edge][x], antisymmetric(f.edge, tapY));
    storeBlock(&m_planes[point][x], symmetricZeroSum(f.point, tapY));
  }
}

void RowFilter::filterAlongRow() {
  const FlipFilters& f = m_filters;
  const auto width = static_cast<std::size_t>(m_width);
  std::vector<float>&gaussOfEdge = m_out.edge, &gaussOfPoint = m_out.point;
  for (std::size_t x = 0; x < width; x += kRowStep) {
    const auto tap = [&](Plane plane) {
      const float* centre = m_planes[plane].data() + x + f.radius;
      return [centre](std::ptrdiff_t k) { return loadBlock(centre + k); };
    };
    storeBlock(&m_out.y[x], symmetric(f.luma, tap(luma)));
    storeBlock(&m_out.cx[x], symmetric(f.redGreen, tap(redGreen)));
    storeBlock(&m_out.cz[x], symmetric(f.blueYellowA, tap(blueYellowA)) + symmetric(f.blueYellowB, tap(blueYellowB)));

    const Block edgeX = antisymmetric(f.edge, tap(gauss)), edgeY = symmetric(f.gauss, tap(edge));
    const Block pointX = symmetricZeroSum(f.point, tap(gauss)), pointY = symmetric(f.gauss, tap(point));
    float edge2[kRowStep], point2[kRowStep];
    for (std::size_t i = 0; i < kVecs; ++i) {
      store(edge2 + i * kLanes, edgeX.v[i] * edgeX.v[i] + edgeY.v[i] * edgeY.v[i]);
      store(point2 + i * kLanes, pointX.v[i] * pointX.v[i] + pointY.v[i] * pointY.v[i]);
    }
    for (std::size_t i = 0; i < kRowStep; ++i) {
      gaussOfEdge[x + i] = std::sqrt(edge2[i]);
      gaussOfPoint[x + i] = std::sqrt(point2[i]);
    }
  }
}

} // namespace parity::compare
