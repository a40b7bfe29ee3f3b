// Sample points are stratified, and directions follow their densities.
#include "reference/sampling.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "reference/direction_density.h"
#include "shading/shading.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

// A (0,2)-sequence: the first 2^k points put exactly one into each elementary interval of area 2^-k (Sobol 1967), which
// Owen's scrambling keeps.
TEST(Sobol, FirstPointsFillEveryElementaryIntervalOnce) {
  for (const std::uint32_t seed : {0u, 1u, 77u, 0xdeadbeefu})
    for (const int k : {1, 4, 10}) {
      const std::uint32_t count = 1u << k;
      for (int a = 0; a <= k; ++a) {
        std::set<std::uint32_t> hit;
        for (std::uint32_t i = 0; i < count; ++i) {
          const glm::dvec2 p = sobolPoint(i, seed);
          ASSERT_TRUE(p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1);
          hit.insert(static_cast<std::uint32_t>(std::ldexp(p.x, a)) << (k - a) |
                     static_cast<std::uint32_t>(std::ldexp(p.y, k - a)));
        }
        ASSERT_EQ(hit.size(), count) << "seed " << seed << ", 2^" << k << " points, split " << a;
      }
    }
}

// Direction numbers of Sobol's second dimension, v_k = v_(k-1) ^ v_(k-1) >> 1, added bit by bit.
TEST(Sobol, SecondDimensionIsThatOfTheDirectionNumbers) {
  for (const std::uint32_t index : {0u, 1u, 2u, 3u, 4u, 5u, 100u, 65535u, 0x12345678u, 0xffffffffu}) {
    std::uint32_t direction = 0x80000000u, expected = 0;
    for (std::uint32_t bits = index; bits != 0; bits >>= 1, direction ^= direction >> 1)
      if (bits & 1u) expected ^= direction;
    EXPECT_EQ(sobolSecond(index), expected) << index;
  }
}

// The third coordinate of Sobol's first eight points in Gray code's order, as published with the direction numbers of
// Joe and Kuo (2008).
TEST(Sobol, ThirdDimensionIsThatOfThePublishedPoints) {
  const double published[] = {0, 0.5, 0.25, 0.75, 0.625, 0.125, 0.875, 0.375};
  for (std::uint32_t n = 0; n < 8; ++n) EXPECT_EQ(sobolThird(n ^ (n >> 1)) * 0x1p-32, published[n]) << n;
  // Any index is the sum of its bits' direction numbers.
  for (std::uint32_t n = 1, k = 0; k < 1000; ++k, n = n * 1664525u + 1013904223u) {
    std::uint32_t sum = 0;
    for (std::uint32_t bit = 0; bit < 32; ++bit) sum ^= (n >> bit & 1) != 0 ? kSobolThird[bit] : 0;
    ASSERT_EQ(sobolThird(n), sum) << n;
  }
}

// Whether each of the elementary boxes of 2^-a[0] x 2^-a[1] x ... holds as many of these 2^k points as any other.
template <std::size_t D>
bool areEven(const std::vector<glm::dvec3>& points, const std::array<int, D>& axes, const std::array<int, D>& a) {
  int bits = 0;
  for (const int each : a) bits += each;
  std::vector<std::size_t> counts(std::size_t{1} << bits);
  for (const glm::dvec3& p : points) {
    std::size_t box = 0;
    for (std::size_t d = 0; d < D; ++d) box = box << a[d] | static_cast<std::size_t>(std::ldexp(p[axes[d]], a[d]));
    ++counts[box];
  }
  return std::ranges::all_of(counts, [&](std::size_t n) { return n == points.size() / counts.size(); });
}

// A (t,s)-sequence in base 2: of any 2^k points from a multiple of that, each elementary box of volume 2^(t-k) holds
// 2^t (Niederreiter 1987). Of Sobol's, t is the sum of the polynomials' degrees less one each: those of the first two
// dimensions have 0, the third's has 1. Owen's scrambling keeps it.
TEST(Sobol, ThreeDimensionsAreStratifiedTogetherAndByPairs) {
  for (const std::uint32_t seed : {0u, 1u, 77u, 0xdeadbeefu})
    for (const int k : {1, 2, 5, 8, 10})
      for (const std::uint32_t block : {0u, 1u, 6u}) {
        std::vector<glm::dvec3> points;
        for (std::uint32_t i = 0; i < 1u << k; ++i) {
          points.push_back(sobolPoint3((block << k) + i, seed));
          ASSERT_TRUE(glm::all(glm::greaterThan(points.back(), glm::dvec3(0))));
          ASSERT_TRUE(glm::all(glm::lessThan(points.back(), glm::dvec3(1))));
          ASSERT_EQ(glm::dvec2(points.back()), sobolPoint((block << k) + i, seed));
        }
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", 2^" << k << " points, block " << block);
        for (int a = 0; a <= k; ++a) {
          ASSERT_TRUE(areEven<2>(points, {0, 1}, {a, k - a})) << a;
          if (a == k) continue;
          ASSERT_TRUE(areEven<2>(points, {0, 2}, {a, k - 1 - a})) << a;
          ASSERT_TRUE(areEven<2>(points, {1, 2}, {a, k - 1 - a})) << a;
          for (int b = 0; a + b < k; ++b) ASSERT_TRUE(areEven<3>(points, {0, 1, 2}, {a, b, k - 1 - a - b})) << a << b;
        }
        ASSERT_TRUE(areEven<1>(points, {2}, {k}));
      }
}

// Scrambled numbers are uniform and independent between seeds: mean and correlation over 4096 seeds, 5 sigma.
TEST(Sobol, ScramblingsAreUniformAndIndependent) {
  constexpr int kSeeds = 4096;
  double sumX = 0, sumY = 0, sumXY = 0, sumNext = 0, previous = 0.5;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    const glm::dvec2 p = sobolPoint(5, hashCombine(9, seed));
    sumX += p.x - 0.5;
    sumY += p.y - 0.5;
    sumXY += (p.x - 0.5) * (p.y - 0.5);
    sumNext += (p.x - 0.5) * (previous - 0.5);
    previous = p.x;
  }
  const double root = std::sqrt(kSeeds);
  EXPECT_LT(std::abs(sumX) / root, 5 * std::sqrt(1 / 12.0));
  EXPECT_LT(std::abs(sumY) / root, 5 * std::sqrt(1 / 12.0));
  EXPECT_LT(std::abs(sumXY) / root, 5 / 12.0);
  EXPECT_LT(std::abs(sumNext) / root, 5 / 12.0);
}

TEST(Cosine, FollowsItsDensity) {
  tests::expectDensity(
      sampleCosine, [](const glm::dvec3& d) { return pdfCosine(d.z); }, 1, 1e-4);
}

// Some reflections point below the surface: the density over the upper hemisphere integrates to the share of those that
// do not, which is counted here.
TEST(VisibleNormals, ReflectionsFollowTheirDensity) {
  for (const double alpha : {0.25, 0.6, 1.0})
    for (const double NoV : {0.15, 0.6, 1.0}) {
      const glm::dvec3 view(std::sqrt(1 - NoV * NoV), 0, NoV);
      const auto pdf = [&](const glm::dvec3& l) {
        const glm::dvec3 h = glm::normalize(view + l);
        return pdfVisibleNormal(shading::f64::D_GGX(alpha, h.z), alpha, NoV);
      };
      std::mt19937_64 random(2);
      std::uniform_real_distribution<double> uniform;
      const auto reflect = [&](const glm::dvec2& u) {
        const glm::dvec3 h = sampleVisibleNormal(alpha, view, u);
        return 2 * glm::dot(view, h) * h - view;
      };
      double upward = 0;
      for (int i = 0; i < 100000; ++i) {
        const double u = uniform(random), v = uniform(random);
        upward += reflect(glm::dvec2(u, v)).z > 0 ? 1e-5 : 0;
      }
      SCOPED_TRACE(testing::Message() << "alpha " << alpha << ", NoV " << NoV);
      tests::expectDensity(reflect, pdf, upward, 5 * 0.5 / std::sqrt(1e5)); // 5 sigma of a share at most
    }
}

// Over half vectors the density D G1 v.h / NoV integrates to 1 (Heitz 2018, eq. 2): every normal that is seen.
TEST(VisibleNormals, DensityOfHalfVectorsIntegratesToOne) {
  for (const double alpha : {0.1, 0.5, 1.0})
    for (const double NoV : {0.1, 0.5, 0.95}) {
      const double sinV = std::sqrt(1 - NoV * NoV);
      double sum = 0;
      constexpr int kPolar = 4000, kAzimuth = 256;
      for (int i = 0; i < kPolar; ++i) {
        const double psi = (i + 0.5) / kPolar * pi / 2, tanH = alpha * std::tan(psi); // tan theta = alpha tan psi
        const double cosH = 1 / std::sqrt(1 + tanH * tanH), sinH = tanH * cosH;
        const double dTheta = alpha * cosH * cosH / (std::cos(psi) * std::cos(psi)) * (pi / 2 / kPolar);
        for (int j = 0; j < kAzimuth; ++j) {
          const double VoH = sinV * sinH * std::cos((j + 0.5) / kAzimuth * 2 * pi) + NoV * cosH;
          if (VoH > 0)
            sum += 4 * VoH * pdfVisibleNormal(shading::f64::D_GGX(alpha, cosH), alpha, NoV) * sinH * dTheta * 2 * pi /
                   kAzimuth;
        }
      }
      EXPECT_NEAR(sum, 1, 2e-4) << "alpha " << alpha << ", NoV " << NoV;
    }
}

} // namespace
} // namespace parity::reference
