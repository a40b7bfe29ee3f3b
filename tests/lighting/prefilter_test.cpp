// The parts of prefiltering: bright texels summed exactly, texels fitted for bilinear reading.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "lighting/environment/cube.h"
#include "lighting/environment/prefilter.h"
#include "shading/shading.h"
#include "support/read_level.h"

namespace parity::lighting {
namespace {

namespace f64 = shading::f64;

std::vector<glm::vec4> makeFaces(int n, float radiance) {
  return std::vector<glm::vec4>(texelIndex(kCubeFaces, 0, 0, n), glm::vec4(radiance, radiance, radiance, 1));
}

glm::dvec3 energyOf(const std::vector<glm::vec4>& faces, int n) {
  const std::vector<double> angles = texelSolidAngles(n);
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < faces.size(); ++i) sum += angles[i % angles.size()] * glm::dvec3(glm::vec3(faces[i]));
  return sum;
}

TEST(BrightTexels, KeepTheEnergyAndLeaveTheRestBelowTheLimit) {
  constexpr int n = 32;
  std::vector<glm::vec4> faces = makeFaces(n, 1);
  std::mt19937 random(4);
  for (int i = 0; i < 10; ++i) faces[random() % faces.size()] = {4000, 2000, 1000.f + 10 * i, 1};
  const glm::dvec3 before = energyOf(faces, n);
  const BrightTexels bright = takeBrightTexels(faces, n);
  ASSERT_EQ(bright.fours.size(), 3u);
  glm::dvec3 after = energyOf(faces, n);
  for (const BrightTexels::Four& four : bright.fours)
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < 4; ++i) after[c] += four.energy[c][i];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-6);
  for (const glm::vec4& texel : faces) EXPECT_LT(texel.x, 300);
}

TEST(BrightTexels, AreNoneInPlainMapsAndNoMoreThanTheirLimit) {
  std::vector<glm::vec4> faces = makeFaces(32, 3);
  EXPECT_TRUE(takeBrightTexels(faces, 32).fours.empty());
  faces = makeFaces(32, 0);
  EXPECT_TRUE(takeBrightTexels(faces, 32).fours.empty());
  faces = makeFaces(256, 0.01f);
  for (std::size_t i = 0; i < 2 * kMaxBrightTexels; ++i) faces[100 * i] = glm::vec4(1000.f + i);
  EXPECT_EQ(takeBrightTexels(faces, 256).fours.size(), kMaxBrightTexels / 4);
}

// A naive oracle in double: D_GGX as shading has it, its integral by the midpoint rule.
TEST(BrightTexels, AreFilteredByTheLobe) {
  constexpr int n = 64;
  std::vector<glm::vec4> faces = makeFaces(n, 0);
  const std::size_t lamp = texelIndex(2, 40, 20, n), other = texelIndex(4, 10, 60, n);
  faces[lamp] = {500, 300, 100, 1};
  faces[other] = {20, 30, 10, 1};
  const std::vector<glm::vec4> before = faces;
  const BrightTexels bright = takeBrightTexels(faces, n);
  const std::vector<double> angles = texelSolidAngles(n);
  for (const double roughness : {0.1, 0.25, 0.6, 1.0}) {
    const double alpha = roughness * roughness;
    const auto weigh = [&](double NoL) { return NoL > 0 ? f64::D_GGX(alpha, std::sqrt((1 + NoL) / 2)) * NoL : 0; };
    double integral = 0;
    constexpr int kSteps = 2'000'000;
    for (int i = 0; i < kSteps; ++i) integral += 2 * std::numbers::pi * weigh((i + 0.5) / kSteps) / kSteps;
    for (const auto& [face, x, y] : {std::tuple(2, 41, 21), std::tuple(2, 0, 63), std::tuple(3, 5, 5)}) {
      const glm::dvec3 N = texelDirection(face, x, y, n);
      glm::dvec3 expected(0);
      for (const std::size_t i : {lamp, other}) {
        const int index = static_cast<int>(i);
        const glm::dvec3 L = texelDirection(index / (n * n), index % n, index / n % n, n);
        expected += weigh(glm::dot(N, L)) * angles[i % angles.size()] * glm::dvec3(glm::vec3(before[i] - faces[i]));
      }
      const glm::vec3 normal(N);
      glm::vec3 actual;
      sumBrightTexels(bright, {&normal, 1}, roughness, {&actual, 1});
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(actual[c], expected[c] / integral, 2e-4 * expected[c] / integral) << roughness;
    }
  }
}

// Where a smooth function is read between its texels, the fitted ones are nearer: 2.4 times in the limit
// (sqrt(720 / 120), the errors of interpolation by and projection onto linear splines).
TEST(FitBilinear, HalvesTheErrorOfBilinearReading) {
  constexpr int n = 16;
  const auto radianceAt = [](const glm::dvec3& d) {
    return std::exp(4 * glm::dot(d, glm::normalize(glm::dvec3(1, 2, 3))));
  };
  std::vector<glm::vec4> plain = makeFaces(n, 0);
  for (int face = 0; face < kCubeFaces; ++face)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        plain[texelIndex(face, x, y, n)] = glm::vec4(static_cast<float>(radianceAt(texelDirection(face, x, y, n))));
  const std::vector<glm::vec4> fitted = fitBilinear(plain, n);
  const auto errorOf = [&](const std::vector<glm::vec4>& mip) {
    const CubeLevel level = makeCubeLevel(mip, n);
    std::mt19937 random(6);
    std::normal_distribution<double> normal;
    double squares = 0;
    for (int i = 0; i < 20000; ++i) {
      const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
      squares += std::pow(tests::readLevel(level, glm::vec3(d)).x - radianceAt(d), 2);
    }
    return std::sqrt(squares);
  };
  EXPECT_LT(errorOf(fitted), 0.5 * errorOf(plain));
}

TEST(FitBilinear, KeepsAConstantAndNeverTakesMoreThanHalf) {
  constexpr int n = 8;
  std::vector<glm::vec4> mip = makeFaces(n, 5);
  for (const glm::vec4& texel : fitBilinear(mip, n)) ASSERT_FLOAT_EQ(texel.y, 5);
  mip[texelIndex(1, 3, 3, n)] = glm::vec4(1e6);
  float least = 5;
  for (const glm::vec4& texel : fitBilinear(mip, n)) least = std::min(least, texel.x);
  EXPECT_FLOAT_EQ(least, 2.5);
}

} // namespace
} // namespace parity::lighting
