// Roots and powers of vectors of floats, for each instruction set that Highway compiles the including file for.
#if defined(PARITY_COMPARE_FLIP_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PARITY_COMPARE_FLIP_MATH_INL_H_
#undef PARITY_COMPARE_FLIP_MATH_INL_H_
#else
#define PARITY_COMPARE_FLIP_MATH_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace parity::compare::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// 1/x for normal x, by a step of Newton's on the processor's estimate: 12 bits of it become 23 (on x86; where the
// estimate has 8, 16 bits).
template <class D, class V = hn::Vec<D>> HWY_INLINE V fastReciprocal(D d, V x) {
  const V y = hn::ApproximateReciprocal(x);
  return hn::Mul(y, hn::NegMulAdd(x, y, hn::Set(d, 2.f)));
}

// Cube root of x in [1e-3, 2]. Relative error below 2.5e-7 (tested). No division: y approximates x^(-1/3), first on the
// bits of x (within 3.5 %), then by two steps y += y (r/3 + 2 r^2/9), r = 1 - x y^3, each of which leaves 14/81 r^3;
// the root is x y^2.
template <class D, class V = hn::Vec<D>> HWY_INLINE V fastCbrt(D d, V x) {
  const hn::RebindToSigned<D> di;
  const V bits = hn::ConvertTo(d, hn::BitCast(di, x));
  // 0x54a2fa8c less a third of the bits. A float holds the bits to 2^-24: far below the 3.5 %.
  V y = hn::BitCast(d, hn::ConvertTo(di, hn::MulAdd(bits, hn::Set(d, -1.f / 3.f), hn::Set(d, 1419966092.f))));
  const auto refine = [&](V v) HWY_ATTR {
    const V r = hn::NegMulAdd(hn::Mul(x, v), hn::Mul(v, v), hn::Set(d, 1.f));
    return hn::MulAdd(hn::Mul(v, r), hn::MulAdd(r, hn::Set(d, 2.f / 9.f), hn::Set(d, 1.f / 3.f)), v);
  };
  y = refine(refine(y));
  return hn::Mul(x, hn::Mul(y, y));
}

// log2 of a positive normal x. Absolute error below 2e-7 + 6e-8 |log2 x| (tested). x = 2^e m with m in [sqrt(1/2),
// sqrt(2)); log2 m = 2/ln 2 atanh(s), s = (m-1)/(m+1), |s| < 0.172: the series up to s^9 leaves 2e-10.
template <class D, class V = hn::Vec<D>> HWY_INLINE V fastLog2(D d, V x) {
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, x);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3f3504f3)));
  const V m = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const V one = hn::Set(d, 1.f);
  const V s = hn::Mul(hn::Sub(m, one), fastReciprocal(d, hn::Add(m, one))), s2 = hn::Mul(s, s);
  V series = hn::MulAdd(s2, hn::Set(d, 0.320598898f), hn::Set(d, 0.412198583f));
  series = hn::MulAdd(s2, series, hn::Set(d, 0.577078016f));
  series = hn::MulAdd(s2, series, hn::Set(d, 0.961796694f));
  series = hn::MulAdd(s2, series, hn::Set(d, 2.885390082f));
  return hn::MulAdd(s, series, hn::ConvertTo(d, exponent));
}

// 2^x for x in [-126, 126]. Relative error below 3e-7 (tested): the Taylor series of 2^f, |f| <= 1/2, up to f^6 leaves
// 1.3e-7.
template <class D, class V = hn::Vec<D>> HWY_INLINE V fastExp2(D d, V x) {
  const hn::RebindToSigned<D> di;
  const auto whole = hn::NearestInt(x);
  const V f = hn::Sub(x, hn::ConvertTo(d, whole));
  V series = hn::MulAdd(f, hn::Set(d, 0.000154035304f), hn::Set(d, 0.00133335581f));
  series = hn::MulAdd(f, series, hn::Set(d, 0.00961812911f));
  series = hn::MulAdd(f, series, hn::Set(d, 0.0555041087f));
  series = hn::MulAdd(f, series, hn::Set(d, 0.240226507f));
  series = hn::MulAdd(f, series, hn::Set(d, 0.693147181f));
  series = hn::MulAdd(f, series, hn::Set(d, 1.f));
  return hn::BitCast(d, hn::Add(hn::BitCast(di, series), hn::ShiftLeft<23>(whole)));
}

} // namespace parity::compare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
