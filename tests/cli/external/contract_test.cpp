// parity contract, calibrate and render --ids: our own path renders what a contract asks for.
#include <cmath>

#include <fmt/format.h>

#include "base/image/image_io.h"
#include "cli/checks.h"
#include "external/registration.h"
#include "external/transfer.h"
#include "report/schema_validator.h"

namespace parity::tests {
namespace {

class ContractTest : public RenderingTest {
protected:
  void makeContract() const {
    ASSERT_TRUE(
        exitedWith(0, runParity({"contract", "builtin:materials", "--env", "builtin:sky", "--env-rotation", "40", "-o",
                                 path("contract"), "--size", "96x64", "--max-image", "4096,64", "--validation"})));
  }
  nlohmann::json contract() const {
    return nlohmann::json::parse(readWholeFile(m_folder / "contract" / "contract.json"));
  }
  // The calibration scene by our own path, linear.
  base::Image calibration(const std::vector<std::string>& more = {}) const {
    EXPECT_TRUE(exitedWith(0, runParity(join({{"render", path("contract/calibration.glb"), "--camera", "calibration",
                                               "--path", "highend", "--env", path("contract/calibration.hdr"), "--size",
                                               "512x512", "--background", "0,0,0", "-o", path("calibration.exr")},
                                              more}))));
    return base::readImage(path("calibration.exr"));
  }
  std::vector<std::string> calibrate(const base::Image& light,
                                     external::Transfer transfer = external::Transfer::srgb) const {
    base::Image8 values(light.width, light.height, 3);
    for (std::size_t i = 0; i < light.pixelCount(); ++i) {
      const float* c = &light.pixels[3 * i];
      const external::Rgb value = external::encode(transfer, {c[0], c[1], c[2]});
      for (std::size_t k = 0; k < 3; ++k)
        values.pixels[3 * i + k] = static_cast<std::uint8_t>(std::clamp(value[k], 0.0, 1.0) * 255 + 0.5);
    }
    base::writeImage8(path("calibration.png"), values);
    const RunResult run = runParity({"calibrate", path(""), "--verbose"});
    EXPECT_TRUE(exitedWith(0, run));
    return linesOf(run.out).empty() ? std::vector<std::string>(4) : linesOf(run.out);
  }
};

TEST_F(ContractTest, HoldsWhatAnEngineNeeds) {
  makeContract();
  const nlohmann::json json = contract();
  EXPECT_EQ(json["format"], 1);
  ASSERT_EQ(json["scenes"].size(), 1u);
  const nlohmann::json& scene = json["scenes"][0];
  for (const std::string& file : {scene["scene"].get<std::string>(), scene["environment"]["file"].get<std::string>(),
                                  scene["views"][0]["ids"].get<std::string>(),
                                  scene["views"][0]["linear"].get<std::string>(), std::string("calibration.glb")})
    EXPECT_TRUE(std::filesystem::exists(m_folder / "contract" / file)) << file;
  EXPECT_EQ(scene["lights"].size(), 1u) << "the sky's sun";
  EXPECT_EQ(scene["views"][0]["width"], 96);
  EXPECT_EQ(scene["views"][0]["picture"], "materials-auto.png");
  const base::ImageFile ids = base::readImageFile(m_folder / "contract" / scene["views"][0]["ids"]);
  EXPECT_EQ(ids.info.channelNames.size(), 3u);
}

// Of lights of each kind, an orthographic and a perspective camera, with and without an environment.
TEST_F(ContractTest, IsAsItsSchemaSays) {
  const nlohmann::json schema =
      nlohmann::json::parse(readWholeFile(PARITY_SOURCE_DIR "/integrations/contract.schema.json"));
  const auto errors = [&](const nlohmann::json& json) {
    std::string text;
    for (const std::string& line : report::validate(schema, json)) text += line + "\n";
    return text;
  };
  makeContract();
  EXPECT_EQ(errors(contract()), "");
  ASSERT_TRUE(exitedWith(0, runParity({"contract", "builtin:lamps", "builtin:spheres", "-o", path("contract"), "--size",
                                       "32x32", "--falloff", "ue4", "--exposure", "1.5", "--samples", "4"})));
  nlohmann::json json = contract();
  EXPECT_EQ(errors(json), "");
  EXPECT_EQ(json["scenes"][0]["lights"][0]["falloff"], "ue4");
  json["scenes"][0]["views"][0]["camera"]["view"].push_back(0);
  json["scenes"][1]["views"][0].erase("picture");
  json["format"] = 2;
  EXPECT_EQ(linesOf(errors(json)).size(), 3u) << errors(json);
}

// The map that a contract holds lights the scene as the turned one does: else its bright sides are elsewhere.
TEST_F(ContractTest, TheEnvironmentIsTurnedAsTheViewsShowIt) {
  ASSERT_TRUE(exitedWith(0, runParity({"contract", "builtin:materials", "--env", "builtin:studio", "--env-rotation",
                                       "40", "-o", path("contract"), "--size", "96x64"})));
  ASSERT_EQ(contract()["scenes"][0]["lights"].size(), 0u);
  const auto lit = [&](const std::vector<std::string>& light) {
    return render("builtin:materials", "highend", join({{"--size", "96x64"}, light}));
  };
  const base::Image turned = lit({"--env", "builtin:studio", "--env-rotation", "40"}),
                    exported = lit({"--env", path("contract/0/environment.hdr")}),
                    other = lit({"--env", path("contract/0/environment.hdr"), "--env-rotation", "-80"});
  const auto difference = [&](const base::Image& a) {
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
      sum += std::abs(a.pixels[i] - turned.pixels[i]), all += turned.pixels[i];
    return sum / all;
  };
  EXPECT_LT(difference(exported), 0.02);
  EXPECT_GT(difference(other), 3 * difference(exported));
}

TEST_F(ContractTest, AChosenVariantIsWritten) {
  ASSERT_TRUE(exitedWith(0, runParity({"export", "builtin:materials", "-o", path("plain.glb")})));
  const std::vector<std::string> options = {"-o", path("contract"), "--size", "32x32", "--env", "builtin:studio"};
  ASSERT_TRUE(exitedWith(0, runParity(join({{"contract", path("plain.glb")}, options}))));
  EXPECT_EQ(contract()["scenes"][0]["scene"], "../plain.glb");
  ASSERT_TRUE(exitedWith(0, runParity(join({{"contract", path("plain.glb"), "--subject", "ball"}, options}))));
  EXPECT_EQ(contract()["scenes"][0]["scene"], "0/scene.glb") << "the file shows something else";
}

TEST_F(ContractTest, NothingIsOverwrittenThatIsRead) {
  ASSERT_TRUE(exitedWith(0, runParity({"export", "builtin:spheres", "-o", path("calibration.glb")})));
  const std::string before = readWholeFile(path("calibration.glb"));
  expectRefused(runParity({"contract", path("calibration.glb"), "-o", path("")}), 64, {"calibration.glb"});
  EXPECT_EQ(readWholeFile(path("calibration.glb")), before);
}

TEST_F(ContractTest, TwoPicturesOfOneNameAreRefused) {
  write("two.toml", "[[scene]]\nname = \"A b\"\nfile = \"builtin:spheres\"\n[[scene]]\nname = \"A_b\"\nfile = "
                    "\"builtin:spheres\"\n");
  expectRefused(runParity({"contract", "--suite", path("two.toml"), "-o", path("contract"), "--size", "32x32"}), 64,
                {"A_b-auto.png"});
}

// The exported scene under the exported light is the same picture.
TEST_F(ContractTest, TheSameViewRenderedFromItIsTheSamePicture) {
  makeContract();
  const nlohmann::json scene = contract()["scenes"][0];
  const nlohmann::json& light = scene["lights"][0];
  const auto number = [](const nlohmann::json& v, int i) { return v[static_cast<std::size_t>(i)].get<double>(); };
  const nlohmann::json& d = light["direction"];
  const double azimuth = std::atan2(-number(d, 2), -number(d, 0)) * 180 / M_PI,
               elevation = std::asin(-number(d, 1)) * 180 / M_PI;
  // --sun is white; the sun's colour is looked at by its mean.
  const double lux = (number(light["color"], 0) + number(light["color"], 1) + number(light["color"], 2)) / 3;
  const base::Image again =
      render(path("contract/" + scene["scene"].get<std::string>()), "highend",
             {"--env", path("contract/" + scene["environment"]["file"].get<std::string>()), "--no-sun-extraction",
              "--camera", "default", "--sun", fmt::format("{},{},{}", azimuth, elevation, lux), "--size", "96x64"});
  const base::Image before = base::readImage(m_folder / "contract" / scene["views"][0]["linear"]);
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < before.pixels.size(); ++i)
    difference += std::abs(again.pixels[i] - before.pixels[i]), sum += before.pixels[i];
  EXPECT_LT(difference / sum, 0.05);
}

TEST_F(ContractTest, OurOwnPathIsCalibrated) {
  makeContract();
  const base::Image light = calibration();
  const std::vector<std::string> lines = calibrate(light);
  ASSERT_EQ(lines.size(), 4u);
  double dx = 9, dy = 9, scale = 0, turn = 9;
  ASSERT_EQ(std::sscanf(lines[0].c_str(), "place %lf pixels to the right, %lf down; scale %lf; turned by %lf", &dx, &dy,
                        &scale, &turn),
            4)
      << lines[0];
  EXPECT_LT(std::hypot(dx, dy), 0.05);
  EXPECT_NEAR(scale, 1, 1e-3);
  EXPECT_NEAR(turn, 0, 0.05);
  EXPECT_TRUE(contains(lines[1], "srgb (")) << lines[1];
  EXPECT_TRUE(contains(lines[2], "one sample")) << lines[2];
  double yaw = 9, all = 9;
  ASSERT_EQ(
      std::sscanf(lines[3].c_str(), "environment turned by %lf degrees about the vertical, %lf in all", &yaw, &all), 2)
      << lines[3];
  EXPECT_LT(all, 0.2);
}

TEST_F(ContractTest, TransfersAreToldApartOnPicturesOfEightBits) {
  makeContract();
  const base::Image light = calibration();
  for (const char* name : external::kTransferNames) {
    const std::vector<std::string> lines = calibrate(light, *external::findTransfer(name));
    EXPECT_TRUE(contains(lines[1], fmt::format("curve        {} (", name))) << name << ": " << lines[1];
  }
}

// Cineon of three.js: no curve that parity knows, but one for each channel.
TEST_F(ContractTest, ACurveThatIsNotKnownIsReadFromTheRamp) {
  makeContract();
  base::Image light = calibration();
  for (float& value : light.pixels) {
    const double v = std::max(0.0, static_cast<double>(value) - 0.004);
    value = static_cast<float>((v * (6.2 * v + 0.5)) / (v * (6.2 * v + 1.7) + 0.06));
  }
  const std::vector<std::string> lines = calibrate(light, external::Transfer::linear);
  EXPECT_TRUE(contains(lines[1], "none of the known ones")) << lines[1];
  EXPECT_TRUE(contains(lines[1], "transfer = \"fitted\" reads it from the ramp")) << lines[1];
  // A curve that turns saturated colours pale is none of single channels.
  base::Image mixed = calibration();
  for (std::size_t i = 0; i < mixed.pixelCount(); ++i) {
    float* c = &mixed.pixels[3 * i];
    const float most = std::max({c[0], c[1], c[2]});
    for (int k = 0; k < 3; ++k) c[k] = std::pow(0.8f * c[k] + 0.2f * most, 0.35f);
  }
  const std::vector<std::string> told = calibrate(mixed, external::Transfer::linear);
  EXPECT_TRUE(contains(told[1], "It mixes channels")) << told[1];
}

TEST_F(ContractTest, TheWidthOfTheFilterIsFound) {
  makeContract();
  for (const double width : {0.5, 1.0, 1.5, 2.0}) {
    const std::vector<std::string> lines =
        calibrate(calibration({"--samples", "64", "--filter-width", fmt::format("{}", width)}));
    double found = 0;
    ASSERT_EQ(std::sscanf(lines[2].c_str(), "filter as wide as a box of %lf", &found), 1) << lines[2];
    EXPECT_NEAR(found, width, 0.1);
  }
}

TEST_F(ContractTest, PlantedShiftsScalesAndTurnsAreFound) {
  makeContract();
  const base::Image light = calibration({"--samples", "16"});
  // The picture that lies so, from the one that lies right: the inverse placement puts it there.
  for (const external::Placement& planted :
       {external::Placement{.dx = 0.25, .dy = -0.5}, external::Placement{.dx = 1, .dy = 0.75},
        external::Placement{.scale = 1.004}, external::Placement{.rotationDeg = 0.4}}) {
    const double c = std::cos(-planted.rotationDeg * M_PI / 180) / planted.scale,
                 s = std::sin(-planted.rotationDeg * M_PI / 180) / planted.scale;
    const external::Placement inverse{.dx = -(c * planted.dx - s * planted.dy),
                                      .dy = -(s * planted.dx + c * planted.dy),
                                      .scale = 1 / planted.scale,
                                      .rotationDeg = -planted.rotationDeg};
    const std::vector<std::string> lines = calibrate(external::placedOnView(light, inverse));
    double dx = 9, dy = 9, scale = 0, turn = 9;
    ASSERT_EQ(std::sscanf(lines[0].c_str(), "place %lf pixels to the right, %lf down; scale %lf; turned by %lf", &dx,
                          &dy, &scale, &turn),
              4)
        << lines[0];
    EXPECT_NEAR(dx, planted.dx, 0.05);
    EXPECT_NEAR(dy, planted.dy, 0.05);
    EXPECT_NEAR(scale, planted.scale, 1e-3);
    EXPECT_NEAR(turn, planted.rotationDeg, 0.05);
  }
  const std::vector<std::string> mirrored = calibrate(external::placedOnView(light, {.mirrored = true}));
  EXPECT_TRUE(contains(mirrored.back(), "the picture is mirrored")) << mirrored.back();
}

TEST_F(ContractTest, ATurnedEnvironmentIsFound) {
  makeContract();
  for (const int degrees : {3, -90, 150}) {
    const std::vector<std::string> lines = calibrate(calibration({"--env-rotation", std::to_string(degrees)}));
    double yaw = 999;
    ASSERT_EQ(std::sscanf(lines[3].c_str(), "environment turned by %lf degrees", &yaw), 1) << lines[3];
    EXPECT_NEAR(yaw, degrees, 0.2) << lines[3];
  }
  base::Image map = base::readImage(path("contract/calibration.hdr"));
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width / 2; ++x)
      std::swap_ranges(map.at(x, y), map.at(x, y) + 3, map.at(map.width - 1 - x, y));
  base::writeImage(path("contract/calibration.hdr"), map);
  const std::vector<std::string> lines = calibrate(calibration());
  EXPECT_TRUE(contains(lines[3], "mirrored")) << lines[3];
}

TEST_F(ContractTest, AnotherPictureIsRefused) {
  base::writeImage8(path("calibration.png"), base::Image8(64, 64, 3, 90));
  expectRefused(runParity({"calibrate", path("calibration.png")}), 3,
                {"calibration.png", "0 of its 8 marks are found"});
  expectRefused(runParity({"calibrate", path("none.png")}), 4, {"none.png"});
}

TEST_F(ContractTest, IdsAreThoseOfTheMaterials) {
  render("builtin:materials", "highend", {"--ids", path("ids.exr")});
  const base::ImageFile ids = base::readImageFile(path("ids.exr"));
  const auto channel =
      static_cast<std::size_t>(std::ranges::find(ids.info.channelNames, "id") - ids.info.channelNames.begin());
  ASSERT_LT(channel, 3u);
  std::set<float> seen;
  for (std::size_t i = 0; i < ids.pixels.pixelCount(); ++i) seen.insert(ids.pixels.pixels[3 * i + channel]);
  EXPECT_GT(seen.size(), 4u);
}

} // namespace
} // namespace parity::tests
