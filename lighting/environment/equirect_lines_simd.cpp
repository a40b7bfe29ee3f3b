// Borders of many texels at once; then cell by cell the light and the weight of all lines at once.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <functional>

#include "lighting/environment/equirect_lines.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lighting/environment/equirect_lines_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace parity::lighting::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using DD = hn::ScalableTag<double>;

// x / sqrt(1 + x^2) with x = steps[i] * factor.
HWY_INLINE void sinesOf(const LineShape& shape, double factor, double* sines) {
  const DD d;
  const auto one = hn::Set(d, 1.0), scale = hn::Set(d, factor);
  for (int i = 0; i < shape.texels; i += static_cast<int>(hn::Lanes(d))) {
    const auto x = hn::Mul(hn::LoadU(d, shape.steps.data() + i), scale);
    hn::StoreU(hn::Div(x, hn::Sqrt(hn::Add(one, hn::Mul(x, x)))), d, sines + i);
  }
}

// 1 / sqrt(1 + x^2).
HWY_INLINE void cosinesOf(const LineShape& shape, double factor, double* cosines) {
  const DD d;
  const auto one = hn::Set(d, 1.0), scale = hn::Set(d, factor);
  for (int i = 0; i < shape.texels; i += static_cast<int>(hn::Lanes(d))) {
    const auto x = hn::Mul(hn::LoadU(d, shape.steps.data() + i), scale);
    hn::StoreU(hn::Div(one, hn::Sqrt(hn::Add(one, hn::Mul(x, x)))), d, cosines + i);
  }
}

using Double4 = double __attribute__((vector_size(32)));

// The lines' cells, one after the other, into the lines' sums of one texel.
template <int count> class Sums {
public:
  HWY_INLINE explicit Sums(const CellLine* lines) : m_lines(lines) {}
  HWY_INLINE void load(const Gathered* texel) { std::memcpy(m_sums, texel, sizeof m_sums); }
  HWY_INLINE void store(Gathered* texel) const { std::memcpy(static_cast<void*>(texel), m_sums, sizeof m_sums); }
  HWY_INLINE void add(double weight, int row) {
    for (int k = 0; k < count; ++k) {
      const glm::vec3& cell = m_lines[k].first[m_lines[k].step * row];
      m_sums[k] += weight * Double4{cell.x, cell.y, cell.z, 1};
    }
  }

private:
  static_assert(sizeof(Gathered) == sizeof(Double4));
  const CellLine* m_lines;
  Double4 m_sums[count];
};

template <int count> HWY_INLINE void alongMeridian(const LineShape& shape, double cosine, double weight,
                                                   const CellLine* lines, Gathered* gathered) {
  const double* rowY = shape.rowY.data();
  sinesOf(shape, cosine, shape.borders.data());
  double y = cosine / std::sqrt(1 + cosine * cosine);
  int row = static_cast<int>(std::upper_bound(shape.rowY.begin(), shape.rowY.end(), y, std::greater<>()) -
                             shape.rowY.begin()) -
            1;
  Sums<count> sums(lines);
  for (int i = 0; i < shape.texels; ++i) {
    const double bottom = -shape.borders[i];
    sums.load(gathered + i * count);
    for (; rowY[row + 1] > bottom; ++row) {
      sums.add(weight * (y - rowY[row + 1]), row);
      y = rowY[row + 1];
    }
    sums.add(weight * (y - bottom), row);
    sums.store(gathered + i * count);
    y = bottom;
  }
}

template <int count> HWY_INLINE void alongRay(const LineShape& shape, double stepX, double stepZ, double weight,
                                              const CellLine* lines, Gathered* gathered) {
  const double* rowY = shape.rowY.data();
  double *const bordersX = shape.borders.data(), *const bordersZ = bordersX + shape.texels + kLinePadding;
  cosinesOf(shape, stepX, bordersX);
  cosinesOf(shape, stepZ, bordersZ);
  Sums<count> sums(lines);
  double y = 1;
  for (int x = 0, z = 0, row = 0; x < shape.texels && z < shape.texels;) {
    const bool isX = shape.steps[x] * stepX <= shape.steps[z] * stepZ;
    const double bottom = isX ? bordersX[x] : bordersZ[z];
    Gathered* const texel = gathered + (z * shape.texels + x) * count;
    sums.load(texel);
    for (; rowY[row + 1] > bottom; ++row) {
      sums.add(weight * (y - rowY[row + 1]), row);
      y = rowY[row + 1];
    }
    sums.add(weight * (y - bottom), row);
    sums.store(texel);
    y = bottom;
    isX ? ++x : ++z;
  }
}

void GatherMeridian(const LineShape& shape, double cosine, double weight, std::span<const CellLine> lines,
                    Gathered* gathered) {
  if (lines.size() == 1) return alongMeridian<1>(shape, cosine, weight, lines.data(), gathered);
  alongMeridian<2>(shape, cosine, weight, lines.data(), gathered);
}

void GatherRay(const LineShape& shape, double stepX, double stepZ, double weight, std::span<const CellLine> lines,
               Gathered* gathered) {
  if (lines.size() == 2) return alongRay<2>(shape, stepX, stepZ, weight, lines.data(), gathered);
  alongRay<4>(shape, stepX, stepZ, weight, lines.data(), gathered);
}

} // namespace parity::lighting::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

// Asserts stand here: above, they would name this file by the include path, which lies in the build folder.
#if HWY_ONCE
namespace parity::lighting {
namespace {

HWY_EXPORT(GatherMeridian);
HWY_EXPORT(GatherRay);

} // namespace

void gatherMeridian(const LineShape& shape, double cosine, double weight, std::span<const CellLine> lines,
                    Gathered* gathered) {
  assert(lines.size() == 1 || lines.size() == 2);
  HWY_DYNAMIC_DISPATCH(GatherMeridian)(shape, cosine, weight, lines, gathered);
}

void gatherRay(const LineShape& shape, double stepX, double stepZ, double weight, std::span<const CellLine> lines,
               Gathered* gathered) {
  assert(lines.size() == 2 || lines.size() == 4);
  HWY_DYNAMIC_DISPATCH(GatherRay)(shape, stepX, stepZ, weight, lines, gathered);
}

} // namespace parity::lighting
#endif
