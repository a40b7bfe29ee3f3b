// The suite file: what it says, and what it must not say.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/expect_error.h"
#include "base/file.h"
#include "base/temp_folder.h"
#include "job/knobs.h"
#include "mobile/options.h"

namespace parity::job {
namespace {

using base::expectError;
using base::TempFolder;
using scenes::Suite;

Suite load(const std::string& text) {
  const TempFolder folder;
  base::writeText(folder / "suite.toml", text);
  return scenes::loadSuite(folder / "suite.toml", suiteKnobs());
}

std::vector<SceneRequest> requests(const std::string& text, const base::GivenKnobs& commandLine = {}) {
  return requestsOf(load(text), {}, commandLine);
}

void expectRefused(const std::string& text, std::vector<std::string> parts) {
  parts.push_back("suite.toml: ");
  expectError([&] { load(text); }, parts);
}

TEST(Suite, ReadsEveryKey) {
  const TempFolder folder;
  base::writeText(folder / "suite.toml", std::string(R"(
name = "all"
budgets = "strict.toml"
[[scene]]
name = "bottle"
file = "models/../WaterBottle.gltf"
time = 1.5
animation = "turn"
scene = "day"
variant = "red"
subject = "ball"
environment = "env/studio.hdr"
environment_rotation = 90
sun = [30, 50.5, 4]
fully_rough = ["rubber*", "floor"]
budgets = "bottle.toml"
exposure = -1.5
sun_extraction = false
falloff = "ue4"
sky_light_color = [1, 0.5, 2]
indirect_lighting_color_scale = [3, 2, 1]
directional_specular_scale = 0.25
baked = "light/../bottle"
captures = [[1, 2, 3], [-0.5, 0, 1e6]]
[scene.fog]
density = 0.02
height_falloff = 0.1
height = -3
color = [0.5, 0.6, 0.7]
start_distance = 8
max_opacity = 0.9
[[scene.view]]
name = "front"
orbit = [0, 90, 0]
target = [1, 2, 3]
fov = 30
[[scene.view]]
camera = "hero"
[[scene]]
file = "builtin:spheres"
)"));
  const Suite suite = scenes::loadSuite(folder / "suite.toml", suiteKnobs());
  EXPECT_EQ(suite.name, "all");
  EXPECT_EQ(suite.budgets, (folder / "strict.toml").string());
  const std::vector<SceneRequest> all = requestsOf(suite, {}, {});
  ASSERT_EQ(all.size(), 2u);
  const scenes::SceneSettings &bottle = all[0].settings.scene, &spheres = all[1].settings.scene;
  EXPECT_EQ(bottle.load,
            (scenes::LoadOptions{.timeSeconds = 1.5, .animation = "turn", .scene = "day", .variant = "red"}));
  EXPECT_EQ(bottle.subject, scenes::Subject::ball);
  EXPECT_EQ(spheres.load, scenes::LoadOptions{});
  EXPECT_EQ(spheres.subject, scenes::Subject::scene);
  EXPECT_EQ(all[0].name, "bottle");
  EXPECT_EQ(all[0].scene, (folder / "WaterBottle.gltf").string()) << "beside the suite";
  EXPECT_EQ(bottle.environment, (folder / "env/studio.hdr").string());
  EXPECT_EQ(bottle.environmentRotationDeg, 90.f);
  EXPECT_EQ(
      bottle.lightScales,
      (scenes::LightScales{.skyLightColor = {1, 0.5f, 2}, .indirectColorScale = {3, 2, 1}, .sunSpecularScale = 0.25f}));
  EXPECT_EQ(bottle.falloff, scenes::Falloff::ue4);
  EXPECT_EQ(spheres.falloff, scenes::Falloff::khr);
  EXPECT_EQ(bottle.fog, (scenes::Fog{.density = 0.02f,
                                     .heightFalloff = 0.1f,
                                     .height = -3,
                                     .color = {0.5f, 0.6f, 0.7f},
                                     .startDistance = 8,
                                     .maxOpacity = 0.9f}));
  ASSERT_TRUE(bottle.sun);
  EXPECT_EQ(bottle.sun->elevationDeg, 50.5f);
  EXPECT_EQ(bottle.sun->lux, 4.f);
  EXPECT_EQ(bottle.fullyRough, (std::vector<std::string>{"rubber*", "floor"}));
  EXPECT_EQ(all[0].budgets, (folder / "bottle.toml").string());
  EXPECT_EQ(all[0].settings.exposureEv, -1.5f);
  EXPECT_FALSE(bottle.extractSun);
  EXPECT_EQ(bottle.baked, (folder / "bottle").string());
  EXPECT_EQ(all[0].captures, (std::vector<glm::vec3>{{1, 2, 3}, {-0.5f, 0, 1e6f}}));
  ASSERT_EQ(all[0].views.size(), 2u);
  EXPECT_EQ(all[0].views[0].name, "front");
  EXPECT_EQ(all[0].views[0].orbit, glm::vec3(0, 90, 0));
  EXPECT_EQ(all[0].views[0].target, glm::vec3(1, 2, 3));
  EXPECT_EQ(all[0].views[0].fovYDeg, 30.f);
  EXPECT_EQ(all[0].views[1].name, "hero");
  EXPECT_EQ(all[0].views[1].camera, "hero");
  EXPECT_EQ(all[1].name, "spheres");
  EXPECT_EQ(all[1].scene, "builtin:spheres");
  EXPECT_EQ(spheres.environment, "");
  EXPECT_TRUE(spheres.extractSun);
  EXPECT_EQ(spheres.baked, "");
  EXPECT_TRUE(all[1].captures.empty());
  EXPECT_FALSE(spheres.sun || all[1].budgets);
  EXPECT_EQ(all[1].settings.exposureEv, 0);
  ASSERT_EQ(all[1].views.size(), 1u) << "one automatic view";
  EXPECT_EQ(all[1].views[0].name, "auto");
  EXPECT_EQ(spheres.lightScales, scenes::LightScales());
  EXPECT_EQ(spheres.fog, scenes::Fog());
}

// What a scene says goes before the command line, the command line before [defaults].
TEST(Suite, TheMostParticularWordHolds) {
  const std::string text = R"(
[defaults]
exposure = 1
mobile_textures = "astc4x4"
precision = "fp32"
fully_rough = ["a"]
[[scene]]
file = "builtin:spheres"
exposure = 3
[[scene]]
file = "builtin:lights"
fully_rough = ["b"]
)";
  const std::vector<SceneRequest> all =
      requests(text, {{"exposure", {{"2"}, "--exposure"}}, {"precision", {{"fp16"}, "--precision"}}});
  EXPECT_EQ(all[0].settings.exposureEv, 3);
  EXPECT_EQ(all[1].settings.exposureEv, 2);
  for (const SceneRequest& request : all) {
    EXPECT_EQ(request.settings.of<mobile::Options>().textures, base::TextureBlock::astc4x4);
    EXPECT_EQ(request.settings.of<mobile::Options>().precision, mobile::Precision::fp16);
  }
  EXPECT_EQ(all[0].settings.scene.fullyRough, std::vector<std::string>{"a"});
  EXPECT_EQ(all[1].settings.scene.fullyRough, std::vector<std::string>{"b"});
}

// A preset sets most of the mobile path's knobs, wherever it is named; what is given besides holds.
TEST(Suite, APresetDoesNotUndoWhatIsGivenBesides) {
  const std::vector<SceneRequest> all =
      requests("[[scene]]\nfile = \"builtin:spheres\"\nmobile_preset = \"refit\"\n", {{"sky-sh", {{"4"}, "--sky-sh"}}});
  EXPECT_EQ(all[0].settings.of<mobile::Options>().preset, "refit");
  EXPECT_EQ(all[0].settings.of<mobile::Options>().directLobe, mobile::DirectLobe::refit);
  EXPECT_EQ(all[0].settings.of<mobile::Options>().sky, mobile::SkyForm::sh4);
}

// Every knob that a suite may hold, by its key and each of its older names.
TEST(Suite, EachKnobIsAKeyOfAScene) {
  for (const base::Knob& knob : suiteKnobs().knobs) {
    std::vector<std::string> names = {knob.id};
    names.insert(names.end(), knob.aliases.begin(), knob.aliases.end());
    for (const std::string& name : names) {
      std::string value;
      switch (knob.type) {
      case base::KnobType::flag:
        value = "true";
        break;
      case base::KnobType::number:
      case base::KnobType::whole:
        value = fmt::format("{}", knob.most);
        break;
      case base::KnobType::numbers:
        value = "[1, 1, 1]";
        break;
      case base::KnobType::choice:
        value = "\"" + knob.choices.front() + "\"";
        break;
      case base::KnobType::texts:
        value = "[\"x\"]";
        break;
      case base::KnobType::file:
        value = "\"builtin:x\"";
        break;
      case base::KnobType::text:
        value = knob.id == "error" ? "\"1%\"" : "\"1\"";
        break;
      }
      const Suite suite = load("[[scene]]\nfile = \"builtin:x\"\n" + base::keyOf(name) + " = " + value + "\n");
      EXPECT_EQ(suite.entries[0].given.count(knob.id), 1u) << name;
      EXPECT_EQ(suite.entries[0].given.size(), 1u) << name;
    }
  }
}

// Beside a suite a value alone need not make sense: a scene may say what makes it go together.
TEST(Suite, WhatTheCommandLineSaysIsHeldAgainstEachScene) {
  const base::GivenKnobs lobe = {{"direct-lobe", {{"refit"}, "--direct-lobe"}}};
  const std::string refit = "[[scene]]\nfile = \"builtin:spheres\"\nmobile_preset = \"refit\"\n";
  EXPECT_EQ(requests(refit, lobe).at(0).settings.of<mobile::Options>().directLobe, mobile::DirectLobe::refit);
  EXPECT_EQ(defaultsOf(load(refit).given, {}, lobe).of<mobile::Options>().directLobe, mobile::DirectLobe::refit);
  expectError([&] { requests(refit + "[[scene]]\nfile = \"builtin:lamps\"\n", lobe); },
              {"scene 'lamps': --direct-lobe: 'refit' cannot be combined with the preset ue4-2020"});
}

TEST(Suite, WhatDoesNotGoTogetherNamesItsPlace) {
  const std::string head = "[[scene]]\nfile = \"builtin:spheres\"\n";
  expectError([&] { requests(head + "mobile_spot_fade = 0.5\n"); },
              {"scene 'spheres': ", "line 3: mobile_spot_fade: has no effect without mobile-spot-shadow"});
  expectError([&] { requests(head + "mixing_begin = 0.5\n"); },
              {"scene 'spheres': --mixing-begin: 0.5 is not below --mixing-end"});
  expectRefused(head + "env = \"a.hdr\"\nenvironment = \"b.hdr\"\n", {"environment: has the same meaning as 'env'"});
  expectRefused(head + "size = \"64x64\"\n", {"line 3: size: unknown key in a scene"});
}

TEST(Suite, ShippedSuitesLoad) {
  const std::filesystem::path data = std::filesystem::path(PARITY_SOURCE_DIR) / "scenes/data";
  for (const auto& [file, name, count] : {std::tuple("nightly.example.toml", "nightly", 4u),
                                          {"evidence.toml", "evidence", 12u},
                                          {"demo.toml", "demo", 6u}}) {
    const Suite suite = scenes::loadSuite(data / file, suiteKnobs());
    EXPECT_EQ(suite.name, name);
    EXPECT_EQ(requestsOf(suite, {}, {}).size(), count) << file;
    for (const scenes::SuiteEntry& entry : suite.entries) EXPECT_TRUE(entry.scene.starts_with("builtin:"));
  }
}

TEST(Suite, UnknownKeysNameTheLineAndTheNearestKnownKey) {
  expectRefused("nmae = \"x\"\n[[scene]]\nfile = \"builtin:spheres\"\n", {"line 1: nmae", "did you mean 'name'?"});
  expectRefused("[[scene]]\nfile = \"builtin:spheres\"\nenviroment = \"x.hdr\"\n",
                {"line 3: enviroment: unknown key in a scene; did you mean 'environment'?"});
  expectRefused("[[scene]]\nfile = \"builtin:spheres\"\n[[scene.view]]\nfovy = 3\n",
                {"line 4: fovy: unknown key in a view; did you mean 'fov'?"});
}

TEST(Suite, SyntaxErrorsNameLineAndColumn) {
  expectRefused("[[scene]]\nfile = \n", {"line 2, column"});
  expectRefused("a = [1, 2\n", {"line"});
}

TEST(Suite, WrongTypesAndRangesNameTheLine) {
  const std::string head = "[[scene]]\nfile = \"builtin:spheres\"\n";
  expectRefused(head + "sun = [1, 2]\n", {"line 3: sun: is not a list of 3 numbers"});
  expectRefused(head + "sun = [1, 95, 2]\n", {"line 3: sun", "ELEVATION"});
  expectRefused(head + "sun = [1, nan, 2]\n", {"line 3: sun"});
  expectRefused(head + "exposure = \"bright\"\n", {"line 3: exposure: is not a number"});
  expectRefused(head + "exposure = inf\n", {"line 3: exposure", "is not a number from -32 to 32"});
  expectRefused(head + "fully_rough = \"x\"\n", {"line 3: fully_rough: is not a list of strings"});
  expectRefused(head + "fully_rough = [1]\n", {"line 3: fully_rough"});
  expectRefused(head + "sun_extraction = 0\n", {"line 3: sun_extraction: is not true or false"});
  expectRefused(head + "name = 3\n", {"line 3: name: is not a string"});
  expectRefused(head + "sky_light_color = [1, -1, 1]\n", {"line 3: sky_light_color", "from 0 to 1000"});
  expectRefused(head + "indirect_lighting_color_scale = 2\n", {"line 3: indirect_lighting_color_scale", "3 numbers"});
  expectRefused(head + "directional_specular_scale = -1\n", {"line 3: directional_specular_scale"});
  expectRefused(head + "baked = true\n", {"line 3: baked: is not a string"});
  expectRefused(head + "captures = 3\n", {"line 3: captures: is not a list of at most 8 places"});
  expectRefused(head + "captures = [1, 2, 3]\n", {"line 3: captures: is not a list of places [x, y, z]"});
  expectRefused(head + "captures = [[1, 2]]\n", {"line 3: captures: is not a list of places [x, y, z]"});
  expectRefused(head + "captures = [\n[1, 2, 3],\n[1, 2, \"x\"]]\n", {"line 5: captures: is not a number"});
  expectRefused(head + "captures = [[1, 2, 1e7]]\n", {"line 3: captures", "not from"});
  expectRefused(head + "captures = [[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0]]\n",
                {"line 3: captures: is not a list of at most 8 places"});
  expectRefused(head + "falloff = \"ue5\"\n", {"line 3: falloff: 'ue5' is unknown; did you mean 'ue4'?"});
  expectRefused(head + "falloff = 2\n", {"line 3: falloff: '2' is unknown; known: khr, ue4"});
  expectRefused(head + "fog = 3\n", {"line 3: fog: is not a table", "[scene.fog]"});
  expectRefused(head + "[scene.fog]\nheight = 1\n", {"density: is missing"});
  expectRefused(head + "[scene.fog]\ndensity = -1\n", {"line 4: density", "from 0 to 1000"});
  expectRefused(head + "[scene.fog]\ndensity = 1\nfalloff = 1\n", {"line 5: falloff", "unknown key in a fog"});
  expectRefused(head + "[scene.fog]\ndensity = 1\nmax_opacity = 1.5\n", {"line 5: max_opacity"});
  expectRefused(head + "[[scene.view]]\norbit = [0, 200, 1]\n", {"line 4: orbit", "PHI"});
  expectRefused(head + "[[scene.view]]\nfov = 0\n", {"line 4: fov"});
  expectRefused(head + "[[scene.view]]\ncamera = \"a\"\norbit = [0, 90, 1]\n",
                {"line 4: camera", "cannot be combined"});
  expectRefused("scene = 3\n", {"line 1: scene", "[[scene]]"});
  expectRefused("[[scene]]\nname = \"x\"\n", {"file: is missing"});
  expectRefused("[[scene]]\nfile = \"\"\n", {"line 2: file: is an empty string"});
}

TEST(Suite, NamesMustDifferAndSomethingMustBeListed) {
  expectRefused("", {"has no scene"});
  expectRefused("[[scene]]\nfile = \"a/x.glb\"\n[[scene]]\nfile = \"b/x.glb\"\n",
                {"line 3", "two scenes have the name 'x'"});
  expectRefused("[[scene]]\nfile = \"x.glb\"\n[[scene.view]]\n[[scene.view]]\n", {"line 4", "have the name 'auto'"});
  expectError([] { scenes::loadSuite("none.toml", suiteKnobs()); }, {"none.toml"});
}

} // namespace
} // namespace parity::job
