// A deliberately plain LDR-FLIP in double precision, written from the definition: no separable order tricks, no shared
// code with compare/. Slow; for small images.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "base/image/image.h"

namespace parity::oracle {

using Pixel = std::array<double, 3>;

struct Plane {
  int width, height;
  std::vector<double> values;
  double at(int x, int y) const { // replicated beyond the borders
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    return values[static_cast<std::size_t>(y * width + x)];
  }
};

using Kernel = std::vector<double>; // weights of -radius .. radius

inline Kernel makeKernel(int radius, const std::function<double(double)>& weight) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(weight(i));
  return kernel;
}

inline double sumOf(const Kernel& kernel) {
  double sum = 0;
  for (double w : kernel) sum += w;
  return sum;
}

inline Kernel scaled(Kernel kernel, double factor) {
  for (double& w : kernel) w *= factor;
  return kernel;
}

// Positive and negative weights scaled separately to +1 and -1.
inline Kernel balanced(Kernel kernel) {
  double positive = 0, negative = 0;
  for (double w : kernel) (w > 0 ? positive : negative) += std::fabs(w);
  for (double& w : kernel) w /= w > 0 ? positive : negative;
  return kernel;
}

// Along x with kx, then along y with ky.
inline Plane filter(const Plane& in, const Kernel& kx, const Kernel& ky) {
  const int rx = static_cast<int>(kx.size() / 2), ry = static_cast<int>(ky.size() / 2);
  Plane middle = in, out = in;
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      double sum = 0;
      for (int i = -rx; i <= rx; ++i) sum += kx[static_cast<std::size_t>(i + rx)] * in.at(x + i, y);
      middle.values[static_cast<std::size_t>(y * in.width + x)] = sum;
    }
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      double sum = 0;
      for (int i = -ry; i <= ry; ++i) sum += ky[static_cast<std::size_t>(i + ry)] * middle.at(x, y + i);
      out.values[static_cast<std::size_t>(y * in.width + x)] = sum;
    }
  return out;
}

inline double decodeSrgb(double c) {
  const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  return std::clamp(linear, 0., 1.);
}

inline Pixel toXyz(const Pixel& rgb) {
  return {(10135552 * rgb[0] + 8788810 * rgb[1] + 4435075 * rgb[2]) / 24577794,
          (2613072 * rgb[0] + 8788810 * rgb[1] + 887015 * rgb[2]) / 12288897,
          (1425312 * rgb[0] + 8788810 * rgb[1] + 70074185 * rgb[2]) / 73733382};
}

inline Pixel toYCxCz(const Pixel& rgb) {
  const Pixel xyz = toXyz(rgb);
  const double x = xyz[0] * 1.052156925, y = xyz[1], z = xyz[2] * 0.918357670;
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

inline Pixel fromYCxCz(const Pixel& c) {
  const double y = (c[0] + 16) / 116, x = (c[1] / 500 + y) * 0.950428545, z = (y - c[2] / 200) * 1.088900371;
  return {3.241003275 * x - 1.537398934 * y - 0.498615861 * z, -0.969224334 * x + 1.875930071 * y + 0.041554224 * z,
          0.055639423 * x - 0.204011202 * y + 1.057148933 * z};
}

// CIELab of clamped linear RGB, with Hunt's adjustment.
inline Pixel toHuntLab(const Pixel& rgb) {
  const Pixel xyz = toXyz({std::clamp(rgb[0], 0., 1.), std::clamp(rgb[1], 0., 1.), std::clamp(rgb[2], 0., 1.)});
  const auto f = [](double t) {
    constexpr double kDelta = 6. / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4. / 29;
  };
  const double fx = f(xyz[0] * 1.052156925), fy = f(xyz[1]), fz = f(xyz[2] * 0.918357670);
  const double l = 116 * fy - 16;
  return {l, 500 * (fx - fy) * 0.01 * l, 200 * (fy - fz) * 0.01 * l};
}

// HyAB^0.7 of two Hunt-adjusted colours.
inline double poweredHyab(const Pixel& a, const Pixel& b) {
  return std::pow(std::fabs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]), 0.7);
}

inline double largestColorDifference() {
  return poweredHyab(toHuntLab(fromYCxCz(toYCxCz({0, 1, 0}))), toHuntLab(fromYCxCz(toYCxCz({0, 0, 1}))));
}

inline double redistribute(double c, double cMax) {
  const double p = 0.4 * cMax;
  return c < p ? c * 0.95 / p : 0.95 + (c - p) / (cMax - p) * 0.05;
}

struct Seen { // one image as the eye's filters leave it
  std::vector<Pixel> lab;
  std::vector<double> edge, point;
};

// An image in linear light, [0,1].
struct Linear {
  int width, height;
  std::vector<Pixel> pixels;
};

inline Linear decode(const base::Image& image) {
  Linear out{image.width, image.height, {}};
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    const auto linear = [&](std::size_t c) { return decodeSrgb(static_cast<double>(image.pixels[3 * i + c])); };
    out.pixels.push_back({linear(0), linear(1), linear(2)});
  }
  return out;
}

inline Seen see(const Linear& image, double ppd) {
  constexpr double kPi = std::numbers::pi;
  const int w = image.width, h = image.height;
  std::array<Plane, 3> planes;
  for (Plane& plane : planes) plane = {w, h, std::vector<double>(image.pixels.size())};
  Plane gray = planes[0];
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Pixel color = toYCxCz(image.pixels[i]);
    for (std::size_t c = 0; c < 3; ++c) planes[c].values[i] = color[c];
    gray.values[i] = (color[0] + 16) / 116;
  }

  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd));
  const auto csf = [&](double amplitude, double b) {
    return makeKernel(radius, [=](double i) { return amplitude * std::exp(-kPi * kPi * (i / ppd) * (i / ppd) / b); });
  };
  Kernel luma = csf(1, 0.0047), redGreen = csf(1, 0.0053);
  luma = scaled(luma, 1 / sumOf(luma));
  redGreen = scaled(redGreen, 1 / sumOf(redGreen));
  Kernel first = csf(std::sqrt(34.1 * std::sqrt(kPi / 0.04)), 0.04);
  Kernel second = csf(std::sqrt(13.5 * std::sqrt(kPi / 0.025)), 0.025);
  const double s1 = sumOf(first), s2 = sumOf(second), scale = 1 / std::sqrt(s1 * s1 + s2 * s2);
  first = scaled(first, scale);
  second = scaled(second, scale);

  const Plane y = filter(planes[0], luma, luma), cx = filter(planes[1], redGreen, redGreen);
  const Plane cz1 = filter(planes[2], first, first), cz2 = filter(planes[2], second, second);

  const double sigma = 0.5 * 0.082 * ppd;
  const int featureRadius = static_cast<int>(std::ceil(3 * sigma));
  const auto gaussian = [=](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
  Kernel gauss = makeKernel(featureRadius, gaussian);
  gauss = scaled(gauss, 1 / sumOf(gauss));
  const Kernel edge = balanced(makeKernel(featureRadius, [=](double x) { return -x * gaussian(x); }));
  const Kernel point =
      balanced(makeKernel(featureRadius, [=](double x) { return (x * x / (sigma * sigma) - 1) * gaussian(x); }));
  const Plane edgeX = filter(gray, edge, gauss), edgeY = filter(gray, gauss, edge);
  const Plane pointX = filter(gray, point, gauss), pointY = filter(gray, gauss, point);

  Seen seen;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    seen.lab.push_back(toHuntLab(fromYCxCz({y.values[i], cx.values[i], cz1.values[i] + cz2.values[i]})));
    seen.edge.push_back(std::hypot(edgeX.values[i], edgeY.values[i]));
    seen.point.push_back(std::hypot(pointX.values[i], pointY.values[i]));
  }
  return seen;
}

struct Flip {
  std::vector<double> flip, color, feature;
};

inline Flip flip(const Linear& reference, const Linear& test, double ppd) {
  const Seen a = see(reference, ppd), b = see(test, ppd);
  const double cMax = largestColorDifference();
  Flip out;
  for (std::size_t i = 0; i < a.lab.size(); ++i) {
    out.color.push_back(redistribute(poweredHyab(a.lab[i], b.lab[i]), cMax));
    const double feature = std::max(std::fabs(a.edge[i] - b.edge[i]), std::fabs(a.point[i] - b.point[i]));
    out.feature.push_back(std::sqrt(feature / std::numbers::sqrt2));
    out.flip.push_back(std::pow(out.color.back(), 1 - out.feature.back()));
  }
  return out;
}

// Of display-encoded images.
inline Flip flip(const base::Image& reference, const base::Image& test, double ppd) {
  return flip(decode(reference), decode(test), ppd);
}

} // namespace parity::oracle
