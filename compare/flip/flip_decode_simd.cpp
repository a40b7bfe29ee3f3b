// Rows of pixels to the planes that FLIP filters; where rows differ; whether all is finite.
#include <algorithm>
#include <cstring>

#include "compare/flip/flip_constants.h"
#include "compare/flip/flip_simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/flip/flip_decode_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "compare/flip/flip_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace parity::compare::HWY_NAMESPACE {

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

struct Rgb {
  V r, g, b;
};

HWY_INLINE V clamp01(D d, V v) { return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.f)); }

// A polynomial of degree 11 by Estrin's scheme: a chain of 5 steps, where Horner's rule has 11. k: the constant first.
HWY_INLINE V evaluatePolynomial(D d, V x, const float (&k)[12]) {
  const V x2 = hn::Mul(x, x), x4 = hn::Mul(x2, x2), x8 = hn::Mul(x4, x4);
  const auto pair = [&](std::size_t i) HWY_ATTR { return hn::MulAdd(hn::Set(d, k[i + 1]), x, hn::Set(d, k[i])); };
  const V low = hn::MulAdd(pair(2), x2, pair(0)), middle = hn::MulAdd(pair(6), x2, pair(4)),
          high = hn::MulAdd(pair(10), x2, pair(8));
  return hn::MulAdd(high, x8, hn::MulAdd(middle, x4, low));
}

// IEC 61966-2-1, as docs/flip-metric.md 1b: c <= 0.04045 -> c/12.92, else ((c+0.055)/1.055)^2.4, here the Chebyshev
// interpolant of degree 11 over [0.04045, 1], within 6e-8. c in [0,1].
HWY_INLINE V decodeSrgb(D d, V c) {
  constexpr float kPower[] = {0.233240914f,    0.466891316f,    0.272591156f,     0.0303154423f,
                              -0.00377885563f, 0.00100312631f,  -0.000420915109f, 0.000193301703f,
                              1.83296325e-05f, -2.2498266e-05f, -8.51931863e-05f, 5.38866951e-05f};
  const V t = hn::MulAdd(c, hn::Set(d, static_cast<float>(2 / (1 - 0.04045))),
                         hn::Set(d, static_cast<float>(-(1 + 0.04045) / (1 - 0.04045))));
  const V power = evaluatePolynomial(d, t, kPower);
  return hn::IfThenElse(hn::Le(c, hn::Set(d, 0.04045f)), hn::Mul(c, hn::Set(d, 1.f / 12.92f)), power);
}

HWY_INLINE V tonemapRational(D d, const float* k, V x) {
  const V numerator = hn::MulAdd(hn::MulAdd(hn::Set(d, k[0]), x, hn::Set(d, k[1])), x, hn::Set(d, k[2]));
  const V denominator = hn::MulAdd(hn::MulAdd(hn::Set(d, k[3]), x, hn::Set(d, k[4])), x, hn::Set(d, k[5]));
  return clamp01(d, hn::Div(numerator, denominator));
}

template <Decoding kDecoding> HWY_INLINE Rgb toLinear(D d, const RowDecoder& decoder, Rgb c) {
  if constexpr (kDecoding == Decoding::srgb)
    return {decodeSrgb(d, clamp01(d, c.r)), decodeSrgb(d, clamp01(d, c.g)), decodeSrgb(d, clamp01(d, c.b))};
  if constexpr (kDecoding == Decoding::linear) return {clamp01(d, c.r), clamp01(d, c.g), clamp01(d, c.b)};
  // Exposed values stay below 1e18, so that their squares are finite.
  const V most = hn::Set(d, 1e18f), exposure = hn::Set(d, decoder.exposure);
  const auto expose = [&](V v) { return hn::Max(hn::Min(hn::Mul(v, exposure), most), hn::Neg(most)); };
  c = {expose(c.r), expose(c.g), expose(c.b)};
  if constexpr (kDecoding == Decoding::rational) {
    const float* k = decoder.coefficients;
    return {tonemapRational(d, k, c.r), tonemapRational(d, k, c.g), tonemapRational(d, k, c.b)};
  }
  V scale = hn::MulAdd(c.g, hn::Set(d, 0.7152f), hn::Set(d, 1.f));
  scale = hn::MulAdd(c.r, hn::Set(d, 0.2126f), hn::MulAdd(c.b, hn::Set(d, 0.0722f), scale));
  return {clamp01(d, hn::Div(c.r, scale)), clamp01(d, hn::Div(c.g, scale)), clamp01(d, hn::Div(c.b, scale))};
}

HWY_INLINE V multiplyRow(D d, const float* row, const Rgb& c) {
  return hn::MulAdd(hn::Set(d, row[0]), c.r, hn::MulAdd(hn::Set(d, row[1]), c.g, hn::Mul(hn::Set(d, row[2]), c.b)));
}

HWY_INLINE void storeOpponent(D d, const Rgb& c, int at, const ColorPlanes& out) {
  const auto& m = flip_constants::kRgbToOpponent.m;
  hn::StoreU(multiplyRow(d, m[0], c), d, out.y + at);
  hn::StoreU(multiplyRow(d, m[1], c), d, out.xMinusY + at);
  hn::StoreU(multiplyRow(d, m[2], c), d, out.yMinusZ + at);
}

template <Decoding kDecoding, int kChannels> HWY_INLINE void
decodeFloats(const RowDecoder& decoder, const float* pixels, int count, int at, const ColorPlanes& out) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int i = 0; i < count; i += lanes) {
    Rgb c;
    [[maybe_unused]] V alpha;
    if constexpr (kChannels == 3)
      hn::LoadInterleaved3(d, pixels + 3 * i, c.r, c.g, c.b);
    else
      hn::LoadInterleaved4(d, pixels + 4 * i, c.r, c.g, c.b, alpha);
    storeOpponent(d, toLinear<kDecoding>(d, decoder, c), at + i, out);
  }
}

// Decodes a row by decodeVectors(pixels, count, at): whole vectors of `count` pixels from `pixels` on, to column `at`.
// Vectors must not read beyond the row. Its last one ends with it, over pixels that are decoded already; a row that is
// shorter than a vector is copied first.
template <int kChannels, class T, class F> HWY_INLINE void forRow(const T* pixels, int count, F decodeVectors) {
  constexpr int kMaxLanes = static_cast<int>(hn::MaxLanes(D()));
  const int lanes = static_cast<int>(hn::Lanes(D())), whole = count / lanes * lanes;
  if (whole > 0) {
    decodeVectors(pixels, whole, 0);
    if (whole < count) decodeVectors(pixels + (count - lanes) * kChannels, lanes, count - lanes);
  } else {
    alignas(64) T copy[kMaxLanes * kChannels] = {};
    std::memcpy(copy, pixels, static_cast<std::size_t>(count * kChannels) * sizeof(T));
    decodeVectors(copy, lanes, 0);
  }
}

template <Decoding kDecoding, int kChannels>
void decodeFloatRow(const RowDecoder& decoder, const float* pixels, int count, const ColorPlanes& out) {
  forRow<kChannels>(pixels, count, [&](const float* from, int size, int at) HWY_ATTR {
    decodeFloats<kDecoding, kChannels>(decoder, from, size, at, out);
  });
}

template <int kChannels>
void decodeFloatRowAny(const RowDecoder& decoder, const float* pixels, int count, const ColorPlanes& out) {
  switch (decoder.decoding) {
  case Decoding::srgb:
    return decodeFloatRow<Decoding::srgb, kChannels>(decoder, pixels, count, out);
  case Decoding::linear:
    return decodeFloatRow<Decoding::linear, kChannels>(decoder, pixels, count, out);
  case Decoding::rational:
    return decodeFloatRow<Decoding::rational, kChannels>(decoder, pixels, count, out);
  case Decoding::reinhard:
    return decodeFloatRow<Decoding::reinhard, kChannels>(decoder, pixels, count, out);
  }
}

void DecodeFloats(const RowDecoder& decoder, const float* pixels, int channels, int count, const ColorPlanes& out) {
  if (channels == 3)
    decodeFloatRowAny<3>(decoder, pixels, count, out);
  else
    decodeFloatRowAny<4>(decoder, pixels, count, out);
}

template <int kChannels>
HWY_INLINE void decodeBytes(const std::uint8_t* pixels, int count, int at, const ColorPlanes& out) {
  const D d;
  const hn::Rebind<std::uint8_t, D> d8;
  const hn::RebindToSigned<D> di;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto toFloat = [&](hn::Vec<decltype(d8)> v) HWY_ATTR {
    return hn::Mul(hn::ConvertTo(d, hn::PromoteTo(di, v)), hn::Set(d, 1.f / 255.f));
  };
  for (int i = 0; i < count; i += lanes) {
    hn::Vec<decltype(d8)> r, g, b;
    [[maybe_unused]] hn::Vec<decltype(d8)> alpha;
    if constexpr (kChannels == 3)
      hn::LoadInterleaved3(d8, pixels + 3 * i, r, g, b);
    else
      hn::LoadInterleaved4(d8, pixels + 4 * i, r, g, b, alpha);
    storeOpponent(d, {decodeSrgb(d, toFloat(r)), decodeSrgb(d, toFloat(g)), decodeSrgb(d, toFloat(b))}, at + i, out);
  }
}

template <int kChannels> void decodeByteRow(const std::uint8_t* pixels, int count, const ColorPlanes& out) {
  forRow<kChannels>(pixels, count, [&](const std::uint8_t* from, int size, int at) HWY_ATTR {
    decodeBytes<kChannels>(from, size, at, out);
  });
}

void DecodeBytes(const std::uint8_t* pixels, int channels, int count, const ColorPlanes& out) {
  if (channels == 3)
    decodeByteRow<3>(pixels, count, out);
  else
    decodeByteRow<4>(pixels, count, out);
}

void SubtractRow(const float* a, const float* b, std::size_t count, float* out) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) hn::StoreU(hn::Sub(hn::LoadU(d, a + i), hn::LoadU(d, b + i)), d, out + i);
  for (; i < count; ++i) out[i] = a[i] - b[i];
}

bool AllFinite(const float* values, std::size_t count) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  // x * 0 is 0 unless x is not finite.
  V sum = hn::Zero(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) sum = hn::MulAdd(hn::LoadU(d, values + i), hn::Zero(d), sum);
  float rest = 0;
  for (; i < count; ++i) rest += values[i] * 0.f;
  return hn::AllTrue(d, hn::Eq(sum, hn::Zero(d))) && rest == 0.f;
}

} // namespace parity::compare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::compare {
namespace {

HWY_EXPORT(DecodeFloats);
HWY_EXPORT(DecodeBytes);
HWY_EXPORT(AllFinite);
HWY_EXPORT(SubtractRow);

} // namespace

void decodeRow(const std::uint8_t* pixels, int channels, int count, const ColorPlanes& out) {
  HWY_DYNAMIC_DISPATCH(DecodeBytes)(pixels, channels, count, out);
}

void decodeRow(const RowDecoder& decoder, const float* pixels, int channels, int count, const ColorPlanes& out) {
  HWY_DYNAMIC_DISPATCH(DecodeFloats)(decoder, pixels, channels, count, out);
}

void subtractRow(const float* a, const float* b, std::size_t count, float* out) {
  HWY_DYNAMIC_DISPATCH(SubtractRow)(a, b, count, out);
}

bool allFinite(const float* values, std::size_t count) { return HWY_DYNAMIC_DISPATCH(AllFinite)(values, count); }

void markDifferences(const void* a, const void* b, std::size_t count, std::size_t cell, std::uint64_t* bits) {
  const auto *left = static_cast<const std::byte*>(a), *right = static_cast<const std::byte*>(b);
  // Whole rows are mostly equal or mostly not: one call settles the equal ones.
  if (std::memcmp(left, right, count) == 0) return;
  const auto differs = [&](std::size_t begin, std::size_t size) {
    // Cells that differ mostly do so at once.
    std::uint64_t x = 0, y = 0;
    if (size >= sizeof(x)) {
      std::memcpy(&x, left + begin, sizeof(x));
      std::memcpy(&y, right + begin, sizeof(y));
    }
    return x != y || std::memcmp(left + begin, right + begin, size) != 0;
  };
  for (std::size_t begin = 0, i = 0; begin < count; begin += cell, ++i)
    if (differs(begin, std::min(cell, count - begin))) bits[i / 64] |= std::uint64_t{1} << (i % 64);
}

} // namespace parity::compare
#endif
