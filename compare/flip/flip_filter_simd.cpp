// FLIP's separable filters on batches of rows: first across rows, which makes seven planes of three, then along them.
// The first pass takes vectors of columns, the second vectors of rows: both without loads that cross cache lines.
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

// Values of neighbouring outputs, one after the other in the direction that is filtered: independent sums that keep the
// multipliers busy, few enough to stay in registers.
struct Pair {
  V a, b;
};
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

struct Quad {
  V a, b, c, d;
};
HWY_INLINE Quad join(const Pair& x, const Pair& y) { return {x.a, x.b, y.a, y.b}; }
HWY_INLINE Quad add(const Quad& x, const Quad& y) {
  return {hn::Add(x.a, y.a), hn::Add(x.b, y.b), hn::Add(x.c, y.c), hn::Add(x.d, y.d)};
}
HWY_INLINE Quad multiply(D d, float w, const Quad& x) {
  const V weight = hn::Set(d, w);
  return {hn::Mul(weight, x.a), hn::Mul(weight, x.b), hn::Mul(weight, x.c), hn::Mul(weight, x.d)};
}
HWY_INLINE Quad multiplyAdd(D d, float w, const Quad& x, const Quad& sum) {
  const V weight = hn::Set(d, w);
  return {hn::MulAdd(weight, x.a, sum.a), hn::MulAdd(weight, x.b, sum.b), hn::MulAdd(weight, x.c, sum.c),
          hn::MulAdd(weight, x.d, sum.d)};
}

// What lies k steps ahead of each output and behind it. Of neighbours, a step further needs one new value each.
// tap(i): the value i steps from the first output.
template <typename Outputs> struct Mirrored { Outputs ahead, behind; };
template <typename Tap> HWY_INLINE Mirrored<Pair> pairAtCentre(Tap tap) {
  const Pair centre = {tap(0), tap(1)};
  return {centre, centre};
}
template <typename Tap> HWY_INLINE Mirrored<Pair> advance(const Mirrored<Pair>& m, std::ptrdiff_t k, Tap tap) {
  return {{m.ahead.b, tap(k + 1)}, {tap(-k), m.behind.a}};
}
template <typename Tap> HWY_INLINE Mirrored<Quad> quadAtCentre(Tap tap) {
  const Quad centre = {tap(0), tap(1), tap(2), tap(3)};
  return {centre, centre};
}
template <typename Tap> HWY_INLINE Mirrored<Quad> advance(const Mirrored<Quad>& m, std::ptrdiff_t k, Tap tap) {
  return {{m.ahead.b, m.ahead.c, m.ahead.d, tap(k + 3)}, {tap(-k), m.behind.a, m.behind.b, m.behind.c}};
}

HWY_INLINE std::ptrdiff_t radiusOf(const std::vector<float>& half) {
  return static_cast<std::ptrdiff_t>(half.size()) - 1;
}

// Symmetric kernels take sums of mirrored taps, the antisymmetric (edge) ones differences. The point kernel, whose
// weights sum to 0, takes the sums relative to the centre, so that a constant gives exactly 0: the feature difference
// is under a square root, where noise of 1e-8 would show as 1e-4.
template <typename Tap> HWY_INLINE Quad filterSymmetric(D d, const std::vector<float>& half, Tap tap) {
  Mirrored<Quad> m = quadAtCentre(tap);
  Quad sum = multiply(d, half[0], m.ahead);
  const std::ptrdiff_t radius = radiusOf(half);
  for (std::ptrdiff_t k = 1; k <= radius; ++k) {
    m = advance(m, k, tap);
    sum = multiplyAdd(d, half[static_cast<std::size_t>(k)], add(m.ahead, m.behind), sum);
  }
  return sum;
}

// Two symmetric kernels of equal length over the same values.
struct TwoPairs {
  Pair first, second;
};
template <typename Tap> HWY_INLINE TwoPairs filterSymmetricTwice(D d, const std::vector<float>& first,
                                                                 const std::vector<float>& second, Tap tap) {
  Mirrored<Pair> m = pairAtCentre(tap);
  TwoPairs sum = {multiply(d, first[0], m.ahead), multiply(d, second[0], m.ahead)};
  const std::ptrdiff_t radius = radiusOf(first);
  for (std::ptrdiff_t k = 1; k <= radius; ++k) {
    m = advance(m, k, tap);
    const Pair both = add(m.ahead, m.behind);
    sum.first = multiplyAdd(d, first[static_cast<std::size_t>(k)], both, sum.first);
    sum.second = multiplyAdd(d, second[static_cast<std::size_t>(k)], both, sum.second);
  }
  return sum;
}

// The features of Y, and luma too where it is of the same plane.
struct Features {
  Pair luma, gauss, edge, point;
};
template <bool kWithLuma> HWY_INLINE void addFeatures(D d, const FlipFilters& f, std::size_t k, const Mirrored<Pair>& m,
                                                      const Pair& twice, Features& sum) {
  const Pair both = add(m.ahead, m.behind);
  if constexpr (kWithLuma) sum.luma = multiplyAdd(d, f.luma[k], both, sum.luma);
  sum.gauss = multiplyAdd(d, f.gauss[k], both, sum.gauss);
  sum.edge = multiplyAdd(d, f.edge[k], subtract(m.ahead, m.behind), sum.edge);
  sum.point = multiplyAdd(d, f.point[k], subtract(both, twice), sum.point);
}
template <bool kWithLuma, typename Tap> HWY_INLINE Features filterFeatures(D d, const FlipFilters& f, Tap tap) {
  Mirrored<Pair> m = pairAtCentre(tap);
  const Pair centre = m.ahead, twice = add(centre, centre), zero = {hn::Zero(d), hn::Zero(d)};
  Features sum = {multiply(d, f.luma[0], centre), multiply(d, f.gauss[0], centre), zero, zero};
  const std::ptrdiff_t radius = radiusOf(f.gauss);
  std::ptrdiff_t k = 1;
  if constexpr (kWithLuma) {
    const std::ptrdiff_t radiusLuma = radiusOf(f.luma);
    for (; k <= radiusLuma; ++k) {
      m = advance(m, k, tap);
      addFeatures<true>(d, f, static_cast<std::size_t>(k), m, twice, sum);
    }
  }
  for (; k <= radius; ++k) {
    m = advance(m, k, tap);
    addFeatures<false>(d, f, static_cast<std::size_t>(k), m, twice, sum);
  }
  return sum;
}

// Stores four vectors transposed: value j of the first goes to `to + j * distance`, those of the others behind it.
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void storeTransposed(D d, const Quad& v, float* to, std::ptrdiff_t) {
  hn::StoreU(v.a, d, to);
  hn::StoreU(v.b, d, to + 1);
  hn::StoreU(v.c, d, to + 2);
  hn::StoreU(v.d, d, to + 3);
}
#else
// Each block of four values a distance of its own from the last.
template <class E, class W> HWY_INLINE void storeBlocks(E e, W v, float* to, std::ptrdiff_t distance) {
  constexpr std::ptrdiff_t kBlocks = hn::MaxLanes(E()) / 4;
  if constexpr (kBlocks == 1) {
    hn::StoreU(v, e, to);
  } else {
    const hn::Half<E> half;
    storeBlocks(half, hn::LowerHalf(half, v), to, distance);
    storeBlocks(half, hn::UpperHalf(half, v), to + kBlocks / 2 * distance, distance);
  }
}
HWY_INLINE void storeTransposed(D d, const Quad& v, float* to, std::ptrdiff_t distance) {
  const V acLow = hn::InterleaveLower(d, v.a, v.c), bdLow = hn::InterleaveLower(d, v.b, v.d);
  const V acHigh = hn::InterleaveUpper(d, v.a, v.c), bdHigh = hn::InterleaveUpper(d, v.b, v.d);
  storeBlocks(d, hn::InterleaveLower(d, acLow, bdLow), to, 4 * distance);
  storeBlocks(d, hn::InterleaveUpper(d, acLow, bdLow), to + distance, 4 * distance);
  storeBlocks(d, hn::InterleaveLower(d, acHigh, bdHigh), to + 2 * distance, 4 * distance);
  storeBlocks(d, hn::InterleaveUpper(d, acHigh, bdHigh), to + 3 * distance, 4 * distance);
}
#endif

// The values of column x of a plane's rows.
struct ColumnTap {
  const float* const* centre; // the first row that is filtered
  std::size_t column;
  HWY_INLINE V operator()(std::ptrdiff_t k) const { return hn::LoadU(D(), centre[k] + column); }
  HWY_INLINE ColumnTap below(std::ptrdiff_t rows) const { return {centre + rows, column}; }
};

// Four rows of a vector of columns.
template <bool kLumaIsOfFeatures>
HWY_INLINE void filterFourRows(const FlipFilters& f, const FilterInput& input, const float* const* centre,
                               std::size_t stride, std::size_t x, float* values, std::size_t planeStride) {
  const D d;
  const auto tapOf = [&](SourcePlane plane) { return ColumnTap{centre, plane * stride + x}; };
  const ColumnTap featureY = tapOf(input.featureY), yMinusZ = tapOf(input.yMinusZ);
  const Features upper = filterFeatures<kLumaIsOfFeatures>(d, f, featureY),
                 lower = filterFeatures<kLumaIsOfFeatures>(d, f, featureY.below(2));
  storeTransposed(d, join(upper.gauss, lower.gauss), values + kGauss * planeStride, kBatchRows);
  storeTransposed(d, join(upper.edge, lower.edge), values + kEdge * planeStride, kBatchRows);
  storeTransposed(d, join(upper.point, lower.point), values + kPoint * planeStride, kBatchRows);
  if constexpr (kLumaIsOfFeatures)
    storeTransposed(d, join(upper.luma, lower.luma), values + kLuma * planeStride, kBatchRows);
  else
    storeTransposed(d, filterSymmetric(d, f.luma, tapOf(input.y)), values + kLuma * planeStride, kBatchRows);
  storeTransposed(d, filterSymmetric(d, f.redGreen, tapOf(input.xMinusY)), values + kRedGreen * planeStride,
                  kBatchRows);
  const TwoPairs above = filterSymmetricTwice(d, f.blueYellowA, f.blueYellowB, yMinusZ),
                 below = filterSymmetricTwice(d, f.blueYellowA, f.blueYellowB, yMinusZ.below(2));
  storeTransposed(d, join(above.first, below.first), values + kBlueYellowA * planeStride, kBatchRows);
  storeTransposed(d, join(above.second, below.second), values + kBlueYellowB * planeStride, kBatchRows);
}

void FilterAcrossRows(const FlipFilters& f, const FilterInput& input, const float* const* rows, std::size_t stride,
                      int begin, int end, int rowCount, float* values) {
  const int step = static_cast<int>(hn::Lanes(D()));
  for (int x = begin; x < end; x += step)
    for (int r = 0; r < rowCount; r += 4)
      if (input.y == input.featureY)
        filterFourRows<true>(f, input, rows + f.radius + r, stride, static_cast<std::size_t>(x),
                             values + static_cast<std::ptrdiff_t>(x) * kBatchRows + r, kBatchRows * stride);
      else
        filterFourRows<false>(f, input, rows + f.radius + r, stride, static_cast<std::size_t>(x),
                              values + static_cast<std::ptrdiff_t>(x) * kBatchRows + r, kBatchRows * stride);
}

// The features of two neighbouring columns, of the planes at `gauss`, `edge` and `point`.
HWY_INLINE void filterFeaturesAlong(D d, const FlipFilters& f, const float* gauss, const float* edge,
                                    const float* point, float* edge2, float* point2) {
  const auto tapsOf = [d](const float* at) {
    return [=](std::ptrdiff_t k) HWY_ATTR { return hn::LoadU(d, at + k * kBatchRows); };
  };
  const auto tapGauss = tapsOf(gauss), tapEdge = tapsOf(edge), tapPoint = tapsOf(point);
  Mirrored<Pair> m = pairAtCentre(tapGauss), ofEdge = pairAtCentre(tapEdge), ofPoint = pairAtCentre(tapPoint);
  const Pair twice = add(m.ahead, m.ahead);
  Pair edgeX = {hn::Zero(d), hn::Zero(d)}, pointX = edgeX;
  Pair edgeY = multiply(d, f.gauss[0], ofEdge.ahead), pointY = multiply(d, f.gauss[0], ofPoint.ahead);
  const std::ptrdiff_t radius = radiusOf(f.gauss);
  for (std::ptrdiff_t k = 1; k <= radius; ++k) {
    const auto w = static_cast<std::size_t>(k);
    m = advance(m, k, tapGauss);
    edgeX = multiplyAdd(d, f.edge[w], subtract(m.ahead, m.behind), edgeX);
    pointX = multiplyAdd(d, f.point[w], subtract(add(m.ahead, m.behind), twice), pointX);
  }
  for (std::ptrdiff_t k = 1; k <= radius; ++k) {
    const auto w = static_cast<std::size_t>(k);
    ofEdge = advance(ofEdge, k, tapEdge);
    ofPoint = advance(ofPoint, k, tapPoint);
    edgeY = multiplyAdd(d, f.gauss[w], add(ofEdge.ahead, ofEdge.behind), edgeY);
    pointY = multiplyAdd(d, f.gauss[w], add(ofPoint.ahead, ofPoint.behind), pointY);
  }
  const Pair edges = sumOfSquares(edgeX, edgeY), points = sumOfSquares(pointX, pointY);
  hn::StoreU(edges.a, d, edge2);
  hn::StoreU(edges.b, d, edge2 + kBatchRows);
  hn::StoreU(points.a, d, point2);
  hn::StoreU(points.b, d, point2 + kBatchRows);
}

// Four columns of a vector of rows.
HWY_INLINE void filterFourColumns(const FlipFilters& f, const float* at, std::size_t planeStride,
                                  const FilteredColumns& out, std::ptrdiff_t to) {
  const D d;
  const auto tapsOf = [&](FilteredPlane plane) {
    const float* centre = at + plane * planeStride;
    return [=](std::ptrdiff_t k) HWY_ATTR { return hn::LoadU(d, centre + k * kBatchRows); };
  };
  const auto store = [&](const Quad& v, float* columns) HWY_ATTR {
    hn::StoreU(v.a, d, columns + to);
    hn::StoreU(v.b, d, columns + to + kBatchRows);
    hn::StoreU(v.c, d, columns + to + 2 * kBatchRows);
    hn::StoreU(v.d, d, columns + to + 3 * kBatchRows);
  };
  store(filterSymmetric(d, f.luma, tapsOf(kLuma)), out.y);
  store(filterSymmetric(d, f.redGreen, tapsOf(kRedGreen)), out.xMinusY);
  store(add(filterSymmetric(d, f.blueYellowA, tapsOf(kBlueYellowA)),
            filterSymmetric(d, f.blueYellowB, tapsOf(kBlueYellowB))),
        out.yMinusZ);
  for (const std::ptrdiff_t i : {0, 2 * kBatchRows})
    filterFeaturesAlong(d, f, at + i + kGauss * planeStride, at + i + kEdge * planeStride,
                        at + i + kPoint * planeStride, out.edge2 + to + i, out.point2 + to + i);
}

void FilterAlongRows(const FlipFilters& f, const float* values, std::size_t stride, int begin, int count, int rowCount,
                     const FilteredColumns& out) {
  const int step = static_cast<int>(hn::Lanes(D()));
  for (int i = 0; i < count; i += 4)
    for (int r = 0; r < rowCount; r += step)
      filterFourColumns(f, values + static_cast<std::ptrdiff_t>(begin + i) * kBatchRows + r, kBatchRows * stride, out,
                        static_cast<std::ptrdiff_t>(i) * kBatchRows + r);
}

void RowsOfColumns(const float* columns, int count, int rowCount, float* rows, std::ptrdiff_t stride) {
  const D d;
  const int step = static_cast<int>(hn::Lanes(d));
  for (int i = 0; i < count; i += 4)
    for (int r = 0; r < rowCount; r += step) {
      const float* at = columns + static_cast<std::ptrdiff_t>(i) * kBatchRows + r;
      const Quad v = {hn::LoadU(d, at), hn::LoadU(d, at + kBatchRows), hn::LoadU(d, at + 2 * kBatchRows),
                      hn::LoadU(d, at + 3 * kBatchRows)};
      storeTransposed(d, v, rows + r * stride + i, stride);
    }
}

} // namespace parity::compare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::compare {
namespace {
HWY_EXPORT(FilterAcrossRows);
HWY_EXPORT(FilterAlongRows);
HWY_EXPORT(RowsOfColumns);
} // namespace

void filterAcrossRows(const FlipFilters& filters, const FilterInput& input, const float* const* rows,
                      std::size_t stride, int begin, int end, int rowCount, float* values) {
  HWY_DYNAMIC_DISPATCH(FilterAcrossRows)(filters, input, rows, stride, begin, end, rowCount, values);
}

void filterAlongRows(const FlipFilters& filters, const float* values, std::size_t stride, int begin, int count,
                     int rowCount, const FilteredColumns& out) {
  HWY_DYNAMIC_DISPATCH(FilterAlongRows)(filters, values, stride, begin, count, rowCount, out);
}

void rowsOfColumns(const float* columns, int count, int rowCount, float* rows, std::ptrdiff_t stride) {
  HWY_DYNAMIC_DISPATCH(RowsOfColumns)(columns, count, rowCount, rows, stride);
}

} // namespace parity::compare
#endif
