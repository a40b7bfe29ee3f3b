// The environment's distribution against the panorama it was made of.
#include "reference/environment_sampler.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/rotate_vector.hpp>

#include "base/error.h"
#include "reference/surroundings.h"

namespace parity::reference {
namespace {

using std::numbers::pi;
using tests::cellDirection;

TEST(EnvironmentSampler, DensityIntegratesToOneAndFollowsLuminance) {
  const EnvironmentSampler sampler(tests::makeSunnyPanorama());
  double total = 0, light = 0;
  for (int y = 0; y < tests::kPanoramaHeight; ++y) {
    const double area = (std::cos(pi * y / tests::kPanoramaHeight) - std::cos(pi * (y + 1) / tests::kPanoramaHeight)) *
                        2 * pi / tests::kPanoramaWidth;
    for (int x = 0; x < tests::kPanoramaWidth; ++x) {
      const EnvironmentSample s = sampler.evaluate(cellDirection(x, y));
      total += s.pdf * area;
      light += glm::dot(s.radiance, glm::dvec3(0.2126, 0.7152, 0.0722)) * area;
    }
  }
  EXPECT_NEAR(total, 1, 1e-6);
  const EnvironmentSample s = sampler.evaluate(cellDirection(300, 200));
  EXPECT_NEAR(s.pdf * light / glm::dot(s.radiance, glm::dvec3(0.2126, 0.7152, 0.0722)), 1, 1e-5);
}

// What sample() returns is what evaluate() says of its direction, and blocks of 32 x 32 cells are met as often as the
// density says: chi^2 within 5 sigma.
TEST(EnvironmentSampler, SamplesFollowTheDensityThatTheyCarry) {
  scenes::Environment environment = tests::makeSunnyPanorama();
  environment.rotationDeg = 37;
  const EnvironmentSampler sampler(environment);
  constexpr int kBlock = 32, kColumns = tests::kPanoramaWidth / kBlock, kRows = tests::kPanoramaHeight / kBlock;
  constexpr int kCount = 400000;
  std::vector<double> seen(kRows * kColumns, 0.0), expected(kRows * kColumns, 0.0);
  environment.rotationDeg = 0;
  const EnvironmentSampler unturned(environment);
  for (int y = 0; y < tests::kPanoramaHeight; ++y)
    for (int x = 0; x < tests::kPanoramaWidth; ++x)
      expected[static_cast<std::size_t>(y / kBlock * kColumns + x / kBlock)] +=
          kCount * unturned.evaluate(cellDirection(x, y)).pdf *
          (std::cos(pi * y / tests::kPanoramaHeight) - std::cos(pi * (y + 1) / tests::kPanoramaHeight)) * 2 * pi /
          tests::kPanoramaWidth;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform;
  int disagree = 0;
  for (int i = 0; i < kCount; ++i) {
    const double u = uniform(random), v = uniform(random);
    const EnvironmentSample s = sampler.sample(glm::dvec2(u, v));
    ASSERT_NEAR(glm::length(s.direction), 1, 1e-12);
    disagree += sampler.evaluate(s.direction).pdf != s.pdf;
    const double turns = std::atan2(s.direction.z, s.direction.x) / (2 * pi) + 0.5 + 37.0 / 360;
    const int x = static_cast<int>((turns - std::floor(turns)) * kColumns) % kColumns;
    const int y = std::min(static_cast<int>(std::acos(s.direction.y) / pi * kRows), kRows - 1);
    ++seen[static_cast<std::size_t>(y * kColumns + x)];
  }
  EXPECT_LE(disagree, 2) << "but for roundings at the cells' borders";
  double chi2 = 0;
  int cells = 0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (expected[i] > 10) chi2 += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i], ++cells;
  ASSERT_GT(cells, 100);
  EXPECT_LT(std::abs(chi2 - cells), 5 * std::sqrt(2.0 * cells)) << cells;
}

TEST(EnvironmentSampler, TurnsThePanoramaAsGlmRotateDoes) {
  // Red towards +Z; turned by 90 degrees about +Y it is seen towards +X.
  scenes::Environment environment =
      tests::makePanorama([](const glm::dvec3& d) { return glm::vec3(d.z > 0.9 ? 1 : 0, 0, 1); });
  environment.rotationDeg = 90;
  const EnvironmentSampler sampler(environment);
  const glm::dvec3 turned = glm::rotateY(glm::dvec3(0, 0, 1), glm::radians(90.0));
  EXPECT_NEAR(turned.x, 1, 1e-12);
  EXPECT_EQ(sampler.evaluate(turned).radiance.x, 1);
  EXPECT_EQ(sampler.evaluate(glm::dvec3(0, 0, 1)).radiance.x, 0);
}

TEST(EnvironmentSampler, SmallPanoramaIsInterpolatedAndKeepsItsConstant) {
  scenes::Environment environment;
  environment.radiance = base::Image(2, 1, 3, 0.75f);
  const EnvironmentSampler sampler(environment);
  for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(-1, 0, 0)})
    EXPECT_EQ(sampler.evaluate(d).radiance, glm::dvec3(0.75));
  EXPECT_NEAR(sampler.evaluate(glm::dvec3(0, 0, 1)).pdf, 1 / (4 * pi), 1e-6);
}

TEST(EnvironmentSampler, BlackIsToldAndWhatIsNotFiniteRefused) {
  scenes::Environment environment;
  environment.radiance = base::Image(8, 4, 3, 0.f);
  EXPECT_TRUE(EnvironmentSampler(environment).isBlack());
  for (const float bad : {-1.f, NAN, INFINITY}) {
    environment.radiance.pixels[7] = bad;
    EXPECT_THROW(EnvironmentSampler{environment}, base::Error) << bad;
  }
  environment.radiance = base::Image(8, 4, 1, 1.f);
  EXPECT_THROW(EnvironmentSampler{environment}, base::Error) << "one channel";
}

} // namespace
} // namespace parity::reference
