// The points that stand for an environment: their light is all of it, and a wide lobe's sum over them is its integral.
#include "lighting/environment/median_cut.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace parity::lighting {
namespace {

using std::numbers::pi;

// Smooth hills under a small bright lamp, turned.
scenes::Environment makeSky() {
  scenes::Environment sky;
  sky.name = "sky";
  sky.radiance = base::Image(256, 128, 3);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 256; ++x)
      for (int c = 0; c < 3; ++c)
        sky.radiance.at(x, y)[c] =
            static_cast<float>(1 + std::sin(0.05 * x + c) * std::cos(0.09 * y)) + (x / 4 == 30 && y / 4 == 8 ? 200 : 0);
  sky.rotationDeg = 70;
  return sky;
}

// Of the same cells, one by one.
template <typename Lobe> glm::dvec3 integrate(const PanoramaCells& cells, const Lobe& lobe) {
  glm::dvec3 sum(0);
  for (int y = 0; y < cells.height; ++y) {
    const double upper = std::cos(pi * y / cells.height), lower = std::cos(pi * (y + 1) / cells.height),
                 cosine = (upper + lower) / 2;
    for (int x = 0; x < cells.width; ++x) {
      const double azimuth = ((x + 0.5) / cells.width - cells.turns - 0.5) * 2 * pi,
                   sine = std::sqrt(1 - cosine * cosine);
      const glm::dvec3 direction(sine * std::cos(azimuth), cosine, sine * std::sin(azimuth));
      sum += glm::dvec3(cells.mips[0][static_cast<std::size_t>(y) * cells.width + x]) *
             ((upper - lower) * 2 * pi / cells.width * lobe(direction));
    }
  }
  return sum;
}

TEST(MedianCut, TheLightOfAllPointsIsThatOfTheEnvironment) {
  const PanoramaCells cells = makePanoramaCells(makeSky());
  const glm::dvec3 all = integrate(cells, [](const glm::dvec3&) { return 1.0; });
  for (const int count : {1, 7, 512}) {
    const std::vector<EnvironmentPoint> points = cutEnvironment(cells, count);
    EXPECT_EQ(points.size(), static_cast<std::size_t>(count));
    glm::dvec3 sum(0);
    for (const EnvironmentPoint& point : points) {
      sum += glm::dvec3(point.light);
      EXPECT_NEAR(glm::length(point.direction), 1, 1e-5);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], all[c], 1e-3 * all[c]) << count;
  }
}

TEST(MedianCut, AWideLobesSumIsItsIntegral) {
  const PanoramaCells cells = makePanoramaCells(makeSky());
  const std::vector<EnvironmentPoint> points = cutEnvironment(cells, 512);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const auto lobe = [&](const glm::dvec3& d) { return std::pow(std::max(glm::dot(d, axis), 0.0), 3); };
    glm::dvec3 sum(0);
    for (const EnvironmentPoint& point : points) sum += glm::dvec3(point.light) * lobe(point.direction);
    const glm::dvec3 truth = integrate(cells, lobe);
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(sum[c] - truth[c]) / truth[c]);
  }
  std::printf("worst relative error of a cubed cosine over 512 points: %.4f\n", worst);
  EXPECT_LE(worst, 0.01);
}

TEST(MedianCut, ABlackEnvironmentHasPoints) {
  scenes::Environment sky = makeSky();
  std::fill(sky.radiance.pixels.begin(), sky.radiance.pixels.end(), 0.f);
  for (const EnvironmentPoint& point : cutEnvironment(makePanoramaCells(sky), 64)) {
    EXPECT_EQ(point.light, glm::vec3(0));
    EXPECT_NEAR(glm::length(point.direction), 1, 1e-5);
  }
}

} // namespace
} // namespace parity::lighting
