// Irradiance in closed form against sums over every cell, and against what is known of simple skies.
#include "reference/irradiance_sums.h"

#include <numbers>

#include <gtest/gtest.h>

#include "reference/environment_sampler.h"
#include "reference/sampling.h"
#include "reference/surroundings.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

// The cells' radiance times cosine times solid angle; those that the horizon crosses in 32 x 32 parts.
glm::dvec3 sumOverCells(const scenes::Environment& environment, const glm::dvec3& N) {
  glm::dvec3 sum(0.0);
  for (int y = 0; y < tests::kPanoramaHeight; ++y)
    for (int x = 0; x < tests::kPanoramaWidth; ++x) {
      const double middle = glm::dot(N, tests::cellDirection(x, y));
      if (middle < -0.01) continue;
      const int sub = middle < 0.01 ? 32 : 2;
      double cosine = 0;
      for (int j = 0; j < sub; ++j) {
        const double top = pi * (y + double(j) / sub) / tests::kPanoramaHeight;
        const double area =
            (std::cos(top) - std::cos(top + pi / sub / tests::kPanoramaHeight)) * 2 * pi / sub / tests::kPanoramaWidth;
        for (int i = 0; i < sub; ++i)
          cosine +=
              area *
              std::max(0.0, glm::dot(N, tests::cellDirection(x + (i + 0.5) / sub - 0.5, y + (j + 0.5) / sub - 0.5)));
      }
      const float* radiance = environment.radiance.at(x, y);
      sum += cosine * glm::dvec3(radiance[0], radiance[1], radiance[2]);
    }
  return sum;
}

TEST(IrradianceSums, OfAConstantIsPiAndOfAGradientItsClosedForm) {
  const EnvironmentSampler white(tests::makeWhitePanorama());
  const EnvironmentSampler sky(tests::makePanorama([](const glm::dvec3& d) { return glm::vec3(1 + d.y); }));
  for (const glm::dvec3& v : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 1e-9),
                              glm::dvec3(-1, 0, -1e-9), glm::dvec3(0.3, 1e-4, -0.9), glm::dvec3(0.5, -0.7, 0.1)}) {
    const glm::dvec3 N = glm::normalize(v);
    SCOPED_TRACE(testing::Message() << N.x << ", " << N.y << ", " << N.z);
    EXPECT_NEAR(white.irradiance(N).y / pi, 1, 5e-6);
    // pi (1 + 2/3 n_y): cells of a third of a degree leave 1.5e-5.
    EXPECT_NEAR(sky.irradiance(N).y / pi, 1 + 2.0 / 3 * N.y, 1.5e-5);
  }
}

// Any normal, and those whose horizon passes through the sun; the error is of what faces the sun.
TEST(IrradianceSums, IsTheSumOverAllCells) {
  const scenes::Environment environment = tests::makeSunnyPanorama();
  const EnvironmentSampler sky(environment);
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.4, 0.7, 0.5));
  const glm::dvec3 beside = glm::normalize(glm::cross(sun, glm::dvec3(0.1, -0.3, 0.8)));
  const glm::dvec3 largest = sky.irradiance(sun);
  for (const glm::dvec3& v : {glm::dvec3(0, 1, 0), glm::dvec3(0.2, -0.9, 0.3), glm::dvec3(-1, 0.01, 0.02), beside,
                              glm::normalize(beside + 0.004 * sun), glm::normalize(beside - 0.008 * sun),
                              glm::normalize(beside + 0.3 * sun), -sun}) {
    const glm::dvec3 N = glm::normalize(v), truth = sumOverCells(environment, N), sum = sky.irradiance(N);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(sum[c], truth[c], 1e-5 * largest[c])
          << N.x << ", " << N.y << ", " << N.z << ": " << sum[c] / truth[c];
  }
}

// Neighbouring cells differ a hundredfold, single ones hold up to a 400th of all light: patches are nowhere even.
TEST(IrradianceSums, IsTheSumOverCellsThatHaveNothingInCommon) {
  std::uint32_t seed = 1;
  const scenes::Environment environment = tests::makePanorama([&](const glm::dvec3&) {
    glm::vec3 cell;
    for (int c = 0; c < 3; ++c) {
      const float u = static_cast<float>((seed = hashCombine(seed, 7)) * 0x1p-32 + 1e-7);
      cell[c] = 0.01f / u;
    }
    return cell;
  });
  const EnvironmentSampler sky(environment);
  const glm::dvec3 above = sky.irradiance({0, 1, 0});
  for (int i = 0; i < 12; ++i) {
    const double y = 1 - (2 * i + 1) / 12.0, azimuth = 2.4 * i, r = std::sqrt(1 - y * y);
    const glm::dvec3 N(r * std::cos(azimuth), y, r * std::sin(azimuth)), truth = sumOverCells(environment, N);
    const glm::dvec3 sum = sky.irradiance(N);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], truth[c], 1e-5 * above[c]) << N.x << ", " << N.y << ", " << N.z;
  }
}

TEST(IrradianceSums, TurnsWithThePanorama) {
  scenes::Environment environment = tests::makeSunnyPanorama();
  const glm::dvec3 N = glm::normalize(glm::dvec3(0.8, 0.1, -0.5));
  const glm::dvec3 before = EnvironmentSampler(environment).irradiance(N);
  environment.rotationDeg = 90; // +Z goes to +X, +X to -Z
  const EnvironmentSampler turned(environment);
  const glm::dvec3 after = turned.irradiance({N.z, N.y, -N.x});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-9);
  EXPECT_NEAR(glm::distance(turned.toWorld(turned.toPanorama(N)), N), 0, 1e-15);
}

// Sizes that 2 and the blocks of prefix sums do not divide; one cell that holds all the light.
TEST(IrradianceSums, DoesNotMindOddSizesAndSingleTexels) {
  scenes::Environment environment;
  environment.radiance = base::Image(1537, 769, 3, 2.f);
  EXPECT_NEAR(EnvironmentSampler(environment).irradiance(glm::normalize(glm::dvec3(-0.9, 0.2, -0.1))).x / (2 * pi), 1,
              5e-6);
  environment.radiance = base::Image(1024, 512, 3, 0.f);
  environment.radiance.at(700, 100)[1] = 1e30f;
  const glm::dvec3 texel = tests::cellDirection(700, 100);
  const double area = (std::cos(pi * 100 / 512) - std::cos(pi * 101 / 512)) * 2 * pi / 1024;
  const EnvironmentSampler sky(environment);
  for (const glm::dvec3& N : {texel, glm::normalize(texel + glm::dvec3(1, 0, 0))})
    EXPECT_NEAR(sky.irradiance(N).y / (1e30 * area * glm::dot(N, texel)), 1, 1e-5);
  EXPECT_EQ(sky.irradiance(-texel), glm::dvec3(0));
}

} // namespace
} // namespace parity::reference
