// Resampling a panorama to a cube: means over exact areas, whatever the sizes, and nothing taken that is no radiance.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "base/error.h"
#include "lighting/environment/cube.h"
#include "lighting/environment/equirect.h"

namespace parity::lighting {
namespace {

using std::numbers::pi;

scenes::Environment makeBlack(int width, int height, int channels = 3) {
  scenes::Environment environment;
  environment.name = "test";
  environment.radiance = base::Image(width, height, channels);
  return environment;
}

scenes::Environment makeNoise(int width, int height) {
  scenes::Environment environment = makeBlack(width, height);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform;
  for (float& value : environment.radiance.pixels) value = uniform(random);
  return environment;
}

// The panorama's texel that a world direction falls into (docs/design.md 8d), for no rotation.
glm::dvec3 texelOf(const base::Image& image, const glm::dvec3& d) {
  const double u = std::atan2(d.z, d.x) / (2 * pi) + 0.5, v = std::acos(d.y / glm::length(d)) / pi;
  const int x = std::min(image.width - 1, static_cast<int>(u * image.width));
  const int y = std::min(image.height - 1, static_cast<int>(v * image.height));
  const float* p = image.at(x, y);
  return {p[0], p[1], p[2]};
}

double cubeEnergy(const std::vector<glm::vec4>& cube, int n) {
  const std::vector<double> angles = texelSolidAngles(n);
  double sum = 0;
  for (std::size_t i = 0; i < cube.size(); ++i) sum += angles[i % angles.size()] * cube[i].y;
  return sum;
}

double solidAngleOfRow(int y, int width, int height) {
  return 2 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height));
}

// White noise is the hardest panorama: each texel's share in each cube texel must be right.
TEST(Equirect, TexelsAreTheMeansOverTheirSolidAngle) {
  constexpr int n = 64, kSteps = 1000;
  const scenes::Environment environment = makeNoise(512, 256);
  const std::vector<glm::vec4> cube = resampleEquirect(environment, n);
  for (int face = 0; face < kCubeFaces; ++face)
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(31, 32), std::pair(63, 20), std::pair(11, 50)}) {
      glm::dvec3 sum{0.0};
      double weights = 0;
      for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
          const double s = 2 * (x + (i + 0.5) / kSteps) / n - 1, t = 2 * (y + (j + 0.5) / kSteps) / n - 1;
          const double weight = std::pow(1 + s * s + t * t, -1.5);
          sum += weight * texelOf(environment.radiance, directionOf({face, s, t}));
          weights += weight;
        }
      // The rays towards a pole meet a texel's share to 1e-3, at the face's corner; the points here to some 1/1000.
      const glm::dvec3 actual(cube[texelIndex(face, x, y, n)]);
      EXPECT_LT(glm::distance(actual, sum / weights), 1.2e-3) << "face " << face << " texel " << x << "," << y;
    }
}

TEST(Equirect, KeepsTheEnergyOfASunInPanoramasOfAllSizes) {
  struct Case {
    int width, height, x, y, faceSize;
  };
  // Far larger than the faces (averaged first), odd sizes, coarser than the faces (interpolated; not next to a pole).
  for (const Case& c : {Case{4096, 2048, 1000, 300, 32}, Case{3000, 1500, 2999, 1499, 64}, Case{1021, 509, 77, 5, 128},
                        Case{333, 111, 200, 60, 128}, Case{512, 256, 0, 90, 256}}) {
    scenes::Environment environment = makeBlack(c.width, c.height);
    environment.rotationDeg = 33;
    environment.radiance.at(c.x, c.y)[1] = 68000;
    const double truth = 68000 * solidAngleOfRow(c.y, c.width, c.height);
    EXPECT_NEAR(cubeEnergy(resampleEquirect(environment, c.faceSize), c.faceSize) / truth, 1, 1e-3)
        << c.width << " x " << c.height;
  }
}

TEST(Equirect, PutsOneColourToEachSideOfTheWorld) {
  // Regions by docs/design.md 8d's mapping: +X at u = 0.5, +Z at 0.75, -X at 0 and 1, -Z at 0.25; +Y at v = 0.
  scenes::Environment environment = makeBlack(64, 32);
  const glm::vec3 colors[kCubeFaces] = {{1, 0, 0}, {0, 1, 1}, {0, 1, 0}, {1, 0, 1}, {0, 0, 1}, {1, 1, 0}};
  const int sides[] = {1, 5, 5, 0, 0, 4, 4, 1}; // faces by eighths of u
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      const glm::vec3& color = colors[y < 8 ? 2 : y >= 24 ? 3 : sides[x / 8]];
      for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = color[c];
    }
  const std::vector<glm::vec4> cube = resampleEquirect(environment, 32);
  for (int face = 0; face < kCubeFaces; ++face)
    EXPECT_LT(glm::distance(glm::vec3(cube[texelIndex(face, 16, 16, 32)]), colors[face]), 1e-5f) << face;
}

TEST(Equirect, TurnsByWholeColumnsExactlyLikeAShiftedPanorama) {
  const scenes::Environment environment = makeNoise(256, 128);
  scenes::Environment turned = environment, shifted = environment;
  turned.rotationDeg = 45; // 32 of 256 columns: what is seen at azimuth a stood at a + 45 degrees
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 256; ++x)
      for (int c = 0; c < 3; ++c) shifted.radiance.at(x, y)[c] = environment.radiance.at((x + 32) % 256, y)[c];
  const std::vector<glm::vec4> a = resampleEquirect(turned, 32), b = resampleEquirect(shifted, 32);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_LT(glm::distance(a[i], b[i]), 1e-5f) << i;
}

TEST(Equirect, TakesAPanoramaOfOneTexel) {
  scenes::Environment environment = makeBlack(1, 1);
  environment.radiance.pixels = {1, 2, 3};
  for (const glm::vec4& texel : resampleEquirect(environment, 32))
    ASSERT_LT(glm::distance(texel, glm::vec4(1, 2, 3, 1)), 1e-5f);
}

TEST(Equirect, RefusesWhatIsNoRadiance) {
  EXPECT_THROW(resampleEquirect(scenes::Environment{}, 32), base::Error);
  EXPECT_THROW(resampleEquirect(makeBlack(8, 4, 4), 32), base::Error);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e-3f}) {
    scenes::Environment environment = makeBlack(8, 4);
    environment.radiance.at(7, 3)[2] = bad;
    EXPECT_THROW(resampleEquirect(environment, 32), base::Error) << bad;
  }
  scenes::Environment short_ = makeBlack(8, 4);
  short_.radiance.pixels.pop_back();
  EXPECT_THROW(resampleEquirect(short_, 32), base::Error);
  scenes::Environment turned = makeBlack(8, 4);
  turned.rotationDeg = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(resampleEquirect(turned, 32), base::Error);
}

} // namespace
} // namespace parity::lighting
