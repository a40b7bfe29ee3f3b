// Environments: cleaning, refusing, and the procedural ones against what their formulas say.
#include <cmath>
#include <limits>

#include <glm/gtc/constants.hpp>

#include "base/image_io.h"
#include "scenes/builtin.h"
#include "scenes/environment.h"
#include "scenes/gltf_writer.h"
#include "scenes/load.h"
#include "scenes/procedural_environment.h"

namespace parity::tests {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(Environment, CleansWhatNoRendererCanUseAndCountsIt) {
  base::Image image(2, 2, 3);
  image.pixels = {kNan, 1, 2, kInf, 7, -3, 0, -kInf, 5, -kNan, 0.5f, 0};
  const scenes::CleanedCounts counts = scenes::cleanRadiance(image, "x.hdr");
  EXPECT_EQ(counts.notANumber, 2u);
  EXPECT_EQ(counts.infinite, 1u);
  EXPECT_EQ(counts.negative, 2u);
  EXPECT_EQ(image.pixels, (std::vector<float>{0, 1, 2, 7, 7, 0, 0, 0, 5, 0, 0.5f, 0}));
  EXPECT_EQ(scenes::cleanRadiance(image, "x.hdr").notANumber, 0u) << "once cleaned, clean";
}

TEST(Environment, BringsWhatIsNearTheFloatLimitDownAndSaysSo) {
  const TempFolder folder;
  base::Image image(2, 1, 3, 1.f);
  image.pixels = {1, std::numeric_limits<float>::max(), 2e30f, 1e30f, kInf, 0};
  base::writeImage(folder / "huge.exr", image);
  std::vector<std::string> warnings;
  const scenes::Environment environment = scenes::loadEnvironment((folder / "huge.exr").string(), 0, warnings);
  EXPECT_EQ(environment.radiance.pixels, (std::vector<float>{1, 1e30f, 1e30f, 1e30f, 1e30f, 0}));
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[1], "environment huge: 3 of 6 values are above 1e+30 and became that");
}

TEST(Environment, RefusesOneWithNothingFinite) {
  base::Image image(1, 2, 3);
  image.pixels = {kNan, kNan, kInf, kInf, -kInf, kNan};
  expectError([&] { scenes::cleanRadiance(image, "x.hdr"); }, {"x.hdr", "no pixel of the environment is finite"});
}

TEST(Environment, SpreadsGreyDropsAlphaAndRefusesOtherChannels) {
  base::Image grey(2, 1, 1);
  grey.pixels = {1, 2};
  EXPECT_EQ(scenes::toRgb(grey, "x").pixels, (std::vector<float>{1, 1, 1, 2, 2, 2}));
  base::Image rgba(1, 1, 4);
  rgba.pixels = {1, 2, 3, 0.5f};
  EXPECT_EQ(scenes::toRgb(rgba, "x").pixels, (std::vector<float>{1, 2, 3}));
  expectError([] { scenes::toRgb(base::Image(1, 1, 2), "x.exr"); }, {"x.exr", "2 channels"});
  expectError([] { scenes::toRgb(base::Image(1, 1, 6), "x.exr"); }, {"x.exr", "6 channels"});
  expectError([] { scenes::toRgb(base::Image(), "x.exr"); }, {"x.exr", "no pixels"});
}

TEST(Environment, LoadsFilesWithOneWarningForAllThatWasCleaned) {
  const TempFolder folder;
  base::Image image(4, 2, 3, 0.25f);
  image.pixels[0] = kNan;
  image.pixels[5] = kInf;
  base::writeImage(folder / "sick.exr", image);
  std::vector<std::string> warnings = {"earlier"};
  const scenes::Environment environment = scenes::loadEnvironment((folder / "sick.exr").string(), 30, warnings);
  EXPECT_EQ(environment.name, "sick");
  EXPECT_EQ(environment.rotationDeg, 30.f);
  EXPECT_EQ(environment.radiance.width, 4);
  EXPECT_EQ(environment.radiance.pixels[0], 0.f);
  EXPECT_EQ(environment.radiance.pixels[5], 0.25f);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[1],
            "environment sick: of 24 values, 1 NaN and 0 negative became 0, 1 infinite the largest finite");
}

TEST(Environment, RefusesMissingTruncatedAndInteger) {
  const TempFolder folder;
  std::vector<std::string> warnings;
  const auto load = [&](const std::string& name) { scenes::loadEnvironment((folder / name).string(), 0, warnings); };
  expectError([&] { load("none.hdr"); }, {"none.hdr"});
  writeFile(folder / "text.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n"));
  expectError([&] { load("text.hdr"); }, {"text.hdr"});
  writeFile(folder / "noise.exr", std::string("not an image"));
  expectError([&] { load("noise.exr"); }, {"noise.exr"});
  writeFile(folder / "picture.png", makePng(4, 2));
  expectError([&] { load("picture.png"); }, {"picture.png", ".hdr, .exr or .pfm"});
  expectError([&] { scenes::loadEnvironment("builtin:ski", 0, warnings); }, {"did you mean 'builtin:sky'?"});
  expectError([&] { scenes::loadEnvironment("builtin:sky", kNan, warnings); }, {"--env-rotation"},
              base::ExitCode::usage);
  EXPECT_TRUE(warnings.empty());
}

TEST(Environment, BuiltInOnesAreFiniteDeterministicAndNotBlack) {
  for (const std::string& name : scenes::builtinEnvironmentNames()) {
    const scenes::Environment environment = scenes::makeBuiltinEnvironment(name);
    EXPECT_EQ(environment.name, name);
    EXPECT_EQ(environment.radiance.channels, 3);
    double sum = 0;
    for (const float value : environment.radiance.pixels) {
      ASSERT_TRUE(std::isfinite(value) && value >= 0) << name;
      sum += value;
    }
    EXPECT_GT(sum, 0) << name;
    EXPECT_EQ(environment.radiance, scenes::makeBuiltinEnvironment(name).radiance) << name;
  }
  for (const float value : scenes::makeWhite().radiance.pixels) ASSERT_EQ(value, 1.f);
}

TEST(Environment, DirectionsFollowTheConvention) {
  const glm::dvec3 up = scenes::directionAt(0.3, 0), alongX = scenes::directionAt(0.5, 0.5),
                   alongZ = scenes::directionAt(0.75, 0.5);
  EXPECT_NEAR(glm::length(up - glm::dvec3(0, 1, 0)), 0, 1e-12);
  EXPECT_NEAR(glm::length(alongX - glm::dvec3(1, 0, 0)), 0, 1e-12); // u = atan2(0, 1) / 2pi + 0.5
  EXPECT_NEAR(glm::length(alongZ - glm::dvec3(0, 0, 1)), 0, 1e-12);
}

// Cosine- or direction-weighted integral of the luma over the sphere, by the midpoint rule.
double integrate(const scenes::Environment& environment, const std::function<double(const glm::dvec3&)>& weight) {
  const base::Image& image = environment.radiance;
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    const double v = (y + 0.5) / image.height;
    const double solidAngle =
        glm::two_pi<double>() / image.width * glm::pi<double>() / image.height * std::sin(glm::pi<double>() * v);
    for (int x = 0; x < image.width; ++x) {
      const float* p = image.at(x, y);
      sum += (0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]) * weight(scenes::directionAt((x + 0.5) / image.width, v)) *
             solidAngle;
    }
  }
  return sum;
}

TEST(Sky, HasTheIrradianceItWasAskedFor) {
  scenes::SkyOptions options;
  options.sunIrradiance = 0;
  const auto level = [](const glm::dvec3& d) { return std::max(d.y, 0.0); };
  EXPECT_NEAR(integrate(scenes::makeSky(options), level), options.skyIrradiance, 0.01 * options.skyIrradiance);

  options.sunIrradiance = 2.2; // the difference is the sun's, tinted: luma of the tint
  const double a = glm::radians(options.sunAzimuthDeg), e = glm::radians(options.sunElevationDeg);
  const glm::dvec3 sun(std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a));
  const auto facing = [&](const glm::dvec3& d) { return d.y > 0 ? std::max(glm::dot(d, sun), 0.0) : 0.0; };
  scenes::SkyOptions without = options;
  without.sunIrradiance = 0;
  const double tint = 0.2126 * 1.04 + 0.7152 + 0.0722 * 0.86;
  const double measured = integrate(scenes::makeSky(options), facing) - integrate(scenes::makeSky(without), facing);
  EXPECT_NEAR(measured, 2.2 * tint, 0.04 * 2.2) << "a soft edge, sampled by texels of 0.7 degrees";
}

TEST(Sky, SunStandsWhereAskedAndTheGroundBelow) {
  scenes::SkyOptions options;
  options.sunAzimuthDeg = -100;
  options.sunElevationDeg = 25;
  const scenes::Environment sky = scenes::makeSky(options);
  float brightest = 0;
  glm::dvec3 direction(0);
  for (int y = 0; y < sky.radiance.height; ++y)
    for (int x = 0; x < sky.radiance.width; ++x)
      if (sky.radiance.at(x, y)[1] > brightest) {
        brightest = sky.radiance.at(x, y)[1];
        direction = scenes::directionAt((x + 0.5) / sky.radiance.width, (y + 0.5) / sky.radiance.height);
      }
  const double a = glm::radians(-100.0), e = glm::radians(25.0);
  const glm::dvec3 expected(std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a));
  EXPECT_GT(glm::dot(direction, expected), std::cos(glm::radians(2.5)));
  // The ground is one colour.
  const float* nadir = sky.radiance.at(0, sky.radiance.height - 1);
  const float* below = sky.radiance.at(100, sky.radiance.height * 3 / 4);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(nadir[c], below[c]);
}

// Preetham et al. 1999, A.2, turbidity 3, by hand: A = -0.9269, B = -0.6387, C = 5.2570, D = -2.2153, E = 0.1693.
// At theta = pi/3, gamma = pi/6, thetaSun = pi/4:
// (1 + A e^(2B)) (1 + C e^(D pi/6) + 0.75 E) / ((1 + A e^B) (1 + C e^(D pi/4) + 0.5 E)).
TEST(Sky, PerezDistributionMatchesThePaper) {
  const double pi = glm::pi<double>();
  const double f = (1 - 0.9269 * std::exp(-2 * 0.6387)) * (1 + 5.2570 * std::exp(-2.2153 * pi / 6) + 0.1693 * 0.75);
  const double zenith = (1 - 0.9269 * std::exp(-0.6387)) * (1 + 5.2570 * std::exp(-2.2153 * pi / 4) + 0.1693 * 0.5);
  EXPECT_NEAR(scenes::perezLuminance(3, pi / 3, pi / 6, pi / 4), f / zenith, 1e-12);
  EXPECT_NEAR(scenes::perezLuminance(3, 0, pi / 4, pi / 4), 1, 1e-12) << "the zenith itself";
}

} // namespace
} // namespace parity::tests
