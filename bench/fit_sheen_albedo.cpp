// Prints the constants of sheenAlbedoFit (shading/sheen.glsl) with their errors: build/fit_sheen_albedo; a minute.
//
// The fit is to the albedo clamped to 1, as it is used, over NoV .02 to 1 and roughness .07 to 1. What is least is the
// mean square error plus the square of the 8th-power mean, which holds the greatest error down.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "reference/sheen_albedo.h"
#include "study/fit/minimise.h"

namespace {

constexpr int kTerms = 10;

struct Point {
  double albedo;
  std::array<double, kTerms> terms;
};

std::vector<Point> makePoints(int steps) {
  const parity::reference::SheenAlbedo table;
  std::vector<Point> points;
  for (int i = 0; i <= steps; ++i)
    for (int k = 0; k <= steps; ++k) {
      const double r = 0.07 + 0.93 * i / steps, N = 0.02 + 0.98 * k / steps, s = std::sqrt(N), u = 1 / r;
      points.push_back(
          {table.shareAt(r, N), {1, u, r, r * r, s * u * u, s * u, s * r, N * u, N * u * u, N * N * u * u}});
    }
  return points;
}

struct Errors {
  double rms, mean8, max;
};
Errors errorsOf(const std::vector<Point>& points, const std::vector<double>& c) {
  double squares = 0, eighths = 0, worst = 0;
  for (const Point& point : points) {
    double exponent = 0;
    for (int t = 0; t < kTerms; ++t)
      exponent += c[static_cast<std::size_t>(t)] * point.terms[static_cast<std::size_t>(t)];
    const double error = std::min(std::exp2(std::min(exponent, 8.0)), 1.0) - point.albedo;
    squares += error * error;
    eighths += std::pow(error, 8);
    worst = std::max(worst, std::abs(error));
  }
  const auto count = static_cast<double>(points.size());
  return {std::sqrt(squares / count), std::pow(eighths / count, 0.125), worst};
}

} // namespace

int main() {
  const std::vector<Point> coarse = makePoints(48), fine = makePoints(240);
  // A least-squares fit by hand; term by term as above.
  std::vector<double> c = {-2.505, 0.6026, 3.1755, -1.1006, -0.1395, -0.6601, -0.9005, -0.9302, 0.3177, -0.465};
  c = parity::fit::minimise(
          [&](const std::vector<double>& x) {
            const Errors e = errorsOf(coarse, x);
            return e.rms * e.rms + 0.25 * e.mean8 * e.mean8;
          },
          c)
          .x;
  for (double& x : c) x = std::round(x * 1e4) / 1e4;
  const Errors e = errorsOf(fine, c);
  for (const double x : c) std::printf("R(%.4f) ", x);
  std::printf("\nrms %.4f, max %.4f\n", e.rms, e.max);
}
