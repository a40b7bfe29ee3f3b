// Whether sampled directions follow the density that is stated for them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

namespace parity::tests {

// Chi^2 of a histogram over (height, azimuth) of the hemisphere against the integral of the density, by independent
// random points; the statistic is within 5 sigma of its mean, the degrees of freedom.
template <typename Sample, typename Pdf>
void expectDensity(const Sample& sample, const Pdf& pdf, double total, double slack) {
  constexpr int kRows = 12, kColumns = 16, kSub = 24, kCount = 200000;
  std::vector<double> expected(kRows * kColumns, 0.0), seen(kRows * kColumns, 0.0);
  double integral = 0;
  for (int r = 0; r < kRows * kSub; ++r)
    for (int c = 0; c < kColumns * kSub; ++c) {
      const double z = (r + 0.5) / (kRows * kSub), phi = (c + 0.5) / (kColumns * kSub) * 2 * std::numbers::pi;
      const double s = std::sqrt(1 - z * z);
      const double mass =
          pdf({s * std::cos(phi), s * std::sin(phi), z}) * 2 * std::numbers::pi / (kRows * kSub * kColumns * kSub);
      expected[static_cast<std::size_t>(r / kSub * kColumns + c / kSub)] += mass;
      integral += mass;
    }
  EXPECT_NEAR(integral, total, slack);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < kCount; ++i) {
    const double u = uniform(random), v = uniform(random);
    const glm::dvec3 d = sample(glm::dvec2(u, v));
    ASSERT_NEAR(glm::length(d), 1, 1e-9);
    if (!(d.z > 0)) continue;
    const int row = std::min(static_cast<int>(d.z * kRows), kRows - 1);
    double phi = std::atan2(d.y, d.x);
    if (phi < 0) phi += 2 * std::numbers::pi;
    const int column = std::min(static_cast<int>(phi / (2 * std::numbers::pi) * kColumns), kColumns - 1);
    seen[static_cast<std::size_t>(row * kColumns + column)] += 1.0 / kCount;
  }
  double chi2 = 0;
  int cells = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] * kCount < 10) continue;
    const double d = (seen[i] - expected[i]) * kCount;
    chi2 += d * d / (expected[i] * kCount);
    ++cells;
  }
  ASSERT_GT(cells, 20);
  EXPECT_LT(std::abs(chi2 - cells), 5 * std::sqrt(2.0 * cells)) << cells << " cells";
}

} // namespace parity::tests
