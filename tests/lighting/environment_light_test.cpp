// The prefiltered cube and the SH irradiance against closed forms and a brute-force integral.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <span>

#include "base/error.h"
#include "base/expect_error.h"
#include "base/parallel.h"
#include "base/simd_level.h"
#include "lighting/environment/cube.h"
#include "lighting/environment/environment_light.h"
#include "lighting/environment/equirect.h"
#include "shading/shading.h"

namespace parity::lighting {
namespace {

namespace f64 = shading::f64;
using std::numbers::pi;

// A panorama of a function of direction.
scenes::Environment makeEnvironment(int width, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
  scenes::Environment environment;
  environment.name = "test";
  environment.radiance = base::Image(width, width / 2, 3);
  for (int y = 0; y < width / 2; ++y)
    for (int x = 0; x < width; ++x) {
      // u = atan2(z, x) / 2pi + 0.5, v from +Y down (docs/design.md 8d).
      const double azimuth = ((x + 0.5) / width - 0.5) * 2 * pi, polar = (y + 0.5) / (width / 2) * pi;
      const glm::dvec3 d(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));
      const glm::dvec3 l = radiance(d);
      for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = static_cast<float>(l[c]);
    }
  return environment;
}

glm::dvec3 irradiance(const EnvironmentLight& light, const glm::dvec3& n) {
  f64::IrradianceSh sh;
  for (int i = 0; i < 9; ++i)
    sh.c[i] = f64::real3(light.irradianceSh[i].x, light.irradianceSh[i].y, light.irradianceSh[i].z);
  const f64::real3 e = f64::evalIrradianceSH(sh, f64::real3(n.x, n.y, n.z));
  return {e.x, e.y, e.z};
}

const glm::vec4& texelAt(const EnvironmentLight& light, int mip, const glm::dvec3& direction) {
  const int n = light.prefiltered.faceSize >> mip;
  const FacePoint p = facePointOf(direction);
  const auto index = [&](double s) { return std::clamp(static_cast<int>((s + 1) / 2 * n), 0, n - 1); };
  return light.prefiltered.mips[mip][texelIndex(p.face, index(p.s), index(p.t), n)];
}

constexpr PrefilterOptions kSmall{.faceSize = 64, .sampleCount = 128};

TEST(EnvironmentLight, OfACubeIsBitForBitThatOfThePanoramaItCameFrom) {
  const scenes::Environment environment =
      makeEnvironment(64, [](const auto& d) { return glm::dvec3(1 + d.x, 2 + d.y, 30 * (d.z > 0.9)); });
  const PrefilterOptions options{.faceSize = 32, .sampleCount = 16};
  const EnvironmentLight ofCube = makeEnvironmentLight(resampleEquirect(environment, 32), options);
  const EnvironmentLight ofPanorama = makeEnvironmentLight(environment, options);
  EXPECT_EQ(ofCube.prefiltered.mips, ofPanorama.prefiltered.mips);
  EXPECT_EQ(ofCube.irradianceSh, ofPanorama.irradianceSh);
  // By texels of the cube in place of the panorama's cells.
  ASSERT_EQ(ofCube.irradianceCube.size(), ofPanorama.irradianceCube.size());
  for (std::size_t i = 0; i < ofCube.irradianceCube.size(); ++i)
    ASSERT_NEAR(ofCube.irradianceCube[i].x, ofPanorama.irradianceCube[i].x, 5e-3);
  for (const float bad : {-1.f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::vector<glm::vec4> cube = resampleEquirect(environment, 32);
    cube[77].y = bad;
    EXPECT_THROW(makeEnvironmentLight(cube, options), base::Error);
  }
}

TEST(EnvironmentLight, OfAConstantSkyIsThatConstantInEveryMipAndPiTimesItAsIrradiance) {
  const EnvironmentLight light =
      makeEnvironmentLight(makeEnvironment(128, [](const auto&) { return glm::dvec3(0.25, 1, 40); }), kSmall);
  ASSERT_EQ(light.prefiltered.mips.size(), 6u);
  for (const auto& mip : light.prefiltered.mips)
    for (const glm::vec4& texel : mip) {
      ASSERT_NEAR(texel.x, 0.25, 0.25e-5);
      ASSERT_NEAR(texel.y, 1, 1e-5);
      ASSERT_NEAR(texel.z, 40, 40e-5);
      ASSERT_EQ(texel.w, 1);
    }
  for (const glm::dvec3& n : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::normalize(glm::dvec3(1, 2, -3))})
    EXPECT_NEAR(irradiance(light, n).y, pi, 1e-4);
}

TEST(EnvironmentLight, OfALinearGradientHasTheClosedFormIrradiance) {
  const glm::dvec3 g(0.3, -0.5, 0.2);
  const EnvironmentLight light =
      makeEnvironmentLight(makeEnvironment(256, [&](const auto& d) { return glm::dvec3(1 + glm::dot(g, d)); }), kSmall);
  // integral (1 + g.l) max(n.l, 0) dl = pi + 2 pi/3 g.n
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    EXPECT_NEAR(irradiance(light, n).x, pi + 2 * pi / 3 * glm::dot(g, n), 2e-3);
  }
}

TEST(EnvironmentLight, PutsEachDirectionOfThePanoramaAtItsAxis) {
  // Red grows towards +X, green towards +Y, blue towards +Z.
  const EnvironmentLight light =
      makeEnvironmentLight(makeEnvironment(256, [](const auto& d) { return glm::max(d, 0.0); }), kSmall);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 d(0);
    d[axis] = 1;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(texelAt(light, 0, d)[c], c == axis ? 1 : 0, 0.02) << "axis " << axis;
      EXPECT_NEAR(texelAt(light, 0, -d)[c], 0, 0.02) << "axis " << axis;
    }
  }
}

TEST(EnvironmentLight, TurnsWithTheRotationAsGlmRotateDoes) {
  scenes::Environment environment = makeEnvironment(256, [](const auto& d) { return glm::max(d, 0.0); });
  environment.rotationDeg = 90; // +Z goes to +X
  const EnvironmentLight light = makeEnvironmentLight(environment, kSmall);
  EXPECT_NEAR(texelAt(light, 0, {1, 0, 0}).z, 1, 0.02);
  EXPECT_NEAR(texelAt(light, 0, {0, 0, -1}).x, 1, 0.02);
  EXPECT_NEAR(texelAt(light, 0, {0, 1, 0}).y, 1, 0.02);
}

TEST(EnvironmentLight, KeepsTheEnergyOfASingleBrightTexelAnywhere) {
  for (const auto& [x, y] : {std::pair(300, 100), std::pair(17, 255), std::pair(511, 3), std::pair(200, 1)}) {
    scenes::Environment environment = makeEnvironment(1024, [](const auto&) { return glm::dvec3(0); });
    environment.radiance.at(x, y)[1] = 68000;
    const std::vector<glm::vec4> cube = resampleEquirect(environment, 256);
    const std::vector<double> solidAngles = texelSolidAngles(256);
    double energy = 0;
    for (std::size_t i = 0; i < cube.size(); ++i) energy += solidAngles[i % solidAngles.size()] * cube[i].y;
    const double truth = 68000 * (2 * pi / 1024) * (std::cos(pi * y / 512) - std::cos(pi * (y + 1) / 512));
    EXPECT_NEAR(energy / truth, 1, 1e-3) << x << ", " << y;
  }
}

TEST(EnvironmentLight, MipsAreTheGgxLobesOfTheirRoughness) {
  const auto radiance = [](const glm::dvec3& d) { return glm::dvec3(1 + 0.8 * d.x, 0.2 + d.y * d.y, std::exp(d.z)); };
  const EnvironmentLight light =
      makeEnvironmentLight(makeEnvironment(512, radiance), {.faceSize = 128, .sampleCount = 128});
  for (int mip = 1; mip <= f64::kPrefilterRoughestMip; ++mip) {
    const double alpha = std::pow(f64::roughnessFromMip(mip), 2);
    const int n = 128 >> mip;
    for (const auto& [face, x, y] : {std::tuple(0, 0, 0), std::tuple(2, n / 2, 1), std::tuple(5, n - 1, n / 2)}) {
      const glm::dvec3 N = texelDirection(face, x, y, n);
      const glm::dvec3 T = glm::normalize(
                           glm::cross(N, std::abs(N.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0))),
                       B = glm::cross(N, T);
      // integral L D(h) n.l dl / integral D(h) n.l dl by the midpoint rule in (theta, phi), theta stretched to the
      // lobe.
      glm::dvec3 sum(0);
      double weights = 0;
      for (int i = 0; i < 400; ++i) {
        const double s = (i + 0.5) / 400 * std::atan(1 / alpha * std::tan(pi / 4)), tanH = alpha * std::tan(s),
                     theta = 2 * std::atan(tanH);
        const double dTheta = 2 * alpha / (std::cos(s) * std::cos(s)) / (1 + tanH * tanH);
        const double weight = f64::D_GGX(alpha, std::cos(theta / 2)) * std::cos(theta) * std::sin(theta) * dTheta;
        if (weight <= 0) continue;
        for (int j = 0; j < 64; ++j) {
          const double phi = 2 * pi * (j + 0.5) / 64;
          sum += weight * radiance(std::sin(theta) * (std::cos(phi) * T + std::sin(phi) * B) + std::cos(theta) * N);
          weights += weight;
        }
      }
      const glm::dvec3 expected = sum / weights;
      const glm::vec4& actual = light.prefiltered.mips[mip][texelIndex(face, x, y, n)];
      for (int c = 0; c < 3; ++c)
        // The fit for bilinear reading moves texels by 1/12 of the curvature: 1.5 % in the smallest mip.
        EXPECT_NEAR(actual[c], expected[c], 0.02 * expected[c])
            << "mip " << mip << " face " << face << " channel " << c;
    }
  }
}

TEST(EnvironmentLight, HasNoSeamsBetweenFaces) {
  const EnvironmentLight light =
      makeEnvironmentLight(makeEnvironment(256, [](const auto& d) { return glm::dvec3(2 + d.x + d.y * d.z); }), kSmall);
  for (int mip = 0; mip <= f64::kPrefilterRoughestMip; ++mip) {
    const int n = 64 >> mip;
    // Texels on both sides of an edge are one texel apart: they differ no more than neighbours within a face do.
    const double step = 2.5 * 2.0 / n; // largest gradient of the function times the width of a texel
    for (int face = 0; face < 6; ++face)
      for (int i = 0; i < n; ++i)
        for (const auto& [x, y] : {std::pair(0, i), std::pair(n - 1, i), std::pair(i, 0), std::pair(i, n - 1)}) {
          const double s = texelCenter(x, n), t = texelCenter(y, n), out = 1 + 1.0 / n;
          // The point as far beyond the edge as this texel's middle lies before it.
          FacePoint beyond{face, s, t};
          if (x == 0) beyond.s = -out;
          if (x == n - 1) beyond.s = out;
          if (beyond.s == s) beyond.t = y == 0 ? -out : out;
          const float here = light.prefiltered.mips[mip][texelIndex(face, x, y, n)].x,
                      there = texelAt(light, mip, directionOf(beyond)).x;
          ASSERT_LE(std::abs(here - there), step) << "mip " << mip << " face " << face << " texel " << x << "," << y;
        }
  }
}

TEST(EnvironmentLight, StaysFiniteUnderASunBeyondHalfFloats) {
  scenes::Environment environment = makeEnvironment(256, [](const auto&) { return glm::dvec3(1); });
  for (int c = 0; c < 3; ++c) environment.radiance.at(100, 40)[c] = 3e38f;
  const EnvironmentLight light = makeEnvironmentLight(environment, kSmall);
  for (const auto& mip : light.prefiltered.mips)
    for (const glm::vec4& texel : mip) ASSERT_TRUE(std::isfinite(texel.x) && texel.x >= 0);
  EXPECT_TRUE(std::isfinite(light.irradianceSh[0].x));
}

TEST(EnvironmentLight, IsBitIdenticalForAnyNumberOfThreads) {
  const scenes::Environment environment =
      makeEnvironment(128, [](const auto& d) { return glm::dvec3(1 + d.x, 2 + d.y, std::exp(3 * d.z)); });
  const auto all = toBytes(makeEnvironmentLight(environment, kSmall));
  const base::ThreadLimit one(1);
  EXPECT_EQ(toBytes(makeEnvironmentLight(environment, kSmall)), all);
}

struct BestSimdLevelAgain {
  ~BestSimdLevelAgain() { base::useSimdLevel(""); }
};

// Lamps from one cell to a quarter of the sky, so that neighbours open them differently; and faces of all sizes down to
// one texel, which fill no vector.
TEST(EnvironmentLight, IsBitIdenticalByEveryInstructionSet) {
  const BestSimdLevelAgain again;
  const scenes::Environment environment = makeEnvironment(256, [](const auto& d) {
    const double stripes = std::sin(23 * d.x) * std::sin(31 * d.y + 5 * d.z);
    return glm::dvec3(1 + d.x, 2 + d.y, std::exp(3 * d.z)) + (stripes > 0.9 ? 300.0 * stripes : 0.0);
  });
  for (const PrefilterLevels levels : {PrefilterLevels::first, PrefilterLevels::captures, PrefilterLevels::fine})
    for (const int faceSize : {32, 64}) {
      const PrefilterOptions options{.faceSize = faceSize, .sampleCount = 16, .levels = levels};
      std::vector<std::byte> first;
      for (const std::string& level : base::simdLevels()) {
        base::useSimdLevel(level);
        const std::vector<std::byte> bytes = toBytes(makeEnvironmentLight(environment, options));
        if (first.empty()) first = bytes;
        EXPECT_EQ(bytes, first) << level << " " << faceSize;
      }
    }
}

TEST(EnvironmentLight, ComesBackFromItsBytesAndRefusesDamagedOnes) {
  const EnvironmentLight light = makeEnvironmentLight(
      makeEnvironment(64, [](const auto& d) { return glm::dvec3(1 + d.x); }), {.faceSize = 64, .sampleCount = 16});
  std::vector<std::byte> bytes = toBytes(light);
  const EnvironmentLight back = environmentLightFromBytes(bytes);
  EXPECT_EQ(back.prefiltered.faceSize, 64);
  EXPECT_EQ(back.prefiltered.mips, light.prefiltered.mips);
  EXPECT_EQ(back.irradianceSh, light.irradianceSh);
  EXPECT_EQ(back.irradianceCube, light.irradianceCube);
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_THROW(environmentLightFromBytes(std::span(bytes).first(size)), base::Error) << size;
  bytes.push_back(std::byte{0});
  EXPECT_THROW(environmentLightFromBytes(bytes), base::Error);
  bytes.pop_back();
  bytes[0] ^= std::byte{1};
  EXPECT_THROW(environmentLightFromBytes(bytes), base::Error);
  bytes[0] ^= std::byte{1};
  bytes[3] = std::byte{'2'}; // "ENV2"
  base::expectError([&] { environmentLightFromBytes(bytes); }, {"earlier version"});
}

// A sky with one lamp of a texel and a bright half.
TEST(EnvironmentLight, BringsItsLampsAndRefusesThoseThatLeadNowhere) {
  const glm::dvec3 lamp = glm::normalize(glm::dvec3(1, 0.0061, 0.0061)); // the middle of a cell
  const EnvironmentLight light = makeEnvironmentLight(
      makeEnvironment(
          512,
          [&](const auto& d) { return glm::dvec3(d.y > 0 ? 5 : 1) + (glm::dot(d, lamp) > 0.99998 ? 900.0 : 0.0); }),
      {.faceSize = 64, .sampleCount = 8, .levels = PrefilterLevels::fine});
  ASSERT_GE(light.lamps.compact.nodes.size(), 1u);
  ASSERT_GT(light.lamps.wide.nodes.size(), kMaxWideLampLeaves);
  EXPECT_LT(light.lamps.wide.nodes.size(), 2 * kMaxWideLampLeaves);
  std::vector<std::byte> bytes = toBytes(light);
  const EnvironmentLight back = environmentLightFromBytes(bytes);
  ASSERT_EQ(back.lamps.wide.nodes.size(), light.lamps.wide.nodes.size());
  EXPECT_EQ(back.lamps.compact.nodes[0].light, light.lamps.compact.nodes[0].light);
  EXPECT_EQ(back.prefiltered.mips, light.prefiltered.mips);
  // The root of the wide ones: its place among the bytes is behind the header and the irradiance.
  const LampNode& root = light.lamps.wide.nodes[0];
  const auto at = std::search(bytes.begin(), bytes.end(), std::as_bytes(std::span(&root, 1)).begin(),
                              std::as_bytes(std::span(&root, 1)).end());
  ASSERT_NE(at, bytes.end());
  for (const std::uint32_t next : {0u, 0xffffffffu}) {
    LampNode bad = root;
    bad.next = next;
    std::ranges::copy(std::as_bytes(std::span(&bad, 1)), at);
    EXPECT_THROW(environmentLightFromBytes(bytes), base::Error) << next;
  }
}

} // namespace
} // namespace parity::lighting
