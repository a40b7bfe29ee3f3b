#include "compare/metrics/color_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "compare/metrics/vector_math.h"

// The loops are plain: the compiler makes vectors of them for each instruction set that Highway names.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/metrics/color_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace parity::compare::HWY_NAMESPACE {

constexpr int kChunk = 64; // pixels held on the stack

inline float clamp01(float v) { return v < 0.f ? 0.f : v > 1.f ? 1.f : v; }

// IEC 61966-2-1: c <= 0.04045 -> c/12.92, else ((c+0.055)/1.055)^2.4. c in [0,1].
inline float decodeSrgb(float c) {
  const float low = c * (1.f / 12.92f), high = fastPow((c + 0.055f) * (1.f / 1.055f), 2.4f);
  return c <= 0.04045f ? low : high;
}

// f(t) of CIE 1976: t^(1/3) above (6/29)^3, else t/(3 (6/29)^2) + 4/29. t in [0, 1.1].
inline float labFunction(float t) {
  constexpr float kDelta = 6.f / 29.f;
  const float root = fastCbrt(t > 1e-3f ? t : 1e-3f), line = t * (1.f / (3.f * kDelta * kDelta)) + 4.f / 29.f;
  return t > kDelta * kDelta * kDelta ? root : line;
}

// Linear Rec.709 to XYZ of D65 (docs/flip-metric.md 2's rationals: sRGB's primaries in exact numbers), each row over
// its white, so that (1,1,1) becomes (1,1,1).
constexpr float kToXyz[3][3] = {
    {static_cast<float>(10135552. / 23359437), static_cast<float>(8788810. / 23359437),
     static_cast<float>(4435075. / 23359437)},
    {static_cast<float>(2613072. / 12288897), static_cast<float>(8788810. / 12288897),
     static_cast<float>(887015. / 12288897)},
    {static_cast<float>(1425312. / 80288307), static_cast<float>(8788810. / 80288307),
     static_cast<float>(70074185. / 80288307)},
};

void ScaleBytes(const std::uint8_t* __restrict in, int count, float* __restrict out) {
  for (int i = 0; i < count; ++i) out[i] = static_cast<float>(in[i]) / 255.f;
}

void DecodeFloats(const float* __restrict in, int count, float* __restrict out) {
  for (int i = 0; i < count; ++i) out[i] = decodeSrgb(clamp01(in[i]));
}

void Luma(const float* __restrict rgb, int count, float* __restrict luma) {
  for (int i = 0; i < count; ++i) luma[i] = 0.2126f * rgb[3 * i] + 0.7152f * rgb[3 * i + 1] + 0.0722f * rgb[3 * i + 2];
}

void Lab(const float* __restrict linearRgb, int count, const LabRow& lab) {
  float plane[3][kChunk];
  for (int begin = 0; begin < count; begin += kChunk) {
    const int n = count - begin < kChunk ? count - begin : kChunk;
    const float* in = linearRgb + 3 * static_cast<std::ptrdiff_t>(begin);
    for (int i = 0; i < n; ++i) {
      plane[0][i] = clamp01(in[3 * i]);
      plane[1][i] = clamp01(in[3 * i + 1]);
      plane[2][i] = clamp01(in[3 * i + 2]);
    }
    float* __restrict l = lab.l + begin, * __restrict a = lab.a + begin, * __restrict b = lab.b + begin;
    for (int i = 0; i < n; ++i) {
      const float red = plane[0][i], green = plane[1][i], blue = plane[2][i];
      const float x = labFunction(kToXyz[0][0] * red + kToXyz[0][1] * green + kToXyz[0][2] * blue);
      const float y = labFunction(kToXyz[1][0] * red + kToXyz[1][1] * green + kToXyz[1][2] * blue);
      const float z = labFunction(kToXyz[2][0] * red + kToXyz[2][1] * green + kToXyz[2][2] * blue);
      l[i] = 116.f * y - 16.f;
      a[i] = 500.f * (x - y);
      b[i] = 200.f * (y - z);
    }
  }
}

} // namespace parity::compare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::compare {
namespace {

constexpr int kGrainRows = 8;

HWY_EXPORT(ScaleBytes);
HWY_EXPORT(DecodeFloats);
HWY_EXPORT(Luma);
HWY_EXPORT(Lab);

std::array<float, 256> makeDecodeTable() {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const double c = i / 255.;
    table[static_cast<std::size_t>(i)] =
        static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return table;
}

std::ptrdiff_t offsetOf(const PixelView& view, int x, int y) {
  return static_cast<std::ptrdiff_t>(y) * view.stride + static_cast<std::ptrdiff_t>(x) * 3;
}

} // namespace

void readDisplayRow(const PixelView& view, int x, int y, int count, float* rgb) {
  if (view.floats)
    std::copy_n(view.floats + offsetOf(view, x, y), 3 * count, rgb);
  else
    HWY_DYNAMIC_DISPATCH(ScaleBytes)(view.bytes + offsetOf(view, x, y), 3 * count, rgb);
}

void readLinearRow(const PixelView& view, const base::Image* linear, int x, int y, int count, float* __restrict rgb) {
  if (linear) {
    std::copy_n(linear->at(x, y), 3 * count, rgb);
  } else if (view.floats) {
    HWY_DYNAMIC_DISPATCH(DecodeFloats)(view.floats + offsetOf(view, x, y), 3 * count, rgb);
  } else {
    static const std::array<float, 256> kTable = makeDecodeTable();
    const std::uint8_t* in = view.bytes + offsetOf(view, x, y);
    for (int i = 0; i < 3 * count; ++i) rgb[i] = kTable[in[i]];
  }
}

void lumaRow(const float* rgb, int count, float* luma) { HWY_DYNAMIC_DISPATCH(Luma)(rgb, count, luma); }

void labRow(const float* linearRgb, int count, const LabRow& lab) { HWY_DYNAMIC_DISPATCH(Lab)(linearRgb, count, lab); }

void forRows(const Rect& box, const std::function<void(int y)>& body) {
  if (box.empty()) return;
  base::parallelFor(static_cast<std::size_t>(box.height), kGrainRows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) body(box.y + static_cast<int>(row));
  });
}

} // namespace parity::compare
#endif
