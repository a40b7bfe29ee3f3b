// The irradiance cube against closed forms and against sums over every cell of a panorama.
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "lighting/environment/cube_sampler.h"
#include "lighting/environment/equirect.h"
#include "lighting/environment/irradiance_cube.h"
#include "lighting/environment/sun_extraction.h"
#include "scenes/environment.h"
#include "scenes/load.h"
#include "support/read_level.h"
#include "support/shared_assets.h"

namespace parity::lighting {
namespace {

using std::numbers::pi;

// radianceOf: of a unit direction.
template <typename RadianceOf> scenes::Environment makeMap(int width, int height, const RadianceOf& radianceOf) {
  scenes::Environment environment;
  environment.radiance = base::Image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double polar = (y + 0.5) / height * pi, azimuth = ((x + 0.5) / width - 0.5) * 2 * pi;
      const glm::dvec3 d(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));
      const glm::dvec3 radiance = radianceOf(d);
      for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = static_cast<float>(radiance[c]);
    }
  return environment;
}

std::vector<glm::dvec3> randomDirections(int count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> directions(count);
  for (glm::dvec3& d : directions) d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  return directions;
}

CubeLevel levelOf(const std::vector<glm::vec4>& cube) { return makeCubeLevel(cube, kIrradianceFaceSize); }
CubeLevel levelOf(const scenes::Environment& environment) { return levelOf(makeIrradianceCube(environment)); }

glm::dvec3 read(const CubeLevel& level, const glm::dvec3& n) { return glm::dvec3(tests::readLevel(level, n)); }

// Over pi, of every cell at its middle: the truth for maps of 1024 x 512 cells or more.
glm::dvec3 sumOfCells(const base::Image& map, const glm::dvec3& n) {
  glm::dvec3 sum(0);
  for (int y = 0; y < map.height; ++y) {
    const double top = std::cos(pi * y / map.height), bottom = std::cos(pi * (y + 1) / map.height),
                 middle = 0.5 * (top + bottom), radius = std::sqrt(1 - middle * middle),
                 angle = (top - bottom) * 2 * pi / map.width;
    for (int x = 0; x < map.width; ++x) {
      const double azimuth = ((x + 0.5) / map.width - 0.5) * 2 * pi;
      const double cosine = glm::dot(n, glm::dvec3(radius * std::cos(azimuth), middle, radius * std::sin(azimuth)));
      const float* texel = map.at(x, y);
      if (cosine > 0) sum += cosine * angle / pi * glm::dvec3(texel[0], texel[1], texel[2]);
    }
  }
  return sum;
}

// Root of the mean squared error over that of the mean squared truth.
double relativeRmse(const scenes::Environment& environment, int normals) {
  const CubeLevel level = levelOf(environment);
  double error = 0, truth = 0;
  for (const glm::dvec3& n : randomDirections(normals)) {
    const glm::dvec3 expected = sumOfCells(environment.radiance, n), difference = read(level, n) - expected;
    error += glm::dot(difference, difference);
    truth += glm::dot(expected, expected);
  }
  return std::sqrt(error / truth);
}

TEST(IrradianceCube, OfAConstantSkyIsThatConstantForMapsOfAnySize) {
  for (const auto& [width, height] : {std::pair(1, 1), {3, 7}, {64, 32}, {1023, 511}, {2048, 1024}}) {
    const CubeLevel level = levelOf(makeMap(width, height, [](const auto&) { return glm::dvec3(0.25, 1, 40); }));
    for (const glm::dvec3& n : randomDirections(50))
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(read(level, n)[c] / glm::dvec3(0.25, 1, 40)[c], 1, 1e-4) << width;
  }
}

TEST(IrradianceCube, OfALinearGradientHasTheClosedForm) {
  const glm::dvec3 g(0.3, -0.5, 0.2);
  const auto radiance = [&](const glm::dvec3& d) { return glm::dvec3(1 + glm::dot(g, d)); };
  for (const auto& [width, height] : {std::pair(1024, 512), {1023, 511}, {1600, 900}}) {
    const CubeLevel level = levelOf(makeMap(width, height, radiance));
    for (const glm::dvec3& n : randomDirections(50))
      ASSERT_NEAR(read(level, n).x, 1 + 2.0 / 3 * glm::dot(g, n), 1e-4) << width; // integral (1 + g.l) max(n.l, 0) dl
  }
}

TEST(IrradianceCube, TurnsWithTheMap) {
  scenes::Environment environment = makeMap(512, 256, [](const auto& d) { return glm::max(d, 0.0); });
  environment.rotationDeg = 90; // +Z goes to +X
  const CubeLevel level = levelOf(environment);
  // integral of max(w.z, 0)^2 over pi: 2/3
  EXPECT_NEAR(read(level, {1, 0, 0}).z, 2.0 / 3, 1e-3);
  EXPECT_NEAR(read(level, {0, 0, -1}).x, 2.0 / 3, 1e-3);
  EXPECT_NEAR(read(level, {0, 1, 0}).y, 2.0 / 3, 1e-3);
}

TEST(IrradianceCube, OfASingleBrightCellIsItsCosine) {
  for (const auto& [x, y] : {std::pair(300, 200), {17, 255}, {511, 5}, {200, 511}}) {
    scenes::Environment environment = makeMap(1024, 512, [](const auto&) { return glm::dvec3(0); });
    environment.radiance.at(x, y)[1] = 68000;
    EXPECT_LE(relativeRmse(environment, 200), 0.002) << x << ", " << y;
  }
}

TEST(IrradianceCube, OfSkiesNearTheLimitOfFloatsIsFinite) {
  for (const float radiance : {1e30f, std::numeric_limits<float>::max()}) {
    for (const glm::vec4& texel : makeIrradianceCube(makeMap(8, 4, [&](const auto&) { return glm::dvec3(radiance); })))
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(texel[c] / 1e30f, 1, 1e-4); // cut there, as the prefiltered cube is
  }
  for (const glm::vec4& texel : makeIrradianceCube(makeMap(8, 4, [](const auto&) { return glm::dvec3(0); })))
    ASSERT_EQ(texel, glm::vec4(0, 0, 0, 1));
  EXPECT_THROW(makeIrradianceCube(makeMap(8, 4, [](const auto&) { return glm::dvec3(-1); })), base::Error);
}

TEST(IrradianceCube, OfACubeIsThatOfThePanoramaItCameFrom) {
  const scenes::Environment environment = makeMap(
      1024, 512, [](const glm::dvec3& d) { return glm::dvec3(1 + d.x, std::exp(2 * d.y), d.z > 0.9 ? 30 : 0.1); });
  for (const int faceSize : {32, 64, 256}) {
    const std::vector<glm::vec4> faces = resampleEquirect(environment, faceSize);
    const CubeLevel panorama = levelOf(environment), cube = levelOf(makeIrradianceCube(faces, faceSize));
    for (const glm::dvec3& n : randomDirections(50))
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(read(cube, n)[c], read(panorama, n)[c], 0.1 / faceSize) << faceSize;
  }
}

class IrradianceOfRealMaps : public testing::TestWithParam<const char*> {};

// The diffuse light of the high-end path against the truth: at most 0.2 %.
TEST_P(IrradianceOfRealMaps, IsThatOfEveryCell) {
  const std::filesystem::path file = tests::sharedEnvironment(GetParam());
  if (file.empty()) GTEST_SKIP() << "no " << GetParam();
  std::vector<std::string> warnings;
  const scenes::Environment whole = scenes::loadEnvironment(file.string(), 0, warnings);
  for (const scenes::Environment& environment : {whole, extractSuns(whole).environment}) {
    const double rmse = relativeRmse(environment, 40);
    std::printf("%s: %.4f %%\n", GetParam(), 100 * rmse);
    EXPECT_LE(rmse, 0.002);
  }
}

INSTANTIATE_TEST_SUITE_P(Shared, IrradianceOfRealMaps,
                         testing::Values("aerodynamics_workshop_1k.hdr", "autoshop_01_1k.hdr",
                                         "blocky_photo_studio_1k.hdr", "chinese_garden_1k.hdr",
                                         "st_peters_square_night_1k.hdr", "studio_small_05_1k.hdr"));

} // namespace
} // namespace parity::lighting
