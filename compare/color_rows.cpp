#include "compare/color_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "compare/vector_math.h"

namespace parity::compare {
namespace {

constexpr int kGrainRows = 8;
constexpr int kChunk = 64; // pixels held on the stack

// IEC 61966-2-1: c <= 0.04045 -> c/12.92, else ((c+0.055)/1.055)^2.4.
std::array<float, 256> makeDecodeTable() {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const double c = i / 255.;
    table[static_cast<std::size_t>(i)] =
        static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return table;
}

inline float clamp01(float v) { return v < 0.f ? 0.f : v > 1.f ? 1.f : v; }

inline float decodeSrgb(float c) {
  const float low = c * (1.f / 12.92f), high = fastPow((c + 0.055f) * (1.f / 1.055f), 2.4f);
  return c <= 0.04045f ? low : high;
}

// f(t) of CIE 1976: t^(1/3) above (6/29)^3, else t/(3 (6/29)^2) + 4/29. t in [0, 1.1].
inline float labFunction(float t) {
  constexpr float kDelta = 6.f / 29.f;
  const float root = fastCbrt(t > 1e-6f ? t : 1e-6f), line = t * (1.f / (3.f * kDelta * kDelta)) + 4.f / 29.f;
  return t > kDelta * kDelta * kDelta ? root : line;
}

// Linear Rec.709 to XYZ of D65 (FLIP.md's rationals: sRGB's primaries in exact numbers), each row over its white, so
// that (1,1,1) becomes (1,1,1).
constexpr float kToXyz[3][3] = {
    {static_cast<float>(10135552. / 23359437), static_cast<float>(8788810. / 23359437),
     static_cast<float>(4435075. / 23359437)},
    {static_cast<float>(2613072. / 12288897), static_cast<float>(8788810. / 12288897),
     static_cast<float>(887015. / 12288897)},
    {static_cast<float>(1425312. / 80288307), static_cast<float>(8788810. / 80288307),
     static_cast<float>(70074185. / 80288307)},
};

} // namespace

void readDisplayRow(const PixelView& view, int x, int y, int count, float* __restrict rgb) {
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(y) * view.stride + static_cast<std::ptrdiff_t>(x) * 3;
  if (view.floats) {
    std::copy_n(view.floats + at, 3 * count, rgb);
    return;
  }
  const std::uint8_t* bytes = view.bytes + at;
  for (int i = 0; i < 3 * count; ++i) rgb[i] = static_cast<float>(bytes[i]) / 255.f;
}

void readLinearRow(const PixelView& view, const base::Image* linear, int x, int y, int count, float* __restrict rgb) {
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(y) * view.stride + static_cast<std::ptrdiff_t>(x) * 3;
  if (linear) {
    std::copy_n(linear->at(x, y), 3 * count, rgb);
  } else if (view.floats) {
    const float* in = view.floats + at;
    for (int i = 0; i < 3 * count; ++i) rgb[i] = decodeSrgb(clamp01(in[i]));
  } else {
    static const std::array<float, 256> kTable = makeDecodeTable();
    const std::uint8_t* in = view.bytes + at;
    for (int i = 0; i < 3 * count; ++i) rgb[i] = kTable[in[i]];
  }
}

void lumaRow(const float* rgb, int count, float* __restrict luma) {
  for (int i = 0; i < count; ++i) luma[i] = 0.2126f * rgb[3 * i] + 0.7152f * rgb[3 * i + 1] + 0.0722f * rgb[3 * i + 2];
}

void labRow(const float* linearRgb, int count, const LabRow& lab) {
  float plane[3][kChunk];
  for (int begin = 0; begin < count; begin += kChunk) {
    const int n = std::min(kChunk, count - begin);
    const float* in = linearRgb + 3 * static_cast<std::ptrdiff_t>(begin);
    for (int i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c) plane[c][i] = clamp01(in[3 * i + c]);
    float *l = lab.l + begin, *a = lab.a + begin, *b = lab.b + begin;
    for (int i = 0; i < n; ++i) {
      float f[3];
      for (int c = 0; c < 3; ++c)
        f[c] = labFunction(kToXyz[c][0] * plane[0][i] + kToXyz[c][1] * plane[1][i] + kToXyz[c][2] * plane[2][i]);
      l[i] = 116.f * f[1] - 16.f;
      a[i] = 500.f * (f[0] - f[1]);
      b[i] = 200.f * (f[1] - f[2]);
    }
  }
}

void forRows(const Rect& box, const std::function<void(int y)>& body) {
  if (box.empty()) return;
  base::parallelFor(static_cast<std::size_t>(box.height), kGrainRows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) body(box.y + static_cast<int>(row));
  });
}

} // namespace parity::compare
