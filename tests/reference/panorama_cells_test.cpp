// What the high-end path's mirrors read (lighting/environment/panorama_cells.h) against what the reference reads, for
// maps of any size.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "lighting/environment/panorama_cells.h"
#include "reference/environment_sampler.h"
#include "scenes/builtin/procedural_environment.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

scenes::Environment makeNoise(int width, int height, float rotationDeg = 0) {
  scenes::Environment environment;
  environment.name = "noise";
  environment.radiance = base::Image(width, height, 3);
  environment.rotationDeg = rotationDeg;
  std::mt19937 random(3);
  std::exponential_distribution<float> radiance;
  for (float& value : environment.radiance.pixels) value = radiance(random);
  return environment;
}

std::vector<glm::dvec3> makeDirections(int count) {
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> directions;
  for (int i = 0; i < count; ++i)
    directions.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
  return directions;
}

void expectSame(const glm::vec3& actual, const glm::dvec3& expected, double relative) {
  for (int c = 0; c < 3; ++c) ASSERT_NEAR(actual[c], expected[c], relative * expected[c] + 1e-12);
}

struct Size {
  int width, height;
  float rotationDeg;
};
class PanoramaOfAnySize : public testing::TestWithParam<Size> {};

TEST_P(PanoramaOfAnySize, IsReadByMirrorsAsTheReferenceReadsIt) {
  const auto [width, height, rotationDeg] = GetParam();
  const scenes::Environment environment = makeNoise(width, height, rotationDeg);
  const EnvironmentSampler truth(environment);
  const lighting::PanoramaCells cells = lighting::makePanoramaCells(environment);
  for (const glm::dvec3& d : makeDirections(2000))
    expectSame(lighting::readCells(cells, d, 0), truth.evaluate(d).radiance, 1e-5);
  for (const glm::dvec3 pole : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)})
    expectSame(lighting::readCells(cells, pole, 0), truth.evaluate(pole).radiance, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Sizes, PanoramaOfAnySize,
                         testing::Values(Size{1, 1, 0}, Size{3, 7, 0}, Size{2, 1, 50}, Size{1023, 511, 0},
                                         Size{1024, 512, 33}, Size{1024, 512, -721}));

// Against the mean of readings without a box, away from the poles.
TEST(PanoramaCells, ABoxIsTheMeanOfWhatLiesInIt) {
  const scenes::Environment environment = makeNoise(1024, 512, 20);
  const lighting::PanoramaCells cells = lighting::makePanoramaCells(environment);
  const double cell = pi / 512;
  for (const double width : {0.1 * cell, 0.5 * cell, cell})
    for (const glm::dvec3& d : makeDirections(20)) {
      if (std::abs(d.y) > 0.5) continue;
      const double azimuth = std::atan2(d.z, d.x), polar = std::acos(d.y), sine = std::sin(polar);
      if (width / sine > 2 * pi / 1024) continue; // no more than a cell along the row
      glm::dvec3 sum(0);
      constexpr int kSteps = 200;
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          const double a = azimuth + width / sine * ((i + 0.5) / kSteps - 0.5),
                       p = polar + width * ((j + 0.5) / kSteps - 0.5);
          sum += glm::dvec3(
              lighting::readCells(cells, {std::sin(p) * std::cos(a), std::cos(p), std::sin(p) * std::sin(a)}, 0));
        }
      expectSame(lighting::readCells(cells, d, width), sum / (1. * kSteps * kSteps), 0.02);
    }
}

TEST(PanoramaCells, CoarserMipsKeepTheEnergyOfOddSizesToo) {
  const scenes::Environment environment = makeNoise(1023, 2047);
  const lighting::PanoramaCells cells = lighting::makePanoramaCells(environment);
  ASSERT_GE(cells.mips.size(), 2u);
  const auto energyOf = [&](int mip) {
    const int w = lighting::widthOf(cells, mip), h = lighting::heightOf(cells, mip);
    double energy = 0;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        energy += cells.mips[mip][static_cast<std::size_t>(y) * w + x].x * 2 * pi / w *
                  (std::cos(pi * y / h) - std::cos(pi * (y + 1) / h));
    return energy;
  };
  for (int mip = 1; mip < static_cast<int>(cells.mips.size()); ++mip) EXPECT_NEAR(energyOf(mip) / energyOf(0), 1, 1e-6);
}

TEST(PanoramaCells, ALampBesideTheCellThatIsReadDoesNotLeak) {
  scenes::Environment environment = makeNoise(1024, 512);
  const auto at = [&](int x, int y) { return scenes::directionAt((x + 0.5) / 1024, (y + 0.5) / 512); };
  const glm::vec3 before = lighting::readCells(lighting::makePanoramaCells(environment), at(300, 200), 0);
  for (int c = 0; c < 3; ++c) environment.radiance.at(301, 200)[c] = 1e9f;
  EXPECT_EQ(lighting::readCells(lighting::makePanoramaCells(environment), at(300, 200), 0), before);
}

TEST(PanoramaCells, HugeRadianceStaysFinite) {
  scenes::Environment environment = makeNoise(1024, 512);
  for (float& value : environment.radiance.pixels) value = std::numeric_limits<float>::max();
  const lighting::PanoramaCells cells = lighting::makePanoramaCells(environment);
  for (const double width : {0.0, 0.002, 0.01})
    for (const glm::dvec3& d : makeDirections(20)) EXPECT_TRUE(std::isfinite(lighting::readCells(cells, d, width).x));
}

} // namespace
} // namespace parity::reference
