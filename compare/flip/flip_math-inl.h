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

// Vectors that take the same steps side by side. A step waits for the one before: alone it leaves most of the processor
// idle.
template <class T> struct Two { T x, y; };
template <class T> struct Three { T x, y, z; };

// Applies a step to each of the vectors: one, or Two or Three (or Two of Two) side by side.
template <class F, class... T> HWY_INLINE auto each(F step, const T&... v) { return step(v...); }
template <class F, class... T> HWY_INLINE auto each(F step, const Two<T>&... v) {
  return Two<decltype(each(step, v.x...))>{each(step, v.x...), each(step, v.y...)};
}
template <class F, class... T> HWY_INLINE auto each(F step, const Three<T>&... v) {
  return Three<decltype(each(step, v.x...))>{each(step, v.x...), each(step, v.y...), each(step, v.z...)};
}

// Below x is one vector, or several side by side.

// x sum + k: a step of Horner's rule.
template <class D, class T> HWY_INLINE T multiplyAdd(D d, const T& x, const T& sum, float k) {
  using V = hn::Vec<D>;
  return each([d, k](V v, V w) HWY_ATTR { return hn::MulAdd(v, w, hn::Set(d, k)); }, x, sum);
}

// 1/x for normal x, by a step of Newton's on the processor's estimate: 12 bits of it become 23 (on x86; where the
// estimate has 8, 16 bits).
template <class D, class T> HWY_INLINE T fastReciprocal(D d, const T& x) {
  using V = hn::Vec<D>;
  return each(
      [d](V v) HWY_ATTR {
        const V y = hn::ApproximateReciprocal(v);
        return hn::Mul(y, hn::NegMulAdd(v, y, hn::Set(d, 2.f)));
      },
      x);
}

// Cube root of x in [1e-3, 2]. Relative error below 2.5e-7 (tested). No division: y approximates x^(-1/3), first on the
// bits of x (within 3.5 %), then by two steps y += y (r/3 + 2 r^2/9), r = 1 - x y^3, each of which leaves 14/81 r^3;
// the root is x y^2.
template <class D, class T> HWY_INLINE T fastCbrt(D d, const T& x) {
  using V = hn::Vec<D>;
  const hn::RebindToSigned<D> di;
  // 0x54a2f68c less a third of the bits. A float holds the bits to 2^-24: far below the 3.5 %. The result lies within
  // 2^25 of 2^30, where floats are multiples of 64. It is converted to an integer exactly: a 64th of it, less 2^24, is
  // added to 1.5 * 2^23, whose last bits hold the sum.
  T y = each(
      [d, di](V v) HWY_ATTR {
        const V bits = hn::ConvertTo(d, hn::BitCast(di, v));
        const V third = hn::MulAdd(bits, hn::Set(d, -1.f / 3.f), hn::Set(d, 1419966092.f));
        const V small = hn::MulAdd(third, hn::Set(d, 1.f / 64), hn::Set(d, 12582912.f - 16777216.f));
        return hn::BitCast(d, hn::Add(hn::ShiftLeft<6>(hn::BitCast(di, small)), hn::Set(di, 0x70000000)));
      },
      x);
  const auto refine = [&](const T& root) HWY_ATTR {
    const T r =
        each([d](V v, V w) HWY_ATTR { return hn::NegMulAdd(hn::Mul(v, w), hn::Mul(w, w), hn::Set(d, 1.f)); }, x, root);
    return each(
        [d](V w, V rest) HWY_ATTR {
          return hn::MulAdd(hn::Mul(w, rest), hn::MulAdd(rest, hn::Set(d, 2.f / 9.f), hn::Set(d, 1.f / 3.f)), w);
        },
        root, r);
  };
  y = refine(refine(y));
  return each([](V v, V w) HWY_ATTR { return hn::Mul(v, hn::Mul(w, w)); }, x, y);
}

// log2 of a positive normal x. Absolute error below 2e-7 + 6e-8 |log2 x| (tested). x = 2^e m with m in [sqrt(1/2),
// sqrt(2)); log2 m = 2/ln 2 atanh(s), s = (m-1)/(m+1), |s| < 0.172: the series up to s^9 leaves 2e-10.
template <class D, class T> HWY_INLINE T fastLog2(D d, const T& x) {
  using V = hn::Vec<D>;
  const hn::RebindToSigned<D> di;
  const auto exponent =
      each([di](V v) HWY_ATTR { return hn::ShiftRight<23>(hn::Sub(hn::BitCast(di, v), hn::Set(di, 0x3f3504f3))); }, x);
  const T m =
      each([d, di](V v, auto e) HWY_ATTR { return hn::BitCast(d, hn::Sub(hn::BitCast(di, v), hn::ShiftLeft<23>(e))); },
           x, exponent);
  const T inverse = fastReciprocal(d, each([d](V v) HWY_ATTR { return hn::Add(v, hn::Set(d, 1.f)); }, m));
  const T s = each([d](V v, V w) HWY_ATTR { return hn::Mul(hn::Sub(v, hn::Set(d, 1.f)), w); }, m, inverse);
  const T s2 = each([](V v) HWY_ATTR { return hn::Mul(v, v); }, s);
  T series = each([d](V v) HWY_ATTR { return hn::MulAdd(v, hn::Set(d, 0.320598898f), hn::Set(d, 0.412198583f)); }, s2);
  series = multiplyAdd(d, s2, series, 0.577078016f);
  series = multiplyAdd(d, s2, series, 0.961796694f);
  series = multiplyAdd(d, s2, series, 2.885390082f);
  return each([d](V v, V sum, auto e) HWY_ATTR { return hn::MulAdd(v, sum, hn::ConvertTo(d, e)); }, s, series,
              exponent);
}

// 2^x for x in [-126, 126]. Relative error below 3e-7 (tested): the Taylor series of 2^f, |f| <= 1/2, up to f^6 leaves
// 1.3e-7.
template <class D, class T> HWY_INLINE T fastExp2(D d, const T& x) {
  using V = hn::Vec<D>;
  const hn::RebindToSigned<D> di;
  // The last bits of 1.5 * 2^23 + x are the nearest integer, a negative one as two's complement.
  const V shift = hn::Set(d, 12582912.f);
  const T shifted = each([shift](V v) HWY_ATTR { return hn::Add(v, shift); }, x);
  const T f = each([shift](V v, V n) HWY_ATTR { return hn::Sub(v, hn::Sub(n, shift)); }, x, shifted);
  T series =
      each([d](V v) HWY_ATTR { return hn::MulAdd(v, hn::Set(d, 0.000154035304f), hn::Set(d, 0.00133335581f)); }, f);
  series = multiplyAdd(d, f, series, 0.00961812911f);
  series = multiplyAdd(d, f, series, 0.0555041087f);
  series = multiplyAdd(d, f, series, 0.240226507f);
  series = multiplyAdd(d, f, series, 0.693147181f);
  series = multiplyAdd(d, f, series, 1.f);
  return each(
      [d, di](V sum, V n)
          HWY_ATTR { return hn::BitCast(d, hn::Add(hn::BitCast(di, sum), hn::ShiftLeft<23>(hn::BitCast(di, n)))); },
      series, shifted);
}

} // namespace parity::compare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
