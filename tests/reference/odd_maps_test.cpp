// Maps that no photographer makes - one bright texel, black, one texel in all, odd sizes, the float limit - as all
// three paths prepare them: against closed forms and what the reference reads.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "lighting/environment/cube.h"
#include "lighting/environment/cube_sampler.h"
#include "lighting/environment/environment_light.h"
#include "lighting/environment/panorama_cells.h"
#include "lighting/environment/sun_extraction.h"
#include "reference/environment_sampler.h"
#include "shading/shading.h"
#include "support/read_level.h"

namespace parity::reference {
namespace {

namespace f64 = shading::f64;
using std::numbers::pi;

scenes::Environment makeMap(int width, int height, float radiance) {
  scenes::Environment environment;
  environment.name = "map";
  environment.radiance = base::Image(width, height, 3, radiance);
  return environment;
}

// As the high-end path has it, and as mobile.
std::vector<lighting::EnvironmentLight> lightsOf(const scenes::Environment& environment, int faceSize = 64) {
  lighting::PrefilterOptions fine = lighting::kFinePrefilter, first{.levels = lighting::PrefilterLevels::first};
  fine.faceSize = first.faceSize = faceSize;
  return {lighting::makeEnvironmentLight(environment, fine), lighting::makeEnvironmentLight(environment, first)};
}

std::vector<glm::dvec3> makeSphere(int count) {
  std::vector<glm::dvec3> directions;
  for (int i = 0; i < count; ++i) { // Fibonacci's spiral
    const double y = 1 - (2. * i + 1) / count, r = std::sqrt(1 - y * y), phi = i * pi * (3 - std::sqrt(5.0));
    directions.emplace_back(r * std::cos(phi), y, r * std::sin(phi));
  }
  return directions;
}

// Calls visit(mip, layer, six faces, their size).
template <typename Visit> void forEachLevel(const lighting::CubeMap& cube, const Visit& visit) {
  for (int mip = 0; mip < static_cast<int>(cube.mips.size()); ++mip)
    for (int layer = 0; layer < lighting::layersOf(cube, mip); ++layer) {
      const int n = cube.faceSize >> mip;
      const auto size = static_cast<std::ptrdiff_t>(lighting::texelIndex(lighting::kCubeFaces, 0, 0, n));
      const auto begin = cube.mips[mip].begin() + layer * size;
      visit(mip, layer, std::vector<glm::vec4>(begin, begin + size), n);
    }
}

double meanOf(const std::vector<glm::vec4>& faces, int n) {
  const std::vector<double> angles = lighting::texelSolidAngles(n);
  double sum = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) sum += angles[i % angles.size()] * faces[i].y;
  return sum / (4 * pi);
}

// E(n) = L omega n.l: of the reference by its samples, whose density is the light's.
TEST(OddMaps, OneBrightTexelGivesItsIrradianceAndKeepsItsEnergyAtEveryLevel) {
  constexpr int kWidth = 1024, kHeight = 512, kX = 700, kY = 150;
  scenes::Environment environment = makeMap(kWidth, kHeight, 0);
  environment.radiance.at(kX, kY)[1] = 5000;
  const double omega = 2 * pi / kWidth * (std::cos(pi * kY / kHeight) - std::cos(pi * (kY + 1) / kHeight));
  const double azimuth = ((kX + 0.5) / kWidth - 0.5) * 2 * pi, polar = pi * (kY + 0.5) / kHeight;
  const glm::dvec3 L(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));

  const EnvironmentSampler sampler(environment);
  for (const glm::dvec3 n : {L, glm::normalize(L + glm::dvec3(1, 0, 0)), glm::dvec3(0, 1, 0)}) {
    double sum = 0;
    constexpr int kSamples = 64;
    for (int i = 0; i < kSamples; ++i) {
      const EnvironmentSample s = sampler.sample({(i + 0.5) / kSamples, std::fmod((i + 0.5) * 0.618, 1.0)});
      sum += s.radiance.y * std::max(0.0, glm::dot(n, s.direction)) / s.pdf / kSamples;
    }
    EXPECT_NEAR(sum, 5000 * omega * std::max(0.0, glm::dot(n, L)), 1e-3 * 5000 * omega);
  }
  const std::vector<lighting::EnvironmentLight> lights = lightsOf(environment, 256);
  for (const lighting::EnvironmentLight& light : lights) {
    // Band 0 holds the mean irradiance over all normals, a quarter of the flux.
    EXPECT_NEAR(light.irradianceSh[0].y * 0.282094791773878, 5000 * omega / 4, 1e-3 * 5000 * omega);
    EXPECT_EQ(light.irradianceSh[0].x, 0);
    // Lobes only spread light: sums over a level's texels show it as well as these are small beside the lobe.
    const bool isFine = &light == &lights[0];
    // The fine levels lack it: it is a compact lamp, whose whole light is beside them. Level 0 is what they are made
    // of.
    if (isFine) {
      ASSERT_EQ(light.lamps.compact.nodes.size(), 1u);
      EXPECT_NEAR(light.lamps.compact.nodes[0].light.y / (5000 * omega), 1, 1e-3);
      EXPECT_TRUE(light.lamps.wide.nodes.empty());
    }
    forEachLevel(light.prefiltered, [&](int mip, int layer, const std::vector<glm::vec4>& faces, int n) {
      const double share = meanOf(faces, n) / (5000 * omega / (4 * pi));
      if (isFine && (mip > 0 || layer > 0))
        EXPECT_NEAR(share, 0, 1e-4) << mip << ", " << layer;
      else
        EXPECT_NEAR(share, 1, isFine ? 0.005 : 0.07) << mip << ", " << layer;
    });
  }
  // So they do where texels are wider than the lobes.
  forEachLevel(lightsOf(environment)[1].prefiltered,
               [&](int mip, int layer, const std::vector<glm::vec4>& faces, int n) {
                 EXPECT_NEAR(meanOf(faces, n) / (5000 * omega / (4 * pi)), 1, 0.07) << mip << ", " << layer;
               });
  const lighting::SunExtraction extraction = lighting::extractSuns(environment);
  ASSERT_EQ(extraction.suns.size(), 1u) << "all of the light in one place is a sun";
  EXPECT_NEAR(extraction.suns[0].light.color.y, 5000 * omega, 1e-4 * 5000 * omega);
  EXPECT_GT(glm::dot(-glm::dvec3(extraction.suns[0].light.direction), L), std::cos(1e-3));
}

TEST(OddMaps, ABlackMapIsBlackAndFiniteEverywhere) {
  const scenes::Environment environment = makeMap(64, 32, 0);
  EXPECT_TRUE(EnvironmentSampler(environment).isBlack());
  EXPECT_TRUE(lighting::extractSuns(environment).suns.empty());
  for (const lighting::EnvironmentLight& light : lightsOf(environment)) {
    for (const auto& mip : light.prefiltered.mips)
      for (const glm::vec4& texel : mip) ASSERT_EQ(texel, glm::vec4(0, 0, 0, 1));
    for (const glm::vec3& c : light.irradianceSh) ASSERT_EQ(c, glm::vec3(0));
  }
}

TEST(OddMaps, OneTexelIsAWhiteFurnace) {
  const scenes::Environment environment = makeMap(1, 1, 1);
  for (const lighting::EnvironmentLight& light : lightsOf(environment)) {
    for (const auto& mip : light.prefiltered.mips)
      for (const glm::vec4& texel : mip)
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(texel[c], 1, 1e-5);
    EXPECT_NEAR(light.irradianceSh[0].x * 0.282094791773878, pi, 1e-5 * pi);
  }
  const lighting::PanoramaCells cells = lighting::makePanoramaCells(environment);
  const EnvironmentSampler truth(environment);
  for (const glm::dvec3& d : makeSphere(100)) {
    EXPECT_EQ(lighting::readCells(cells, d, 0.01), glm::vec3(1));
    EXPECT_EQ(truth.evaluate(d).radiance, glm::dvec3(1));
  }
}

// Filtered at roughness .5, against the sum over what the reference reads.
TEST(OddMaps, OfOddSizesAreFilteredAsTheReferenceReadsThem) {
  const std::vector<glm::dvec3> sphere = makeSphere(200000);
  const int level = static_cast<int>(std::lround(f64::kPrefilterLayers * f64::mipFromRoughness(0.5)));
  const double roughness = f64::roughnessFromMip(1. * level / f64::kPrefilterLayers), a2 = std::pow(roughness, 4);
  for (const auto& [width, height] : {std::pair(3, 7), std::pair(7, 3), std::pair(1023, 511)}) {
    scenes::Environment environment = makeMap(width, height, 0);
    environment.rotationDeg = 15;
    std::mt19937 random(4);
    for (float& value : environment.radiance.pixels) value = static_cast<float>(random() % 1000) / 100.f;
    const EnvironmentSampler truth(environment);
    const lighting::EnvironmentLight light = lightsOf(environment)[0];
    forEachLevel(light.prefiltered, [&](int mip, int layer, const std::vector<glm::vec4>& faces, int n) {
      if (mip * f64::kPrefilterLayers + layer != level) return;
      const lighting::CubeLevel cube = lighting::makeCubeLevel(faces, n);
      for (const glm::dvec3& N : makeSphere(12)) {
        glm::dvec3 sum(0);
        double weights = 0;
        for (const glm::dvec3& d : sphere) {
          const double NoL = glm::dot(N, d), t = 0.5 * (1 + NoL) * (a2 - 1) + 1;
          if (NoL <= 0) continue;
          sum += NoL / (t * t) * truth.evaluate(d).radiance;
          weights += NoL / (t * t);
        }
        const glm::vec4 read(tests::readLevel(cube, N));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(read[c], sum[c] / weights, 0.02 * sum[c] / weights) << width;
      }
    });
  }
}

TEST(OddMaps, TheFloatLimitStaysFinite) {
  scenes::Environment environment = makeMap(64, 32, std::numeric_limits<float>::max());
  for (const bool isOneTexel : {false, true}) {
    if (isOneTexel) {
      environment = makeMap(512, 256, 1);
      for (int c = 0; c < 3; ++c) environment.radiance.at(300, 90)[c] = std::numeric_limits<float>::max();
    }
    const lighting::SunExtraction extraction = lighting::extractSuns(environment);
    for (const lighting::ExtractedSun& sun : extraction.suns) EXPECT_TRUE(std::isfinite(sun.light.color.x));
    for (const lighting::EnvironmentLight& light : lightsOf(environment)) {
      for (const auto& mip : light.prefiltered.mips)
        for (const glm::vec4& texel : mip) ASSERT_TRUE(std::isfinite(texel.x) && texel.x >= 0);
      for (const glm::vec3& c : light.irradianceSh) ASSERT_TRUE(std::isfinite(c.x));
    }
  }
}

} // namespace
} // namespace parity::reference
