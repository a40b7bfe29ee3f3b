// The sky light that mobile reads of real maps, against docs/shading.md 7e's formula in double, from the panorama
// itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "lighting/environment/environment_light.h"
#include "scenes/environment.h"
#include "scenes/load.h"
#include "shading/shading.h"
#include "support/shared_assets.h"

namespace parity::lighting {
namespace {

using std::numbers::pi;

// Unreal Engine 4's axes, Z up and left-handed: its Y is our Z.
glm::dvec3 toEngine(const glm::dvec3& v) { return {v.x, v.z, v.y}; }

// The four numbers of a colour channel that GetSkySHDiffuseSimple reads.
using Packed = std::array<glm::dvec3, 4>;

// The panorama projected on the engine's basis (Condon-Shortley phase), texel by texel with exact solid angles, and
// packed as docs/shading.md 7e says: X = -C1 V3, Y = -C1 V1, Z = C1 V2, W = C0 V0 - C3 V6.
Packed packByTheEngine(const base::Image& panorama) {
  std::array<glm::dvec3, 9> V{};
  for (int y = 0; y < panorama.height; ++y) {
    const double top = pi * y / panorama.height, bottom = pi * (y + 1) / panorama.height, polar = 0.5 * (top + bottom);
    const double angle = (std::cos(top) - std::cos(bottom)) * 2 * pi / panorama.width;
    for (int x = 0; x < panorama.width; ++x) {
      const double azimuth = ((x + 0.5) / panorama.width - 0.5) * 2 * pi;
      const glm::dvec3 n =
          toEngine({std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth)});
      const float* texel = panorama.at(x, y);
      const glm::dvec3 light = angle * glm::dvec3(texel[0], texel[1], texel[2]);
      V[0] += light * 0.282095;
      V[1] += light * -0.488603 * n.y;
      V[2] += light * 0.488603 * n.z;
      V[3] += light * -0.488603 * n.x;
      V[6] += light * 0.315392 * (3 * n.z * n.z - 1);
    }
  }
  const double root = std::sqrt(pi), C0 = 1 / (2 * root), C1 = std::sqrt(3) / (3 * root),
               C3 = std::sqrt(5) / (16 * root);
  return {-C1 * V[3], -C1 * V[1], C1 * V[2], C0 * V[0] - C3 * V[6]};
}

class SkyOfRealMaps : public testing::TestWithParam<const char*> {};

// Within 1 % of the sky's mean radiance: the program projects a cube of 256^2 faces, this a panorama of 1024 x 512.
TEST_P(SkyOfRealMaps, IsPackedAsTheEngineDoes) {
  const std::filesystem::path file = tests::sharedEnvironment(GetParam());
  if (file.empty()) GTEST_SKIP() << "no " << GetParam();
  std::vector<std::string> warnings;
  const scenes::Environment environment = scenes::loadEnvironment(file.string(), 0, warnings);
  const Packed expected = packByTheEngine(environment.radiance);

  const EnvironmentLight light = makeEnvironmentLight(environment, {.faceSize = 256, .sampleCount = 4});
  shading::f32::IrradianceSh sh;
  for (std::size_t i = 0; i < 9; ++i)
    sh.c[i] = {light.irradianceSh[i].x, light.irradianceSh[i].y, light.irradianceSh[i].z};
  const shading::f32::SkySh sky = shading::f32::packSkySh(sh, 4);
  const shading::f32::real32x3 mean = shading::f32::skyMeanRadiance(sh);
  double largestKept = 0;
  for (double polar = 0.05; polar < pi; polar += 0.3)
    for (double azimuth = 0; azimuth < 6.2; azimuth += 0.5) {
      const glm::dvec3 n(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));
      const glm::dvec3 e = toEngine(n);
      const glm::dvec3 read =
          glm::max(glm::dvec3(0), expected[0] * e.x + expected[1] * e.y + expected[2] * e.z + expected[3]);
      const shading::f32::real3 actual = shading::f32::GetSkySHDiffuseSimple(
          sky, {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
      EXPECT_NEAR(actual.x, read.x, 0.01 * mean.x);
      EXPECT_NEAR(actual.y, read.y, 0.01 * mean.y);
      EXPECT_NEAR(actual.z, read.z, 0.01 * mean.z);
      largestKept = std::max(largestKept, std::abs(expected[3].y / mean.y - 1));
    }
  std::printf("%s: the constant keeps %.1f %% of itself of the second band\n", GetParam(), 100 * largestKept);
  EXPECT_GT(largestKept, 0.02) << "a map that could not tell a constant without it";
}

INSTANTIATE_TEST_SUITE_P(Shared, SkyOfRealMaps,
                         testing::Values("chinese_garden_1k.hdr", "autoshop_01_1k.hdr", "studio_small_05_1k.hdr"));

} // namespace
} // namespace parity::lighting
