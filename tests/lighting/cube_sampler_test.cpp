// The geometry of a cube map, and reading it without seams.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "lighting/environment/cube.h"
#include "lighting/environment/cube_sampler.h"
#include "support/random_direction.h"

namespace parity::lighting {
namespace {

using tests::randomDirection;

std::vector<glm::vec4> makeNoise(int n) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform;
  std::vector<glm::vec4> cube(texelIndex(kCubeFaces, 0, 0, n));
  for (glm::vec4& texel : cube) texel = {uniform(random), uniform(random), uniform(random), 1};
  return cube;
}

TEST(Cube, HasTheFaceOrientationsOfVulkan) {
  // The table of "Cube Map Face Selection" (Vulkan 1.3): per face the axes along which s, t and the major axis grow.
  struct Row {
    glm::dvec3 s, t, major;
  };
  const Row rows[] = {{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
                      {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},   {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                      {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
  for (int face = 0; face < kCubeFaces; ++face)
    EXPECT_EQ(directionOf({face, 0.25, -0.5}), rows[face].major + 0.25 * rows[face].s - 0.5 * rows[face].t) << face;
}

TEST(Cube, FindsTheFacePointOfEachDirection) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 d = randomDirection(random);
    const FacePoint p = facePointOf(d);
    ASSERT_LE(std::max(std::abs(p.s), std::abs(p.t)), 1);
    ASSERT_LT(glm::distance(glm::normalize(directionOf(p)), d), 1e-14);
  }
}

TEST(Cube, TexelSolidAnglesSumToTheSphereAndMatchTheirDensity) {
  for (const int n : {1, 2, 32, 1024}) {
    double sum = 0;
    for (const double angle : texelSolidAngles(n)) sum += kCubeFaces * angle;
    EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-9) << n;
  }
  // (2/n)^2 (1 + s^2 + t^2)^(-3/2) at the middle of small texels.
  const std::vector<double> angles = texelSolidAngles(256);
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(128, 128), std::pair(40, 200)}) {
    const double s = texelCenter(x, 256), t = texelCenter(y, 256);
    const double density = std::pow(2.0 / 256, 2) * std::pow(1 + s * s + t * t, -1.5);
    EXPECT_NEAR(angles[static_cast<std::size_t>(y) * 256 + x] / density, 1, 1e-4);
  }
}

TEST(Cube, HalvingAMipKeepsItsEnergy) {
  const std::vector<glm::vec4> cube = makeNoise(16), halved = halveMip(cube, 16);
  const std::vector<double> fine = texelSolidAngles(16), coarse = texelSolidAngles(8);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < cube.size(); ++i) before += fine[i % fine.size()] * cube[i].x;
  for (std::size_t i = 0; i < halved.size(); ++i) after += coarse[i % coarse.size()] * halved[i].x;
  EXPECT_NEAR(after / before, 1, 1e-6);
}

glm::vec3 read(const CubeSampler& sampler, const glm::vec3& direction, float sizeLog2) {
  return sampler.readSum(glm::mat3(1), packReads({{direction, sizeLog2, 1}}));
}

TEST(CubeSampler, ReadsATexelAtItsMiddle) {
  constexpr int n = 16;
  const std::vector<glm::vec4> cube = makeNoise(n);
  const CubeSampler sampler(cube, n);
  for (int face = 0; face < kCubeFaces; ++face)
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(n - 1, 3), std::pair(5, n - 1)}) {
      const glm::vec3 value = read(sampler, glm::vec3(texelDirection(face, x, y, n)), -10);
      EXPECT_LT(glm::distance(value, glm::vec3(cube[texelIndex(face, x, y, n)])), 1e-4f);
    }
}

// Noise has no continuity of its own: what agrees on both sides of an edge does so by the reading alone.
TEST(CubeSampler, HasNoSeamAtAnyEdgeOrCorner) {
  constexpr int n = 16;
  const CubeSampler sampler(makeNoise(n), n);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int edges = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double a : {-1.0, 1.0})
      for (const double b : {-1.0, 1.0}) {
        ++edges;
        for (int i = 0; i < 200; ++i) {
          // A point of the edge between the faces of axes (axis + 1) and (axis + 2), the corners among them.
          glm::dvec3 d;
          d[axis] = i < 2 ? 2 * i - 1 : uniform(random);
          glm::dvec3 oneSide = d, otherSide = d;
          const int u = (axis + 1) % 3, v = (axis + 2) % 3;
          oneSide[u] = otherSide[u] = a;
          oneSide[v] = otherSide[v] = b;
          oneSide[u] *= 1 + 1e-6;
          otherSide[v] *= 1 + 1e-6;
          ASSERT_NE(facePointOf(oneSide).face, facePointOf(otherSide).face);
          for (const float sizeLog2 : {-10.f, 0.3f, 1.f, 2.7f, 10.f})
            ASSERT_LT(glm::distance(read(sampler, glm::vec3(oneSide), sizeLog2),
                                    read(sampler, glm::vec3(otherSide), sizeLog2)),
                      2e-4f)
                << "axis " << axis << " at " << d[axis] << ", size " << sizeLog2;
        }
      }
  EXPECT_EQ(edges, 12);
}

TEST(CubeSampler, ReadsTheMeanOfTheWholeCubeAtTheLargestSize) {
  constexpr int n = 8;
  const std::vector<glm::vec4> cube(texelIndex(kCubeFaces, 0, 0, n), glm::vec4(3, 4, 5, 1));
  const CubeSampler sampler(cube, n);
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i)
    for (const float sizeLog2 : {-5.f, 1.5f, 50.f})
      ASSERT_LT(glm::distance(read(sampler, glm::vec3(randomDirection(random)), sizeLog2), glm::vec3(3, 4, 5)), 1e-5f);
}

TEST(CubeSampler, SumsThousandsOfReadsWithoutDrift) {
  const CubeSampler sampler(std::vector<glm::vec4>(texelIndex(kCubeFaces, 0, 0, 4), glm::vec4(0.1f)), 4);
  const std::vector<WeightedRead> reads(100003, {glm::vec3(0.6f, 0, 0.8f), 0, 1.f / 100003});
  EXPECT_NEAR(sampler.readSum(glm::mat3(1), packReads(reads)).x, 0.1f, 1e-7);
}

} // namespace
} // namespace parity::lighting
