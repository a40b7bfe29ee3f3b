// FLIP's colour constants: matrices between linear sRGB and XYZ divided by the white point, and what follows from them.
#pragma once

namespace parity::compare {

struct Matrix3 {
  float m[3][3];
};

namespace flip_constants {

// Linear sRGB to XYZ (D65) and back, and the white point: docs/flip-metric.md 2's rationals and digits, as in the
// reference code.
inline constexpr double kWhite[3] = {0.950428545, 1, 1.088900371}, kInverseWhite[3] = {1.052156925, 1, 0.918357670};
inline constexpr double kToXyz[3][3] = {
    {10135552. / 24577794, 8788810. / 24577794, 4435075. / 24577794},
    {2613072. / 12288897, 8788810. / 12288897, 887015. / 12288897},
    {1425312. / 73733382, 8788810. / 73733382, 70074185. / 73733382},
};
inline constexpr double kFromXyz[3][3] = {
    {3.241003275, -1.537398934, -0.498615861},
    {-0.969224334, 1.875930071, 0.041554224},
    {0.055639423, -0.204011202, 1.057148933},
};

// RGB to XYZ/white.
constexpr Matrix3 makeToXyz() {
  Matrix3 out{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out.m[i][j] = static_cast<float>(kToXyz[i][j] * kInverseWhite[i]);
  return out;
}

// RGB to (Y, X-Y, Y-Z), all of XYZ/white: the difference is taken in double, so that grey stays grey to 1e-9.
constexpr Matrix3 makeToOpponent() {
  Matrix3 out{};
  for (int j = 0; j < 3; ++j) {
    const double x = kToXyz[0][j] * kInverseWhite[0], y = kToXyz[1][j], z = kToXyz[2][j] * kInverseWhite[2];
    out.m[0][j] = static_cast<float>(y);
    out.m[1][j] = static_cast<float>(x - y);
    out.m[2][j] = static_cast<float>(y - z);
  }
  return out;
}

// (Y, X-Y, Y-Z) back to RGB: X = (X-Y) + Y, Z = Y - (Y-Z).
constexpr Matrix3 makeFromOpponent() {
  Matrix3 out{};
  for (int i = 0; i < 3; ++i) {
    const double x = kFromXyz[i][0] * kWhite[0], y = kFromXyz[i][1] * kWhite[1], z = kFromXyz[i][2] * kWhite[2];
    out.m[i][0] = static_cast<float>(x + y + z);
    out.m[i][1] = static_cast<float>(x);
    out.m[i][2] = static_cast<float>(-z);
  }
  return out;
}

inline constexpr Matrix3 kRgbToXyz = makeToXyz(), kRgbToOpponent = makeToOpponent(),
                         kOpponentToRgb = makeFromOpponent();

// HyAB^0.7 between pure green and pure blue, Hunt-adjusted (Andersson 2020, section 4.1.4): the largest in sRGB.
inline constexpr float kMaxColorDifference = 41.2760963f;

} // namespace flip_constants
} // namespace parity::compare
