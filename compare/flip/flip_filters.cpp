#include "compare/flip/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace parity::compare {
namespace {

using Half = std::vector<double>; // weights of 0, 1, ... radius

using std::numbers::pi;

// a*sqrt(pi/b)*exp(-pi^2 x^2/b), x = i/ppd degrees (Andersson 2020, eq. 3).
Half sensitivity(double a, double b, int radius, double ppd) {
  Half half(static_cast<std::size_t>(radius) + 1);
  for (int i = 0; i <= radius; ++i) {
    const double x = i / ppd;
    half[static_cast<std::size_t>(i)] = a * std::sqrt(pi / b) * std::exp(-pi * pi * x * x / b);
  }
  return half;
}

double sumOf(const Half& half) {
  double sum = half[0];
  for (std::size_t i = 1; i < half.size(); ++i) sum += 2 * half[i];
  return sum;
}

std::vector<float> scaled(const Half& half, double factor) {
  std::vector<float> out;
  for (double weight : half) out.push_back(static_cast<float>(weight * factor));
  return out;
}

// Drops the outermost weights as long as all that is dropped stays below 1e-7 of the sum: what float cannot see.
Half cut(Half half) {
  const double limit = 1e-7 * sumOf(half);
  double dropped = 0;
  while (half.size() > 2 && dropped + 2 * half.back() < limit) {
    dropped += 2 * half.back();
    half.pop_back();
  }
  return half;
}

} // namespace

int colorFilterRadius(float ppd) {
  return static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2 * pi * pi)) * static_cast<double>(ppd)));
}

FlipFilters makeFlipFilters(float pixelsPerDegree) {
  const double ppd = static_cast<double>(pixelsPerDegree);
  FlipFilters out;
  out.radius = colorFilterRadius(pixelsPerDegree);

  const Half luma = cut(sensitivity(1, 0.0047, out.radius, ppd));
  const Half redGreen = cut(sensitivity(1, 0.0053, out.radius, ppd));
  out.luma = scaled(luma, 1 / sumOf(luma));
  out.redGreen = scaled(redGreen, 1 / sumOf(redGreen));

  // In 2D the kernel is a sum of two Gaussians: each is the product of two 1D ones, which carry the root of the 2D
  // amplitude; together their 2D sums S1^2 + S2^2 come to 1.
  const auto rootOfAmplitude = [&](double a, double b) {
    Half half = sensitivity(1, b, out.radius, ppd); // amplitude sqrt(pi/b)
    for (double& weight : half) weight *= std::sqrt(a * std::sqrt(pi / b)) / std::sqrt(pi / b);
    return half;
  };
  const Half a = rootOfAmplitude(34.1, 0.04), b = rootOfAmplitude(13.5, 0.025);
  const double scale = 1 / std::hypot(sumOf(a), sumOf(b));
  out.blueYellowA = scaled(a, scale);
  out.blueYellowB = scaled(b, scale);

  const double sigma = 0.5 * 0.082 * ppd;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  Half gauss, edge, point;
  double edgeSum = 0, pointPositive = 0, pointNegative = 0;
  for (int i = 0; i <= radius; ++i) {
    const double x2 = i * i / (sigma * sigma), weight = std::exp(-0.5 * x2);
    gauss.push_back(weight);
    edge.push_back(-i * weight);
    point.push_back((x2 - 1) * weight);
    edgeSum += i * weight;
    const double both = i == 0 ? point.back() : 2 * point.back();
    (both > 0 ? pointPositive : pointNegative) += std::fabs(both);
  }
  for (double& weight : point) weight /= weight > 0 ? pointPositive : pointNegative;
  out.gauss = scaled(gauss, 1 / sumOf(gauss));
  out.edge = scaled(edge, 1 / edgeSum);
  out.point = scaled(point, 1);
  // The filters of Y are applied in one loop: luma's must be the shortest. (It is, but for ppd near 1.)
  for (std::vector<float>* half : {&out.gauss, &out.edge, &out.point})
    half->resize(std::max(half->size(), out.luma.size()), 0.f);
  return out;
}

} // namespace parity::compare
