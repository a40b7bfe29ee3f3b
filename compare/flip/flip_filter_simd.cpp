// FLIP's separable filters on batches of rows: first across rows, which makes seven planes of three, then along them.
#include "compare/flip/flip_simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/flip/flip_filter_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace parity::compare::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

// Two vectors side by side: enough independent sums to keep the multipliers busy, few enough to stay in registers.
struct Pair {
  V a, b;
};
HWY_INLINE Pair load(D d, const float* p) { return {hn::LoadU(d, p), hn::LoadU(d, p + hn::Lanes(d))}; }
HWY_INLINE void store(D d, const Pair& v, float* p) {
  hn::StoreU(v.a, d, p);
  hn::StoreU(v.b, d, p + hn::Lanes(d));
}
HWY_INLINE Pair add(const Pair& x, const Pair& y) { return {hn::Add(x.a, y.a), hn::Add(x.b, y.b)}; }
HWY_INLINE Pair subtract(const Pair& x, const Pair& y) { return {hn::Sub(x.a, y.a), hn::Sub(x.b, y.b)}; }
HWY_INLINE Pair multiply(D d, float w, const Pair& x) {
  const V weight = hn::Set(d, w);
  return {hn::Mul(weight, x.a), hn::Mul(weight, x.b)};
}
HWY_INLINE Pair multiplyAdd(D d, float w, const Pair& x, const Pair& sum) {
  const V weight = hn::Set(d, w);
  return {hn::MulAdd(weight, x.a, sum.a), hn::MulAdd(weight, x.b, sum.b)};
}
HWY_INLINE Pair sumOfSquares(const Pair& x, const Pair& y) {
  return {hn::MulAdd(x.a, x.a, hn::Mul(y.a, y.a)), hn::MulAdd(x.b, x.b, hn::Mul(y.b, y.b))};
}

// Four vectors side by side, for filters that take one sum each: weights are fetched half as often.
struct Quad {
  Pair a, b;
};
HWY_INLINE Quad loadQuad(D d, const float* p) { return {load(d, p), load(d, p + 2 * hn::Lanes(d))}; }
HWY_INLINE void store(D d, const Quad& v, float* p) {
  store(d, v.a, p);
  store(d, v.b, p + 2 * hn::Lanes(d));
}
HWY_INLINE Quad add(const Quad& x, const Quad& y) { return {add(x.a, y.a), add(x.b, y.b)}; }
HWY_INLINE Quad multiply(D d, float w, const Quad& x) { return {multiply(d, w, x.a), multiply(d, w, x.b)}; }
HWY_INLINE Quad multiplyAdd(D d, float w, const Quad& x, const Quad& sum) {
  return {multiplyAdd(d, w, x.a, sum.a), multiplyAdd(d, w, x.b, sum.b)};
}

// Symmetric kernels take sums of mirrored taps, the antisymmetric (edge) ones differences. The point kernel, whose
// weights sum to 0, takes the sums relative to the centre, so that a constant gives exactly 0: the feature difference
// is under a square root, where noise of 1e-8 would show as 1e-4. tap(k): the values k steps away.
template <typename Tap> HWY_INLINE Quad filterSymmetric(D d, const std::vector<float>& half, Tap tap) {
  Quad sum = multiply(d, half[0], tap(0));
  const auto radius = static_cast<std::ptrdiff_t>(half.size()) - 1;
  for (std::ptrdiff_t k = 1; k <= radius; ++k)
    sum = multiplyAdd(d, half[static_cast<std::size_t>(k)], add(tap(k), tap(-k)), sum);
  return sum;
}

// The features of Y, and luma too where it is of the same plane.
template <bool kWithLuma> HWY_INLINE void filterFeatures(D d, const FlipFilters& f, const float* const* centre,
                                                         std::size_t x, float* values, std::size_t planeStride) {
  const Pair mid = load(d, centre[0] + x), twice = add(mid, mid);
  Pair gauss = multiply(d, f.gauss[0], mid), edge = {hn::Zero(d), hn::Zero(d)}, point = edge;
  [[maybe_unused]] Pair luma = multiply(d, f.luma[0], mid);
  const auto tap = [&](std::ptrdiff_t k) HWY_ATTR {
    const Pair below = load(d, centre[k] + x), above = load(d, centre[-k] + x), sum = add(below, above);
    const auto i = static_cast<std::size_t>(k);
    gauss = multiplyAdd(d, f.gauss[i], sum, gauss);
    edge = multiplyAdd(d, f.edge[i], subtract(below, above), edge);
    point = multiplyAdd(d, f.point[i], subtract(sum, twice), point);
    return sum;
  };
  const auto radius = static_cast<std::ptrdiff_t>(f.gauss.size()) - 1;
  std::ptrdiff_t k = 1;
  if constexpr (kWithLuma) {
    const auto radiusLuma = static_cast<std::ptrdiff_t>(f.luma.size()) - 1;
    for (; k <= radiusLuma; ++k) luma = multiplyAdd(d, f.luma[static_cast<std::size_t>(k)], tap(k), luma);
    store(d, luma, values + kLuma * planeStride);
  }
  for (; k <= radius; ++k) tap(k);
  store(d, gauss, values + kGauss * planeStride);
  store(d, edge, values + kEdge * planeStride);
  store(d, point, values + kPoint * planeStride);
}

HWY_INLINE void filterColumnsOfRow(const FlipFilters& f, const FilterInput& input, const float* const* centre,
                                   std::size_t stride, std::size_t x, float* values, std::size_t planeStride) {
  const D d;
  const auto columnOf = [&](SourcePlane plane) { return plane * stride + x; };
  const auto tapsOf = [&](SourcePlane plane) {
    const std::size_t column = columnOf(plane);
    return [=](std::ptrdiff_t k) HWY_ATTR { return loadQuad(d, centre[k] + column); };
  };
  for (const std::size_t half : {std::size_t{0}, 2 * hn::Lanes(d)}) {
    if (input.y == input.featureY)
      filterFeatures<true>(d, f, centre, columnOf(input.featureY) + half, values + half, planeStride);
    else
      filterFeatures<false>(d, f, centre, columnOf(input.featureY) + half, values + half, planeStride);
  }
  if (input.y != input.featureY) store(d, filterSymmetric(d, f.luma, tapsOf(input.y)), values + kLuma * planeStride);
  store(d, filterSymmetric(d, f.redGreen, tapsOf(input.xMinusY)), values + kRedGreen * planeStride);

  const auto tap = tapsOf(input.yMinusZ);
  const Quad mid = tap(0);
  Quad a = multiply(d, f.blueYellowA[0], mid), b = multiply(d, f.blueYellowB[0], mid);
  const auto radius = static_cast<std::ptrdiff_t>(f.blueYellowA.size()) - 1;
  for (std::ptrdiff_t k = 1; k <= radius; ++k) {
    const Quad sum = add(tap(k), tap(-k));
    a = multiplyAdd(d, f.blueYellowA[static_cast<std::size_t>(k)], sum, a);
    b = multiplyAdd(d, f.blueYellowB[static_cast<std::size_t>(k)], sum, b);
  }
  store(d, a, values + kBlueYellowA * planeStride);
  store(d, b, values + kBlueYellowB * planeStride);
}

void FilterAcrossRows(const FlipFilters& f, const FilterInput& input, const float* const* rows, std::size_t stride,
                      int begin, int end, float* values) {
  const int step = 4 * static_cast<int>(hn::Lanes(D()));
  for (int x = begin; x < end; x += step)
    for (int r = 0; r < kBatchRows; ++r)
      filterColumnsOfRow(f, input, rows + f.radius + r, stride, static_cast<std::size_t>(x),
                         values + static_cast<std::size_t>(r) * stride + x, kBatchRows * stride);
}

// The features along a row, of the planes at `gauss`, `edge` and `point`.
HWY_INLINE void filterFeaturesAlong(D d, const FlipFilters& f, const float* gauss, const float* edge,
                                    const float* point, float* edge2, float* point2) {
  const Pair mid = load(d, gauss), twice = add(mid, mid);
  Pair edgeX = {hn::Zero(d), hn::Zero(d)}, pointX = edgeX;
  Pair edgeY = multiply(d, f.gauss[0], load(d, edge)), pointY = multiply(d, f.gauss[0], load(d, point));
  const auto radius = static_cast<std::ptrdiff_t>(f.gauss.size()) - 1;
  for (std::ptrdiff_t k = 1; k <= radius; ++k) {
    const auto w = static_cast<std::size_t>(k);
    const Pair right = load(d, gauss + k), left = load(d, gauss - k);
    edgeX = multiplyAdd(d, f.edge[w], subtract(right, left), edgeX);
    pointX = multiplyAdd(d, f.point[w], subtract(add(right, left), twice), pointX);
    edgeY = multiplyAdd(d, f.gauss[w], add(load(d, edge + k), load(d, edge - k)), edgeY);
    pointY = multiplyAdd(d, f.gauss[w], add(load(d, point + k), load(d, point - k)), pointY);
  }
  store(d, sumOfSquares(edgeX, edgeY), edge2);
  store(d, sumOfSquares(pointX, pointY), point2);
}

void FilterAlongRow(const FlipFilters& f, const float* values, std::size_t stride, int begin, int count,
                    const FilteredRow& out) {
  const D d;
  const int half = 2 * static_cast<int>(hn::Lanes(d)), step = 2 * half;
  const std::size_t planeStride = kBatchRows * stride;
  for (int i = 0; i < count; i += step) {
    const float* at = values + begin + i;
    const auto tapsOf = [&](FilteredPlane plane) {
      const float* centre = at + plane * planeStride;
      return [=](std::ptrdiff_t k) HWY_ATTR { return loadQuad(d, centre + k); };
    };
    store(d, filterSymmetric(d, f.luma, tapsOf(kLuma)), out.y + i);
    store(d, filterSymmetric(d, f.redGreen, tapsOf(kRedGreen)), out.xMinusY + i);
    store(d,
          add(filterSymmetric(d, f.blueYellowA, tapsOf(kBlueYellowA)),
              filterSymmetric(d, f.blueYellowB, tapsOf(kBlueYellowB))),
          out.yMinusZ + i);
    for (const int j : {i, i + half})
      filterFeaturesAlong(d, f, values + begin + j + kGauss * planeStride, values + begin + j + kEdge * planeStride,
                          values + begin + j + kPoint * planeStride, out.edge2 + j, out.point2 + j);
  }
}

} // namespace parity::compare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::compare {
namespace {
HWY_EXPORT(FilterAcrossRows);
HWY_EXPORT(FilterAlongRow);
} // namespace

void filterAcrossRows(const FlipFilters& filters, const FilterInput& input, const float* const* rows,
                      std::size_t stride, int begin, int end, float* values) {
  HWY_DYNAMIC_DISPATCH(FilterAcrossRows)(filters, input, rows, stride, begin, end, values);
}

void filterAlongRow(const FlipFilters& filters, const float* values, std::size_t stride, int row, int begin, int count,
                    const FilteredRow& out) {
  HWY_DYNAMIC_DISPATCH(FilterAlongRow)
  (filters, values + static_cast<std::size_t>(row) * stride, stride, begin, count, out);
}

} // namespace parity::compare
#endif
