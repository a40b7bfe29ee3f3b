// FLIP's differences on filtered pixels: colour (HyAB of Hunt-adjusted CIELab), features, and both together.
#include <cmath>
#include <type_traits>

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

using Triple = Three<V>;

constexpr bool kHasManyRegisters = HWY_TARGET <= HWY_AVX3; // 32 vectors

HWY_INLINE Triple transform(D d, const Matrix3& a, const Triple& v) {
  const auto row = [&](int i) HWY_ATTR {
    return hn::MulAdd(hn::Set(d, a.m[i][0]), v.x,
                      hn::MulAdd(hn::Set(d, a.m[i][1]), v.y, hn::Mul(hn::Set(d, a.m[i][2]), v.z)));
  };
  return {row(0), row(1), row(2)};
}

HWY_INLINE V clamp01(D d, V v) { return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.f)); }

// CIE 1976 lightness function f: t^(1/3) above (6/29)^3, else t/(3 (6/29)^2) + 4/29, of X, Y and Z in [0, 1.1]; and how
// much it falls from t to t - dt: of two cube roots p and q by dt/(p^2 + pq + q^2), which keeps the accuracy of dt
// however small.
struct Lightness {
  Triple f, fOther, difference; // of t, of t - dt, f - fOther
};
HWY_INLINE Lightness lightness(D d, const Triple& t, const Triple& dt) {
  constexpr float kDelta = 6.f / 29.f;
  const V bend = hn::Set(d, kDelta * kDelta * kDelta), slope = hn::Set(d, 1.f / (3.f * kDelta * kDelta));
  const V least = hn::Set(d, 1e-3f), offset = hn::Set(d, 4.f / 29.f);
  const auto atLeast = [=](V v) HWY_ATTR { return hn::Max(v, least); };
  const auto choose = [=](V v, V root)
                          HWY_ATTR { return hn::IfThenElse(hn::Gt(v, bend), root, hn::MulAdd(v, slope, offset)); };
  const Triple other = each([](V v, V dv) HWY_ATTR { return hn::Sub(v, dv); }, t, dt);
  const Triple p = fastCbrt(d, each(atLeast, t)), q = fastCbrt(d, each(atLeast, other));
  const Triple inverse =
      fastReciprocal(d, each([](V v, V w) HWY_ATTR { return hn::MulAdd(v, hn::Add(v, w), hn::Mul(w, w)); }, p, q));
  const Triple f = each(choose, t, p), fOther = each(choose, other, q);
  const Triple ofRoots = each([](V dv, V v) HWY_ATTR { return hn::Mul(dv, v); }, dt, inverse);
  const Triple ofOne = each([](V v, V w) HWY_ATTR { return hn::Sub(v, w); }, f, fOther);
  const Triple difference = each(
      [=](V v, V w, V dv, V roots, V one) HWY_ATTR {
        const auto isRoot = hn::Gt(v, bend), otherIsRoot = hn::Gt(w, bend);
        return hn::IfThenElse(hn::Or(isRoot, otherIsRoot), hn::IfThenElse(hn::And(isRoot, otherIsRoot), roots, one),
                              hn::Mul(dv, slope));
      },
      t, other, dt, ofRoots, ofOne);
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

HWY_INLINE V differ(D d, const float* a, const float* b) {
  return hn::AbsDiff(hn::Sqrt(hn::LoadU(d, a)), hn::Sqrt(hn::LoadU(d, b)));
}

// The feature difference: (max(|d edge|, |d point|)/sqrt 2)^0.5, at most 1.
HWY_INLINE V featureDifference(D d, const FilteredColumns& a, const FilteredColumns& b, int i) {
  const V most = hn::Max(differ(d, a.edge2 + i, b.edge2 + i), differ(d, a.point2 + i, b.point2 + i));
  return hn::Min(hn::Sqrt(hn::Mul(most, hn::Set(d, 0.707106781f))), hn::Set(d, 1.f));
}

// HyAB between CIELab colours whose a and b are scaled by 0.01 L (Hunt): |dL| + sqrt(da^2 + db^2). From XYZ and
// differences, in differences throughout: the power 0.7 that follows would make the rounding of two colours of 100
// visible where the images hardly differ.
// The feature difference, whose roots take a unit of their own, goes along: it takes the place of the test's edges.
HWY_INLINE void hyabRow(const FilteredColumns& reference, const FilteredColumns& test, int count, float* out) {
  const D d;
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const Triple xyz = loadColors(d, reference, i), dxyz = loadColors(d, test, i);
    const auto& [f, fOther, difference] = lightness(d, xyz, dxyz);
    // With g = fx - fy, a = 5 L g: a difference of products, L dg + dL g'.
    const V l = hn::MulSub(hn::Set(d, 116.f), f.y, hn::Set(d, 16.f)), dl = hn::Mul(hn::Set(d, 116.f), difference.y);
    const V da = hn::MulAdd(l, hn::Sub(difference.x, difference.y), hn::Mul(dl, hn::Sub(fOther.x, fOther.y)));
    const V db = hn::MulAdd(l, hn::Sub(difference.y, difference.z), hn::Mul(dl, hn::Sub(fOther.y, fOther.z)));
    const V chroma2 = hn::MulAdd(hn::Mul(da, da), hn::Set(d, 25.f), hn::Mul(hn::Mul(db, db), hn::Set(d, 4.f)));
    hn::StoreU(hn::Add(hn::Abs(dl), hn::Sqrt(chroma2)), d, out + i);
    hn::StoreU(featureDifference(d, reference, test, i), d, test.edge2 + i);
  }
}

constexpr float kKnee = 0.4f * flip_constants::kMaxColorDifference; // this HyAB^0.7 goes to 0.95

// As many vectors side by side as there are registers for.
using Group = std::conditional_t<kHasManyRegisters, Two<Two<V>>, Two<V>>;
template <class T> HWY_INLINE T loadVectors(D d, const float* p) {
  if constexpr (std::is_same_v<T, V>) {
    return hn::LoadU(d, p);
  } else {
    using Half = decltype(T::x);
    return {loadVectors<Half>(d, p), loadVectors<Half>(d, p + sizeof(Half) / sizeof(float))};
  }
}
HWY_INLINE void storeVectors(D d, const V& v, float* p) { hn::StoreU(v, d, p); }
template <class T> HWY_INLINE void storeVectors(D d, const Two<T>& v, float* p) {
  storeVectors(d, v.x, p);
  storeVectors(d, v.y, p + sizeof(T) / sizeof(float));
}

// out.flip holds HyAB, and is replaced.
template <bool kParts>
HWY_INLINE void combineRow(const float* features, int count, float log2OfLowSlope, const Differences& out) {
  const D d;
  constexpr int kStep = sizeof(Group) / sizeof(float);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.f), knee = hn::Set(d, kKnee);
  for (int i = 0; i < count; i += kStep) {
    const Group hyab = loadVectors<Group>(d, out.flip + i);
    const Group feature = loadVectors<Group>(d, features + i);

    // c = HyAB^0.7 goes to 0.95 c/knee below the knee, and on from there to 1 at the largest. The logarithm of the
    // result is 0.7 log2 HyAB + log2(0.95/knee), and near 1 the series of log(1-u), u <= 0.05: u^6/6 is left out, 3e-9.
    const Group log = fastLog2(d, each([=](V v) HWY_ATTR { return hn::Max(v, hn::Set(d, 1e-30f)); }, hyab));
    const Group logC = each([=](V v) HWY_ATTR { return hn::Mul(hn::Set(d, 0.7f), v); }, log);
    const Group c = fastExp2(d, logC);
    const Group u = each(
        [=](V v) HWY_ATTR {
          constexpr float kSlope = 0.05f / (flip_constants::kMaxColorDifference - kKnee);
          return hn::Max(hn::NegMulAdd(hn::Sub(v, knee), hn::Set(d, kSlope), hn::Set(d, 0.05f)), zero);
        },
        c);
    const Group logHigh = each(
        [=](V v) HWY_ATTR {
          V series = hn::MulAdd(v, hn::Set(d, 0.2f), hn::Set(d, 0.25f));
          series = hn::MulAdd(v, series, hn::Set(d, 1.f / 3.f));
          series = hn::MulAdd(v, series, hn::Set(d, 0.5f));
          return hn::Mul(hn::Mul(v, hn::Set(d, -1.442695041f)), hn::MulAdd(v, series, one));
        },
        u);
    const Group exponent = each(
        [=](V v, V logV, V high, V part) HWY_ATTR {
          const V logColor = hn::IfThenElse(hn::Lt(v, knee), hn::Add(logV, hn::Set(d, log2OfLowSlope)), high);
          return hn::Mul(hn::Sub(one, part), logColor);
        },
        c, logC, logHigh, feature);
    const Group power = fastExp2(d, exponent);
    storeVectors(
        d, each([=](V v, V h) HWY_ATTR { return hn::IfThenElseZero(hn::Gt(h, zero), hn::Min(v, one)); }, power, hyab),
        out.flip + i);
    if constexpr (kParts) {
      storeVectors(d,
                   each(
                       [=](V v, V w, V h) HWY_ATTR {
                         const V color =
                             hn::IfThenElse(hn::Lt(v, knee), hn::Mul(v, hn::Set(d, 0.95f / kKnee)), hn::Sub(one, w));
                         return hn::IfThenElseZero(hn::Gt(h, zero), color);
                       },
                       c, u, hyab),
                   out.color + i);
      storeVectors(d, feature, out.feature + i);
    }
  }
}

// Three loops, because one would be a chain longer than what a processor looks ahead.
HWY_FLATTEN void ComputeDifferences(const FilteredColumns& reference, const FilteredColumns& test, int count,
                                    float log2OfLowSlope, const Differences& out) {
  clampRow(reference, test, count);
  hyabRow(reference, test, count, out.flip);
  if (out.color)
    combineRow<true>(test.edge2, count, log2OfLowSlope, out);
  else
    combineRow<false>(test.edge2, count, log2OfLowSlope, out);
}

void KeepLargest(const float* values, int count, float mark, float* largest, float* marks) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int i = 0;
  for (; i + lanes <= count; i += lanes) {
    const V value = hn::LoadU(d, values + i), held = hn::LoadU(d, largest + i);
    const auto isLarger = hn::Gt(value, held);
    hn::StoreU(hn::IfThenElse(isLarger, value, held), d, largest + i);
    hn::StoreU(hn::IfThenElse(isLarger, hn::Set(d, mark), hn::LoadU(d, marks + i)), d, marks + i);
  }
  for (; i < count; ++i)
    if (values[i] > largest[i]) {
      largest[i] = values[i];
      marks[i] = mark;
    }
}

} // namespace parity::compare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::compare {
namespace {
HWY_EXPORT(ComputeDifferences);
HWY_EXPORT(KeepLargest);
} // namespace

void computeDifferences(const FilteredColumns& reference, const FilteredColumns& test, int count,
                        const Differences& out) {
  static const float log2OfLowSlope =
      std::log2(0.95f / (0.4f * flip_constants::kMaxColorDifference)); // of 0.95/knee: the colour difference's slope
  HWY_DYNAMIC_DISPATCH(ComputeDifferences)(reference, test, count, log2OfLowSlope, out);
}

void keepLargest(const float* values, int count, float mark, float* largest, float* marks) {
  HWY_DYNAMIC_DISPATCH(KeepLargest)(values, count, mark, largest, marks);
}

} // namespace parity::compare
#endif
