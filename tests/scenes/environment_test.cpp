// Environments: cleaning, refusing, and the procedural ones against what their formulas say.
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "base/file.h"
#include "base/image/image_io.h"
#include "fuzz/exr_bytes.h"
#include "scenes/builtin/builtin.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/environment.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"

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
  EXPECT_EQ(warnings[1], "environment huge: 3 of 6 values are above 1e+30 and are set to it");
}

TEST(Environment, RefusesOneWithNothingFinite) {
  base::Image image(1, 2, 3);
  image.pixels = {kNan, kNan, kInf, kInf, -kInf, kNan};
  expectError([&] { scenes::cleanRadiance(image, "x.hdr"); }, {"x.hdr", "no pixel of the environment is finite"});
}

// A picture of 2 x 1 pixels whose values are 1, 2, 3...
base::ImageFile makePicture(const std::vector<std::string>& channels) {
  base::ImageFile file;
  file.pixels = base::Image(2, 1, static_cast<int>(channels.size()));
  std::iota(file.pixels.pixels.begin(), file.pixels.pixels.end(), 1.f);
  file.info.channelNames = channels;
  file.info.fullWidth = 2, file.info.fullHeight = 1;
  return file;
}

TEST(Environment, FindsColoursByTheirNamesAndRefusesOthers) {
  const auto pixels = [](const std::vector<std::string>& channels) {
    return scenes::toPanorama(makePicture(channels), "x.exr").pixels;
  };
  EXPECT_EQ(pixels({"R", "G", "B"}), (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(pixels({"Y"}), (std::vector<float>{1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(pixels({"Y", "A"}), (std::vector<float>{1, 1, 1, 3, 3, 3}));
  EXPECT_EQ(pixels({"R", "G", "B", "A"}), (std::vector<float>{1, 2, 3, 5, 6, 7}));
  EXPECT_EQ(pixels({"B", "G", "R", "Z", "id"}), (std::vector<float>{3, 2, 1, 8, 7, 6}));
  const auto refuses = [&](const std::vector<std::string>& channels, const std::string& listed) {
    expectError([&] { pixels(channels); }, {"x.exr", "has the channels " + listed});
  };
  refuses({"X", "Y", "Z"}, "X, Y, Z");
  refuses({"Y", "RY", "BY"}, "Y, RY, BY");
  refuses({"R", "G"}, "R, G");
  refuses({"Z"}, "Z");
  refuses({"diffuse.R", "diffuse.G", "diffuse.B"}, "diffuse.R");
  expectError([] { scenes::toPanorama({}, "x.exr"); }, {"x.exr", "no pixels"});
  std::vector<std::string> warnings;
  expectError([&] { scenes::loadEnvironment("studio", 0, warnings); },
              {"studio: environment: is no file; did you mean 'builtin:studio'?"});
}

TEST(Environment, RefusesCubeMapsPartsAndOtherShapes) {
  const auto refuses = [](const std::function<void(base::ImageFile&)>& change, const std::string& reason) {
    base::ImageFile file = makePicture({"R", "G", "B"});
    change(file);
    expectError([&] { scenes::toPanorama(file, "x.exr"); }, {"x.exr", reason});
  };
  refuses([](auto& file) { file.info.isCubeMap = true; }, "is a cube map");
  refuses([](auto& file) { file.info.fullWidth = 4, file.info.fullHeight = 2; },
          "dataWindow: holds 2x1 pixels at +0+0 of");
  refuses([](auto& file) { file.info.x = 1; }, "at +1+0");
  refuses([](auto& file) { file.info.orientation = 6; }, "has 1x2 pixels; a latitude-longitude panorama");
  refuses(
      [](auto& file) {
        file.pixels = base::Image(2, 2, 3, 1.f);
        file.info.fullHeight = 2;
      },
      "has 2x2 pixels; a latitude-longitude panorama");
}

// The header's words in an OpenEXR file: the library's own reading of them.
TEST(Environment, RefusesAnExrCubeMapAndALargerDisplayWindow) {
  const TempFolder folder;
  const std::string file = (folder / "sky.exr").string();
  std::vector<std::string> warnings;
  const auto load = [&](const ExrLayout& layout) {
    base::writeBytes(file, makeExr(layout));
    return scenes::loadEnvironment(file, 0, warnings).radiance;
  };
  EXPECT_EQ(load({}).width, 8);
  EXPECT_EQ(load({.envmap = 0}).width, 8) << "latitude and longitude";
  expectError([&] { load({.envmap = 1}); }, {file, "is a cube map"});
  expectError([&] { load({.displayWidth = 16}); }, {file, "dataWindow: holds 8x4 pixels at +0+0 of a picture of 16x4"});
}

// 4 x 2 pixels, numbered from the top left as they are to be seen, stored in each of the eight orders that a Radiance
// file may have.
TEST(Environment, IsTurnedAsTheHeaderOfAnHdrSays) {
  const TempFolder folder;
  const std::string file = (folder / "sky.hdr").string();
  constexpr int kWidth = 4, kHeight = 2;
  for (const char* slow : {"-Y", "+Y", "-X", "+X"})
    for (const char* fast : {"-Y", "+Y", "-X", "+X"}) {
      if (slow[1] == fast[1]) continue;
      const auto length = [](const char* axis) { return axis[1] == 'X' ? kWidth : kHeight; };
      std::string bytes =
          fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{} {} {} {}\n", slow, length(slow), fast, length(fast));
      for (int i = 0; i < length(slow); ++i)
        for (int j = 0; j < length(fast); ++j) {
          const char* alongX = slow[1] == 'X' ? slow : fast;
          const char* alongY = slow[1] == 'Y' ? slow : fast;
          const int along[] = {slow[1] == 'X' ? i : j, slow[1] == 'Y' ? i : j};
          const int x = alongX[0] == '+' ? along[0] : kWidth - 1 - along[0];
          const int y = alongY[0] == '-' ? along[1] : kHeight - 1 - along[1];
          // Mantissas of 1/256 at the exponent 136: as they stand.
          bytes += {static_cast<char>(128 + y * kWidth + x), '\0', '\0', static_cast<char>(136)};
        }
      base::writeText(file, bytes);
      std::vector<std::string> warnings;
      const base::Image radiance = scenes::loadEnvironment(file, 0, warnings).radiance;
      ASSERT_EQ(radiance.width, kWidth) << slow << fast;
      ASSERT_EQ(radiance.height, kHeight) << slow << fast;
      for (int p = 0; p < kWidth * kHeight; ++p) EXPECT_EQ(radiance.pixels[3 * p], 128.f + p) << slow << fast << p;
    }
}

TEST(Environment, IsRefusedBeyondTheLimitsOfLoading) {
  const TempFolder folder;
  const std::string file = (folder / "sky.exr").string();
  base::writeImage(file, base::Image(64, 32, 3, 1.f));
  std::vector<std::string> warnings;
  EXPECT_NO_THROW(scenes::loadEnvironment(file, 0, warnings, {.maxImageSide = 64, .maxMemoryBytes = 1 << 20}));
  expectError([&] { scenes::loadEnvironment(file, 0, warnings, {.maxImageSide = 63}); },
              {file, "64 x 32", "--max-image"});
  expectError([&] { scenes::loadEnvironment(file, 0, warnings, {.maxMemoryBytes = 1000}); },
              {file, "64 x 32", "1 MiB", "--max-memory"});
}

// Filters of denormal numbers took some 20 times as long.
TEST(Environment, HoldsNoValueWhoseProductsWouldBeDenormal) {
  base::Image image(2, 1, 3);
  image.pixels = {1e-40f, 1e-37f, 0.9e-30f, 1.1e-30f, 1e-20f, 2};
  const scenes::CleanedCounts counts = scenes::cleanRadiance(image, "x.hdr");
  EXPECT_EQ(image.pixels, (std::vector<float>{0, 0, 0, 1.1e-30f, 1e-20f, 2}));
  EXPECT_EQ(counts.tooLarge + counts.negative + counts.notANumber + counts.infinite, 0u) << "no light is no defect";
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
  EXPECT_EQ(warnings[1], "environment sick: of 24 values, 1 NaN and 0 negative ones are set to 0, and 1 infinite ones "
                         "to the largest finite value");
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
