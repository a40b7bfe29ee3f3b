#include "compare/flip_color.h"

#include <algorithm>
#include <cmath>

#include "compare/vector_math.h"

namespace parity::compare {
namespace {

// Linear sRGB to XYZ (D65), each row times 1/white; and back. FLIP.md: rationals and digits as in the reference code.
constexpr double kInverseWhite[3] = {1.052156925, 1, 0.918357670};
constexpr double kWhite[3] = {0.950428545, 1, 1.088900371};
constexpr double kToXyz[3][3] = {
    {10135552. / 24577794, 8788810. / 24577794, 4435075. / 24577794},
    {2613072. / 12288897, 8788810. / 12288897, 887015. / 12288897},
    {1425312. / 73733382, 8788810. / 73733382, 70074185. / 73733382},
};
constexpr double kFromXyz[3][3] = {
    {3.241003275, -1.537398934, -0.498615861},
    {-0.969224334, 1.875930071, 0.041554224},
    {0.055639423, -0.204011202, 1.057148933},
};

struct Matrix {
  float m[3][3];
};
constexpr Matrix makeToNormalisedXyz() {
  Matrix out{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out.m[i][j] = static_cast<float>(kToXyz[i][j] * kInverseWhite[i]);
  return out;
}
constexpr Matrix makeFromNormalisedXyz() {
  Matrix out{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out.m[i][j] = static_cast<float>(kFromXyz[i][j] * kWhite[j]);
  return out;
}
constexpr Matrix kToNormalisedXyz = makeToNormalisedXyz(), kFromNormalisedXyz = makeFromNormalisedXyz();

inline float clamp01(float v) { return v < 0.f ? 0.f : v > 1.f ? 1.f : v; }

struct Triple {
  float x, y, z;
};
inline Triple multiply(const Matrix& a, float x, float y, float z) {
  return {a.m[0][0] * x + a.m[0][1] * y + a.m[0][2] * z, //
          a.m[1][0] * x + a.m[1][1] * y + a.m[1][2] * z, //
          a.m[2][0] * x + a.m[2][1] * y + a.m[2][2] * z};
}

// IEC 61966-2-1, as FLIP.md: c <= 0.04045 -> c/12.92, else ((c+0.055)/1.055)^2.4. c in [0,1].
inline float decodeSrgb(float c) {
  const float low = c * (1.f / 12.92f), high = fastPow((c + 0.055f) * (1.f / 1.055f), 2.4f);
  return c <= 0.04045f ? low : high;
}

// CIE 1976 lightness function: t^(1/3) above (6/29)^3, else t/(3 (6/29)^2) + 4/29. t in [0, 1.1].
inline float lightness(float t) {
  constexpr float kDelta = 6.f / 29.f;
  const float root = fastCbrt(t > 1e-6f ? t : 1e-6f), line = t * (1.f / (3.f * kDelta * kDelta)) + 4.f / 29.f;
  return t > kDelta * kDelta * kDelta ? root : line;
}

// Filtered YCxCz to CIELab through clamped linear RGB, a and b scaled by 0.01 L (Hunt).
inline Triple toHuntLab(float yy, float cx, float cz) {
  const float y = (yy + 16.f) * (1.f / 116.f);
  const Triple rgb = multiply(kFromNormalisedXyz, cx * (1.f / 500.f) + y, y, y - cz * (1.f / 200.f));
  const Triple xyz = multiply(kToNormalisedXyz, clamp01(rgb.x), clamp01(rgb.y), clamp01(rgb.z));
  const float fx = lightness(xyz.x), fy = lightness(xyz.y), fz = lightness(xyz.z);
  const float l = 116.f * fy - 16.f;
  return {l, 500.f * (fx - fy) * (0.01f * l), 200.f * (fy - fz) * (0.01f * l)};
}

constexpr int kChunk = 64; // pixels whose planes are held on the stack

} // namespace

bool isEightBit(const base::Image& image) {
  constexpr std::size_t kBlock = 4096;
  for (std::size_t begin = 0; begin < image.pixels.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, image.pixels.size());
    int odd = 0;
    for (std::size_t i = begin; i < end; ++i) {
      // 1e-5 of a step: i/255 and i*(1/255) in float are both whole 255ths. A far value must not overflow the cast.
      const float steps = 255.f * clamp01(image.pixels[i]);
      odd += std::fabs(steps - static_cast<float>(static_cast<int>(steps + 0.5f))) > 2e-5f;
    }
    if (odd > 0) return false;
  }
  return true;
}

RowDecoder::RowDecoder(bool eightBit) : m_eightBit(eightBit) {
  for (int i = 0; i < 256; ++i) {
    const double c = i / 255.;
    m_table[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
}

void RowDecoder::decode(const float* rgb, int count, float* __restrict y, float* __restrict cx,
                        float* __restrict cz) const {
  for (int begin = 0; begin < count; begin += kChunk) {
    const int n = std::min(kChunk, count - begin);
    const float* in = rgb + 3 * static_cast<std::ptrdiff_t>(begin);
    float linear[3 * kChunk];
    if (m_eightBit)
      for (int i = 0; i < 3 * n; ++i) linear[i] = m_table[static_cast<int>(255.f * clamp01(in[i]) + 0.5f)];
    else
      for (int i = 0; i < 3 * n; ++i) linear[i] = decodeSrgb(clamp01(in[i]));
    for (int i = 0; i < n; ++i) {
      const Triple xyz = multiply(kToNormalisedXyz, linear[3 * i], linear[3 * i + 1], linear[3 * i + 2]);
      y[begin + i] = 116.f * xyz.y - 16.f;
      cx[begin + i] = 500.f * (xyz.x - xyz.y);
      cz[begin + i] = 200.f * (xyz.y - xyz.z);
    }
  }
}

void colorDifferenceRow(const ColorRow& reference, const ColorRow& test, int count, float* __restrict out) {
  constexpr float kKnee = 0.4f * kMaxColorDifference;
  for (int i = 0; i < count; ++i) {
    const Triple a = toHuntLab(reference.y[i], reference.cx[i], reference.cz[i]);
    const Triple b = toHuntLab(test.y[i], test.cx[i], test.cz[i]);
    const float da = a.y - b.y, db = a.z - b.z;
    const float hyab = std::fabs(a.x - b.x) + std::sqrt(da * da + db * db);
    const float power = fastPow(hyab > 1e-20f ? hyab : 1e-20f, 0.7f);
    const float low = power * (0.95f / kKnee);
    const float high = 0.95f + (power - kKnee) * (0.05f / (kMaxColorDifference - kKnee));
    const float c = power < kKnee ? low : high;
    out[i] = hyab > 0.f ? (c < 1.f ? c : 1.f) : 0.f;
  }
}

void featureDifferenceRow(const FeatureRow& reference, const FeatureRow& test, int count, float* __restrict out) {
  constexpr float kScale = static_cast<float>(1 / (116 * 1.4142135623730951)); // Y to (Y+16)/116, and 1/sqrt 2
  for (int i = 0; i < count; ++i) {
    const float edge = std::fabs(reference.edge[i] - test.edge[i]);
    const float point = std::fabs(reference.point[i] - test.point[i]);
    const float f = std::sqrt((edge > point ? edge : point) * kScale);
    out[i] = f < 1.f ? f : 1.f;
  }
}

void combineRow(const float* color, const float* feature, int count, float* __restrict out) {
  for (int i = 0; i < count; ++i) {
    const float c = color[i];
    const float flip = fastPow(c > 1e-30f ? c : 1e-30f, 1.f - feature[i]);
    out[i] = c > 0.f ? (flip < 1.f ? flip : 1.f) : 0.f;
  }
}

} // namespace parity::compare
