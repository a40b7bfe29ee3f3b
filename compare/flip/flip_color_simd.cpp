// FLIP's differences on filtered pixels: colour (HyAB of Hunt-adjusted CIELab), features, and both together.
#include <cmath>

#include "compare/flip/flip_constants.h"
#include "compare/flip/flip_simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/flip/flip_color_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "compare/flip/flip_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace parity::compare::HWY_NAMESPACE {

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

struct Triple {
  V x, y, z;
};

HWY_INLINE Triple transform(D d, const Matrix3& a, const Triple& v) {
  const auto row = [&](int i) HWY_ATTR {
    return hn::MulAdd(hn::Set(d, a.m[i][0]), v.x,
                      hn::MulAdd(hn::Set(d, a.m[i][1]), v.y, hn::Mul(hn::Set(d, a.m[i][2]), v.z)));
  };
  return {row(0), row(1), row(2)};
}

HWY_INLINE V clamp01(D d, V v) { return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.f)); }

// CIE 1976 lightness function f: t^(1/3) above (6/29)^3, else t/(3 (6/29)^2) + 4/29, of t in [0, 1.1]; and how much it
// falls from t to t - dt: of two cube roots p and q by dt/(p^2 + pq + q^2), which keeps the accuracy of dt however
// small.
struct Lightness {
  V f, fOther, difference; // of t, of t - dt, f - fOther
};
HWY_INLINE Lightness lightness(D d, V t, V dt) {
  constexpr float kDelta = 6.f / 29.f;
  const V bend = hn::Set(d, kDelta * kDelta * kDelta), slope = hn::Set(d, 1.f / (3.f * kDelta * kDelta));
  const V least = hn::Set(d, 1e-3f), offset = hn::Set(d, 4.f / 29.f);
  const V other = hn::Sub(t, dt);
  const V p = fastCbrt(d, hn::Max(t, least)), q = fastCbrt(d, hn::Max(other, least));
  const V f = hn::IfThenElse(hn::Gt(t, bend), p, hn::MulAdd(t, slope, offset));
  const V fOther = hn::IfThenElse(hn::Gt(other, bend), q, hn::MulAdd(other, slope, offset));
  const V ofRoots = hn::Mul(dt, fastReciprocal(d, hn::MulAdd(p, hn::Add(p, q), hn::Mul(q, q))));
  const V ofLines = hn::Mul(dt, slope);
  V difference = hn::IfThenElse(hn::Gt(hn::Min(t, other), bend), ofRoots, hn::Sub(f, fOther));
  difference = hn::IfThenElse(hn::Le(hn::Max(t, other), bend), ofLines, difference);
  return {f, fOther, difference};
}

// What clamping RGB to [0,1] adds to it, and how much more it adds to c than to c - dc.
struct Clamping {
  V change, difference;
};
HWY_INLINE Clamping clamping(D d, V c, V dc) {
  const V other = hn::Sub(c, dc);
  const V change = hn::Sub(clamp01(d, c), c), otherChange = hn::Sub(clamp01(d, other), other);
  return {change, hn::Sub(change, otherChange)};
}

HWY_INLINE Triple loadColors(D d, const FilteredColumns& row, int i) {
  return {hn::LoadU(d, row.y + i), hn::LoadU(d, row.xMinusY + i), hn::LoadU(d, row.yMinusZ + i)};
}

HWY_INLINE void storeColors(D d, const Triple& v, const FilteredColumns& row, int i) {
  hn::StoreU(v.x, d, row.y + i);
  hn::StoreU(v.y, d, row.xMinusY + i);
  hn::StoreU(v.z, d, row.yMinusZ + i);
}

// (Y, X-Y, Y-Z) to XYZ, plus what clamping changes.
HWY_INLINE Triple toXyz(D d, const Triple& opponent, const Triple& change) {
  const Triple xyz = transform(d, flip_constants::kRgbToXyz, change);
  return {hn::Add(hn::Add(opponent.x, opponent.y), xyz.x), hn::Add(opponent.x, xyz.y),
          hn::Add(hn::Sub(opponent.x, opponent.z), xyz.z)};
}

// Of the reference's filtered (Y, X-Y, Y-Z), in place, XYZ; and of its difference from the test's the difference in
// XYZ. Linear RGB is clamped to [0,1] on the way: XYZ is taken as it came, plus what clamping changes, which is mostly
// nothing.
HWY_INLINE void clampRow(const FilteredColumns& reference, const FilteredColumns& difference, int count) {
  const D d;
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const Triple color = loadColors(d, reference, i), dcolor = loadColors(d, difference, i);
    const Triple rgb = transform(d, flip_constants::kOpponentToRgb, color);
    const Triple drgb = transform(d, flip_constants::kOpponentToRgb, dcolor);
    const Clamping r = clamping(d, rgb.x, drgb.x), g = clamping(d, rgb.y, drgb.y), b = clamping(d, rgb.z, drgb.z);
    storeColors(d, toXyz(d, color, {r.change, g.change, b.change}), reference, i);
    storeColors(d, toXyz(d, dcolor, {r.difference, g.difference, b.difference}), difference, i);
  }
}

// HyAB between CIELab colours whose a and b are scaled by 0.01 L (Hunt): |dL| + sqrt(da^2 + db^2). From XYZ and
// differences, in differences throughout: the power 0.7 that follows would make the rounding of two colours of 100
// visible where the images hardly differ.
HWY_INLINE void hyabRow(const FilteredColumns& reference, const FilteredColumns& difference, int count, float* out) {
  const D d;
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const Triple xyz = loadColors(d, reference, i), dxyz = loadColors(d, difference, i);
    const Lightness x = lightness(d, xyz.x, dxyz.x), y = lightness(d, xyz.y, dxyz.y), z = lightness(d, xyz.z, dxyz.z);
    // With g = fx - fy, a = 5 L g: a difference of products, L dg + dL g'.
    const V l = hn::MulSub(hn::Set(d, 116.f), y.f, hn::Set(d, 16.f)), dl = hn::Mul(hn::Set(d, 116.f), y.difference);
    const V da = hn::MulAdd(l, hn::Sub(x.difference, y.difference), hn::Mul(dl, hn::Sub(x.fOther, y.fOther)));
    const V db = hn::MulAdd(l, hn::Sub(y.difference, z.difference), hn::Mul(dl, hn::Sub(y.fOther, z.fOther)));
    const V chroma2 = hn::MulAdd(hn::Mul(da, da), hn::Set(d, 25.f), hn::Mul(hn::Mul(db, db), hn::Set(d, 4.f)));
    hn::StoreU(hn::Add(hn::Abs(dl), hn::Sqrt(chroma2)), d, out + i);
  }
}

HWY_INLINE V differ(D d, const float* a, const float* b) {
  return hn::AbsDiff(hn::Sqrt(hn::LoadU(d, a)), hn::Sqrt(hn::LoadU(d, b)));
}

// The feature difference: (max(|d edge|, |d point|)/sqrt 2)^0.5, at most 1.
HWY_INLINE V featureDifference(D d, const FilteredColumns& a, const FilteredColumns& b, int i) {
  const V most = hn::Max(differ(d, a.edge2 + i, b.edge2 + i), differ(d, a.point2 + i, b.point2 + i));
  return hn::Min(hn::Sqrt(hn::Mul(most, hn::Set(d, 0.707106781f))), hn::Set(d, 1.f));
}

constexpr float kKnee = 0.4f * flip_constants::kMaxColorDifference; // this HyAB^0.7 goes to 0.95

// out.flip holds HyAB, and is replaced.
template <bool kParts> HWY_INLINE void combineRow(const FilteredColumns& reference, const FilteredColumns& test, int count,
                                                  float log2OfLowSlope, const Differences& out) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.f);
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const V hyab = hn::LoadU(d, out.flip + i);
    const auto differs = hn::Gt(hyab, zero);

    // c = HyAB^0.7 goes to 0.95 c/knee below the knee, and on from there to 1 at the largest. The logarithm of the
    // result is 0.7 log2 HyAB + log2(0.95/knee), and near 1 the series of log(1-u), u <= 0.05: u^6/6 is left out, 3e-9.
    const V logC = hn::Mul(hn::Set(d, 0.7f), fastLog2(d, hn::Max(hyab, hn::Set(d, 1e-30f))));
    const V c = fastExp2(d, logC);
    constexpr float kSlope = 0.05f / (flip_constants::kMaxColorDifference - kKnee);
    const V u = hn::Max(hn::NegMulAdd(hn::Sub(c, hn::Set(d, kKnee)), hn::Set(d, kSlope), hn::Set(d, 0.05f)), zero);
    V series = hn::MulAdd(u, hn::Set(d, 0.2f), hn::Set(d, 0.25f));
    series = hn::MulAdd(u, series, hn::Set(d, 1.f / 3.f));
    series = hn::MulAdd(u, series, hn::Set(d, 0.5f));
    series = hn::Mul(hn::Mul(u, hn::Set(d, -1.442695041f)), hn::MulAdd(u, series, one));
    const auto low = hn::Lt(c, hn::Set(d, kKnee));
    const V logColor = hn::IfThenElse(low, hn::Add(logC, hn::Set(d, log2OfLowSlope)), series);

    const V feature = featureDifference(d, reference, test, i);
    const V flip = hn::Min(fastExp2(d, hn::Mul(hn::Sub(one, feature), logColor)), one);
    hn::StoreU(hn::IfThenElseZero(differs, flip), d, out.flip + i);
    if constexpr (kParts) {
      const V color = hn::IfThenElse(low, hn::Mul(c, hn::Set(d, 0.95f / kKnee)), hn::Sub(one, u));
      hn::StoreU(hn::IfThenElseZero(differs, color), d, out.color + i);
      hn::StoreU(feature, d, out.feature + i);
    }
  }
}

// Three loops, because one would be a chain longer than what a processor looks ahead.
void ComputeDifferences(const FilteredColumns& reference, const FilteredColumns& test, int count, float log2OfLowSlope,
                 const Differences& out) {
  clampRow(reference, test, count);
  hyabRow(reference, test, count, out.flip);
  if (out.color)
    combineRow<true>(reference, test, count, log2OfLowSlope, out);
  else
    combineRow<false>(reference, test, count, log2OfLowSlope, out);
}

} // namespace parity::compare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::compare {
namespace {
HWY_EXPORT(ComputeDifferences);
} // namespace

void computeDifferences(const FilteredColumns& reference, const FilteredColumns& test, int count, const Differences& out) {
  static const float log2OfLowSlope =
      std::log2(0.95f / (0.4f * flip_constants::kMaxColorDifference)); // of 0.95/knee: the colour difference's slope
  HWY_DYNAMIC_DISPATCH(ComputeDifferences)(reference, test, count, log2OfLowSlope, out);
}

} // namespace parity::compare
#endif
