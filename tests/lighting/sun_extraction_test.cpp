// Extraction of suns: energy, direction, what is left behind, and what is no sun.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "lighting/environment/cube.h"
#include "lighting/environment/equirect.h"
#include "lighting/environment/sun_extraction.h"
#include "scenes/builtin/builtin.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/load.h"
#include "scenes/view.h"
#include "support/shared_assets.h"

namespace parity::lighting {
namespace {

using std::numbers::pi;

struct Disc {
  double azimuthDeg, elevationDeg, radiusDeg;
  glm::dvec3 radiance;
  glm::dvec3 towards() const { // of the panorama, as the u of docs/design.md 8d has it
    const double a = glm::radians(azimuthDeg), e = glm::radians(elevationDeg);
    return {std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a)};
  }
  double solidAngle() const { return 2 * pi * (1 - std::cos(glm::radians(radiusDeg))); }
};

// Discs on a plain ground, edges smoothed by 12 x 12 points a cell.
scenes::Environment paint(int width, const glm::dvec3& ground, const std::vector<Disc>& discs) {
  scenes::Environment environment;
  environment.name = "test";
  environment.radiance = base::Image(width, width / 2, 3);
  constexpr int kPoints = 12;
  for (int y = 0; y < width / 2; ++y)
    for (int x = 0; x < width; ++x) {
      glm::dvec3 radiance = ground;
      for (const Disc& disc : discs) {
        const double reach = glm::radians(disc.radiusDeg), towards = disc.elevationDeg;
        if (std::abs(90 - 180 * (y + 0.5) / (width / 2) - towards) > disc.radiusDeg + 2) continue;
        int inside = 0;
        for (int i = 0; i < kPoints * kPoints; ++i) {
          const glm::dvec3 d = scenes::directionAt((x + (i % kPoints + 0.5) / kPoints) / width,
                                                   (y + (i / kPoints + 0.5) / kPoints) / (width / 2));
          inside += glm::dot(d, disc.towards()) >= std::cos(reach);
        }
        radiance = glm::mix(radiance, disc.radiance, static_cast<double>(inside) / (kPoints * kPoints));
      }
      for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = static_cast<float>(radiance[c]);
    }
  return environment;
}

// The integral of radiance over solid angle.
glm::dvec3 fluxOf(const scenes::Environment& environment) {
  const base::Image& image = environment.radiance;
  glm::dvec3 sum(0);
  for (int y = 0; y < image.height; ++y) {
    const double area =
        2 * pi / image.width * (std::cos(pi * y / image.height) - std::cos(pi * (y + 1) / image.height));
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) sum[c] += area * image.at(x, y)[c];
  }
  return sum;
}

void expectEnergyKept(const scenes::Environment& before, const SunExtraction& extraction) {
  const glm::dvec3 flux = fluxOf(before);
  glm::dvec3 kept = fluxOf(extraction.environment);
  for (const ExtractedSun& sun : extraction.suns) kept += glm::dvec3(sun.light.color);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(kept[c] / flux[c], 1, 1e-5) << "channel " << c; // wanted: 1e-3
}

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

float largest(const scenes::Environment& environment) {
  return *std::max_element(environment.radiance.pixels.begin(), environment.radiance.pixels.end());
}

class OneDisc : public testing::TestWithParam<Disc> {};

TEST_P(OneDisc, BecomesALightOfItsIrradianceAndDirectionAndLeavesTheGround) {
  const Disc& disc = GetParam();
  const glm::dvec3 ground(0.2, 0.5, 0.25); // exact in float but for .2
  const scenes::Environment before = paint(512, ground, {disc});
  const SunExtraction extraction = extractSuns(before);
  ASSERT_EQ(extraction.suns.size(), 1u);
  const scenes::Light& light = extraction.suns[0].light;
  EXPECT_EQ(light.kind, scenes::LightKind::directional);
  EXPECT_EQ(light.name, "sun 1 of test");
  expectEnergyKept(before, extraction);
  const glm::dvec3 lux = (disc.radiance - ground) * disc.solidAngle(), painted = fluxOf(before) - 4 * pi * ground;
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(painted[c] / lux[c], 1, 0.025) << "the painter's edges, channel " << c;
    EXPECT_NEAR(light.color[c] / painted[c], 1, 1e-4) << "channel " << c;
  }
  EXPECT_NEAR(glm::length(light.direction), 1, 1e-6);
  EXPECT_LT(degreesBetween(-glm::dvec3(light.direction), disc.towards()), 0.1 * 360 / 512); // of a cell
  // Where it stood is the ground again, neither darker nor brighter.
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = c; i < extraction.environment.radiance.pixels.size(); i += 3)
      ASSERT_NEAR(extraction.environment.radiance.pixels[i], ground[c], 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Places, OneDisc,
                         testing::Values(Disc{40, 30, 0.6, {3000, 2000, 900}}, Disc{179.9, -20, 1.2, {900, 800, 700}},
                                         Disc{-180, 5, 2.4, {400, 500, 300}}, Disc{75, 88.5, 1, {2000, 2000, 900}},
                                         Disc{10, 90, 2, {2000, 2000, 900}}, Disc{-60, -89, 2, {700, 800, 700}}));

TEST(SunExtraction, TurnsWithTheEnvironment) {
  const Disc disc{40, 30, 1, {3000, 2000, 900}};
  scenes::Environment environment = paint(512, glm::dvec3(0.5), {disc});
  environment.rotationDeg = 70;
  const SunExtraction extraction = extractSuns(environment);
  ASSERT_EQ(extraction.suns.size(), 1u);
  // What stands at azimuth a of the panorama is seen at a - 70: equirect.h; and where --sun puts a sun of that azimuth.
  const glm::dvec3 seen(extraction.suns[0].light.direction);
  EXPECT_LT(degreesBetween(seen, glm::dvec3(scenes::makeSun({40 - 70, 30, 1}).direction)), 0.1);
  EXPECT_EQ(extraction.environment.rotationDeg, 70);
  // And the cube shows the disc there.
  const std::vector<glm::vec4> cube = resampleEquirect(environment, 64);
  std::size_t brightest = 0;
  for (std::size_t i = 0; i < cube.size(); ++i)
    if (cube[i].x > cube[brightest].x) brightest = i;
  const int face = static_cast<int>(brightest / 4096), x = static_cast<int>(brightest % 64),
            y = static_cast<int>(brightest / 64 % 64);
  EXPECT_LT(degreesBetween(-seen, texelDirection(face, x, y, 64)), 1.5);
}

TEST(SunExtraction, OfTwoSourcesTheBrighterComesFirst) {
  // The fainter light has the higher peak.
  const std::vector<Disc> discs = {{40, 30, 0.5, glm::dvec3(4000)}, {-100, 10, 2, glm::dvec3(1000)}};
  const scenes::Environment before = paint(512, glm::dvec3(0.5), discs);
  const SunExtraction extraction = extractSuns(before);
  ASSERT_EQ(extraction.suns.size(), 2u);
  expectEnergyKept(before, extraction);
  EXPECT_LT(degreesBetween(-glm::dvec3(extraction.suns[0].light.direction), discs[1].towards()), 0.1);
  EXPECT_LT(degreesBetween(-glm::dvec3(extraction.suns[1].light.direction), discs[0].towards()), 0.1);
  EXPECT_EQ(extraction.suns[1].light.name, "sun 2 of test");
}

TEST(SunExtraction, PutsBackExactlyWhatItTook) {
  const scenes::Environment before =
      paint(256, glm::dvec3(0.3),
            {{40, 30, 1, glm::dvec3(4000)}, {-100, 10, 2, glm::dvec3(1000)}, {90, 0, 1, glm::dvec3(2000)}});
  const SunExtraction extraction = extractSuns(before);
  ASSERT_EQ(extraction.suns.size(), 3u);
  EXPECT_EQ(putBackSuns(extraction, std::nullopt).radiance, before.radiance);
  const scenes::Environment withoutSecond = putBackSuns(extraction, 1);
  const glm::dvec3 missing = fluxOf(before) - fluxOf(withoutSecond);
  EXPECT_NEAR(missing.x / extraction.suns[1].light.color.x, 1, 1e-4);
}

TEST(SunExtraction, KeepsToTheNumberThatShadingCanAfford) {
  std::vector<Disc> discs;
  for (int i = 0; i < 12; ++i) discs.push_back({30.0 * i - 170, 10, 1, glm::dvec3(1000 + 100 * i)});
  const scenes::Environment before = paint(256, glm::dvec3(0.3), discs);
  const SunExtraction extraction = extractSuns(before);
  ASSERT_EQ(extraction.suns.size(), static_cast<std::size_t>(kMaxExtractedSuns));
  expectEnergyKept(before, extraction);
  for (std::size_t i = 0; i < extraction.suns.size(); ++i)
    EXPECT_LT(degreesBetween(-glm::dvec3(extraction.suns[i].light.direction), discs[11 - i].towards()), 0.1);
}

// A gradient of 1:3 across the hole.
TEST(SunExtraction, FillsTheHoleAsItsSurroundingsGo) {
  const Disc disc{0, 20, 1.5, glm::dvec3(3000)};
  scenes::Environment sky = paint(512, glm::dvec3(0.5), {});
  scenes::Environment before = paint(512, glm::dvec3(0.5), {disc});
  for (scenes::Environment* environment : {&sky, &before})
    for (int y = 0; y < 256; ++y)
      for (int x = 0; x < 512; ++x)
        for (int c = 0; c < 3; ++c)
          environment->radiance.at(x, y)[c] += static_cast<float>(0.25 * std::clamp((x - 256) / 8.0, -1.0, 1.0));
  const SunExtraction extraction = extractSuns(before);
  ASSERT_EQ(extraction.suns.size(), 1u);
  double worst = 0;
  for (const ExtractedSun::Cell& cell : extraction.suns[0].cells) {
    EXPECT_GE(cell.remainder.x, 0.25f);
    EXPECT_LE(cell.remainder.x, 0.75f);
    worst = std::max(worst, std::abs(cell.remainder.x / double{sky.radiance.pixels[3 * cell.index]} - 1));
  }
  EXPECT_LT(worst, 0.25); // the mean of the rim would be 50 % off
}

TEST(SunExtraction, TakesNeitherPlainMapsNorLargeOrFaintLights) {
  EXPECT_TRUE(extractSuns(paint(128, glm::dvec3(0), {})).suns.empty());
  EXPECT_TRUE(extractSuns(paint(128, glm::dvec3(7), {})).suns.empty());
  for (const char* name : {"studio", "night", "white"})
    EXPECT_TRUE(extractSuns(scenes::makeBuiltinEnvironment(name)).suns.empty()) << name;
  const struct {
    const char* what;
    Disc disc;
  } cases[] = {{"a softbox, the brightness of a sun", {40, 30, 6, glm::dvec3(3000)}},
               {"an overcast patch", {40, 60, 30, glm::dvec3(20)}},
               {"a glint, bright but next to nothing", {40, 30, 0.3, glm::dvec3(500)}},
               {"a dim lamp", {40, 30, 2, glm::dvec3(20)}}};
  for (const auto& [what, disc] : cases) {
    const scenes::Environment before = paint(256, glm::dvec3(0.5), {disc});
    const SunExtraction extraction = extractSuns(before);
    EXPECT_TRUE(extraction.suns.empty()) << what;
    EXPECT_EQ(extraction.environment.radiance, before.radiance) << what;
  }
  // The same, a little smaller or brighter, are sources: the cases above miss by what they are named for.
  EXPECT_EQ(extractSuns(paint(256, glm::dvec3(0.5), {{40, 30, 2, glm::dvec3(3000)}})).suns.size(), 1u);
  EXPECT_EQ(extractSuns(paint(256, glm::dvec3(0.5), {{40, 30, 0.3, glm::dvec3(50000)}})).suns.size(), 1u);
}

TEST(SunExtraction, LeavesWhatIsNoRadianceToWhoRefusesIt) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.f}) {
    scenes::Environment environment = paint(64, glm::dvec3(0.5), {});
    environment.radiance.at(3, 9)[1] = bad;
    const SunExtraction extraction = extractSuns(environment);
    EXPECT_TRUE(extraction.suns.empty());
    EXPECT_THROW(resampleEquirect(extraction.environment, 32), base::Error) << bad;
  }
  EXPECT_TRUE(extractSuns({}).suns.empty());
}

TEST(SunExtraction, TakesTheSunOfTheBuiltInSky) {
  const scenes::SkyOptions options;
  const scenes::Environment sky = scenes::makeSky(options);
  const SunExtraction extraction = extractSuns(sky);
  ASSERT_EQ(extraction.suns.size(), 1u);
  expectEnergyKept(sky, extraction);
  const scenes::Light& sun = extraction.suns[0].light;
  const auto azimuth = static_cast<float>(options.sunAzimuthDeg),
             elevation = static_cast<float>(options.sunElevationDeg);
  EXPECT_LT(degreesBetween(glm::dvec3(sun.direction), glm::dvec3(scenes::makeSun({azimuth, elevation, 1}).direction)),
            0.05);
  // The soft edge (smoothstep over half a radius) adds its variance, 1/20 of (r/2)^2, to r^2: 1.25 %.
  EXPECT_NEAR(sun.color.g, options.sunIrradiance * 1.0125, 0.01);
  // What is left is the sky without a sun, its aureole cut off.
  const scenes::Environment sunless = scenes::makeSky({.sunIrradiance = 0});
  for (const ExtractedSun::Cell& cell : extraction.suns[0].cells)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(cell.remainder[c] / sunless.radiance.pixels[3 * cell.index + c], 1, 0.12);
}

scenes::Environment loadShared(const std::string& file) {
  const std::filesystem::path path = tests::sharedEnvironment(file);
  std::vector<std::string> warnings;
  return path.empty() ? scenes::Environment{} : scenes::loadEnvironment(path.string(), 0, warnings);
}

// Frozen where this file was written; the sun's place by eye in the panorama: column 615, row 169 of 1024 x 512.
TEST(SunExtraction, FindsTheSunOfTheGarden) {
  const scenes::Environment garden = loadShared("chinese_garden_1k.hdr");
  if (garden.radiance.empty()) GTEST_SKIP() << "no chinese_garden_1k.hdr";
  const SunExtraction extraction = extractSuns(garden);
  ASSERT_EQ(extraction.suns.size(), 1u);
  expectEnergyKept(garden, extraction);
  const glm::dvec3 peak = scenes::directionAt(615.5 / 1024, 169.5 / 512);
  EXPECT_LT(degreesBetween(-glm::dvec3(extraction.suns[0].light.direction), peak), 0.3);
  EXPECT_NEAR(extraction.suns[0].light.color.g, 4.964, 0.01);
  EXPECT_LT(largest(extraction.environment), 10); // of 68,000
}

TEST(SunExtraction, FindsTheLampsOfTheNightAndNoneInTheStudio) {
  const scenes::Environment night = loadShared("st_peters_square_night_1k.hdr"),
                            studio = loadShared("studio_small_05_1k.hdr");
  if (night.radiance.empty() || studio.radiance.empty()) GTEST_SKIP() << "no st_peters_square_night_1k.hdr or studio";
  const SunExtraction extraction = extractSuns(night);
  EXPECT_EQ(extraction.suns.size(), 5u);
  expectEnergyKept(night, extraction);
  EXPECT_TRUE(extractSuns(studio).suns.empty());
}

} // namespace
} // namespace parity::lighting
