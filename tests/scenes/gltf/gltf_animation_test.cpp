// Animated poses against closed forms, and which of several animations is shown.
#include <cmath>
#include <limits>

#include <glm/gtc/quaternion.hpp>

#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::Scene;

// Adds an animation of one channel; returns it.
json& animate(GltfFile& file, const std::string& path, const std::vector<float>& times,
              const std::vector<float>& values, const char* type, const char* interpolation, int node = 0) {
  const int input = file.add<float>(times, "SCALAR"), output = file.add<float>(values, type);
  file.json["animations"].push_back(
      {{"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}},
       {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}});
  return file.json["animations"].back();
}

Scene loadAt(const GltfFile& file, double timeSeconds, const std::string& animation = "") {
  const TempFolder folder;
  return scenes::loadScene(writeGlb(folder, file), {.timeSeconds = timeSeconds, .animation = animation});
}

glm::vec3 originAt(const GltfFile& file, double timeSeconds) {
  return glm::vec3(loadAt(file, timeSeconds).instances.at(0).toWorld[3]);
}

void expectNear(const glm::vec3& a, const glm::vec3& b, const std::string& what = "") {
  EXPECT_NEAR(glm::length(a - b), 0.f, 1e-5f) << what << ": " << a.x << " " << a.y << " " << a.z;
}

TEST(GltfAnimation, InterpolatesTranslationsLinearlyAndInStepsAndHoldsTheEnds) {
  GltfFile file = makeQuad();
  file.json["nodes"][0]["translation"] = {9, 9, 9};
  animate(file, "translation", {1, 2, 4}, {0, 0, 0, 4, 0, 0, 4, 2, 0}, "VEC3", "LINEAR");
  expectNear(originAt(file, 0), {0, 0, 0}, "before the first key");
  expectNear(originAt(file, 1.25), {1, 0, 0});
  expectNear(originAt(file, 2), {4, 0, 0});
  expectNear(originAt(file, 3.5), {4, 1.5f, 0});
  expectNear(originAt(file, 100), {4, 2, 0}, "behind the last key");
  expectNear(originAt(file, -100), {0, 0, 0});
  file.json["animations"][0]["samplers"][0]["interpolation"] = "STEP";
  expectNear(originAt(file, 1.99), {0, 0, 0});
  expectNear(originAt(file, 2), {4, 0, 0});
  expectNear(originAt(file, 3.99), {4, 0, 0});
}

TEST(GltfAnimation, SaysWhereATimeShowsNothingOfItsOwn) {
  GltfFile file = makeQuad();
  const auto only = [](const Scene& scene) {
    EXPECT_EQ(scene.warnings.size(), 1u);
    return scene.warnings.empty() ? std::string() : scene.warnings[0];
  };
  EXPECT_EQ(only(loadAt(file, 5)), "--time 5 has no effect: no animation moves a visible object");
  const json& animation = animate(file, "translation", {1, 2, 4.2f}, {0, 0, 0, 4, 0, 0, 4, 2, 0}, "VEC3", "LINEAR");
  EXPECT_EQ(only(loadAt(file, 5)), "--time 5 shows the last pose, because the last key is at 4.2 s");
  EXPECT_EQ(only(loadAt(file, -1)), "--time -1 shows the first pose, because animations begin at 0 s");
  for (const double time : {0.0, 0.5, 4.2}) EXPECT_TRUE(loadAt(file, time).warnings.empty()) << time;
  EXPECT_EQ(loadAt(file, 0).facts.animationSeconds, std::vector<double>{0}) << "it declares no max";
  const auto input = animation["samplers"][0]["input"].get<std::size_t>();
  file.json["accessors"][input]["max"] = {4.5};
  EXPECT_EQ(loadAt(file, 0).facts.animationSeconds, std::vector<double>{4.5});
}

// glTF 2.0, appendix C.5; x(t) = t^3 and y(t) = 5 - t^2 are such splines themselves, with their own slopes.
TEST(GltfAnimation, InterpolatesCubicSplinesByValuesAndSlopes) {
  GltfFile file = makeQuad();
  const auto x = [](float t) { return t * t * t; };
  const auto y = [](float t) { return 5 - t * t; };
  std::vector<float> values;
  for (const float t : {1.f, 3.f})
    values.insert(values.end(), {3 * t * t, -2 * t, 0, x(t), y(t), 7, 3 * t * t, -2 * t, 0});
  values[0] = 1e6f, values[15] = 1e6f; // the slope into the first key and out of the last one say nothing
  animate(file, "translation", {1, 3}, values, "VEC3", "CUBICSPLINE");
  for (const float t : {1.f, 1.5f, 2.f, 2.9f, 3.f}) expectNear(originAt(file, t), {x(t), y(t), 7}, std::to_string(t));
  expectNear(originAt(file, 0), {1, 4, 7});
  expectNear(originAt(file, 4), {27, -4, 7});
}

TEST(GltfAnimation, TurnsEvenlyTheShorterWayRound) {
  GltfFile file = makeQuad();
  const auto quaternion = [](float degrees, float sign) { // about +Z
    const float half = glm::radians(degrees) / 2;
    return std::vector<float>{0, 0, sign * std::sin(half), sign * std::cos(half)};
  };
  std::vector<float> values = quaternion(0, 1);
  const std::vector<float> end = quaternion(90, -1); // the same turn by the other quaternion
  values.insert(values.end(), end.begin(), end.end());
  animate(file, "rotation", {0, 1}, values, "VEC4", "LINEAR");
  for (const float t : {0.f, 0.2f, 0.5f, 0.75f, 1.f}) {
    const float angle = glm::radians(90.f * t);
    expectNear(glm::vec3(loadAt(file, t).instances[0].toWorld[0]), {std::cos(angle), std::sin(angle), 0});
  }
  // Normalised shorts: 32767 / 32767 is 1; and a spline's result is made unit length.
  const int shorts = file.add<std::int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0}, "VEC4", true);
  file.json["animations"][0]["samplers"][0]["output"] = shorts;
  expectNear(glm::vec3(loadAt(file, 0.5).instances[0].toWorld[0]), {0, 1, 0});
  std::vector<float> spline(24, 0.f);
  spline[7] = 3, spline[18] = 3; // keys (0,0,0,3) and (0,0,3,0), no slopes: halfway both have half
  file.json["animations"][0]["samplers"][0] = {{"input", file.json["animations"][0]["samplers"][0]["input"]},
                                               {"output", file.add<float>(spline, "VEC4")},
                                               {"interpolation", "CUBICSPLINE"}};
  expectNear(glm::vec3(loadAt(file, 0.5).instances[0].toWorld[0]), {0, 1, 0});
}

TEST(GltfAnimation, ScalesAndMorphs) {
  GltfFile file = makeQuad();
  animate(file, "scale", {0, 2}, {1, 1, 1, 3, 1, -1}, "VEC3", "LINEAR");
  EXPECT_EQ(loadAt(file, 0.5).instances[0].toWorld[0].x, 1.5f);
  EXPECT_EQ(loadAt(file, 1.5).instances[0].toWorld[2].z, -0.5f);

  file = makeQuad();
  const std::vector<float> up = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, right = {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0};
  file.primitive()["targets"] = {{{"POSITION", file.add<float>(up, "VEC3")}},
                                 {{"POSITION", file.add<float>(right, "VEC3")}}};
  file.json["nodes"][0]["weights"] = {9, 9};
  animate(file, "weights", {0, 1}, {1, 0, 0, 4}, "SCALAR", "LINEAR"); // both targets of a key in a row
  expectNear(loadAt(file, 0.25).meshes[0].positions[0], {1, 0, 0.75f});
}

TEST(GltfAnimation, PlaysAllThatDoNotContradictAnEarlierOneOrTheOneAskedFor) {
  GltfFile file = makeQuad();
  animate(file, "translation", {0}, {1, 0, 0}, "VEC3", "LINEAR")["name"] = "walk";
  animate(file, "translation", {0}, {5, 0, 0}, "VEC3", "LINEAR")["name"] = "run";
  animate(file, "scale", {0}, {2, 2, 2}, "VEC3", "LINEAR")["name"] = "grow";
  Scene scene = loadAt(file, 0);
  expectNear(glm::vec3(scene.instances[0].toWorld[3]), {1, 0, 0});
  EXPECT_EQ(scene.instances[0].toWorld[1].y, 2.f);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_TRUE(hasWarning(scene.warnings, "1 channels of later animations are ignored"));
  scene = loadAt(file, 0, "run");
  expectNear(glm::vec3(scene.instances[0].toWorld[3]), {5, 0, 0});
  EXPECT_EQ(scene.instances[0].toWorld[1].y, 1.f);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(loadAt(file, 0, "2").instances[0].toWorld[1].y, 2.f);
  expectError([&] { loadAt(file, 0, "swim"); },
              {"--animation", "has no animation 'swim'; known: 'walk' (0), 'run' (1), 'grow' (2)"},
              base::ExitCode::usage);
  scene = loadAt(file, 0, "none");
  expectNear(glm::vec3(scene.instances[0].toWorld[3]), {0, 0, 0});
  EXPECT_EQ(scene.instances[0].toWorld[1].y, 1.f);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_TRUE(hasWarning(loadAt(file, 2, "none").warnings, "no animation moves a visible object"));
  EXPECT_NO_THROW(loadAt(makeQuad(), 0, "none"));
  EXPECT_NO_THROW(scenes::loadScene("builtin:spheres", {.animation = "none"}));
  file.json["animations"][1]["name"] = "none"; // an animation of that name is played
  expectNear(glm::vec3(loadAt(file, 0, "none").instances[0].toWorld[3]), {5, 0, 0});
  expectError([&] { loadAt(makeQuad(), 0, "swim"); }, {"--animation", "has no animation"}, base::ExitCode::usage);
  for (const double time : {std::nan(""), std::numeric_limits<double>::infinity()})
    expectError([&] { loadAt(file, time); }, {"--time"}, base::ExitCode::usage);
}

TEST(GltfAnimation, MovesJointsAndTheNodesBelowThem) {
  GltfFile file = makeQuad();
  file.primitive()["attributes"]["JOINTS_0"] = file.add<std::uint8_t>(std::vector<std::uint8_t>(16, 0), "VEC4");
  std::vector<float> weights(16, 0.f);
  for (std::size_t i = 0; i < 16; i += 4) weights[i] = 1;
  file.primitive()["attributes"]["WEIGHTS_0"] = file.add<float>(weights, "VEC4");
  file.json["skins"] = {{{"joints", {2}}}};
  file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"children", {2}}}, json::object()};
  animate(file, "translation", {0, 1}, {0, 0, 0, 0, 6, 0}, "VEC3", "LINEAR", 1);
  expectNear(loadAt(file, 0.5).meshes[0].positions[0], {0, 3, 0}); // the joint's tree is not in the scene
}

TEST(GltfAnimation, ReadsOnlyWhatMovesSomethingShown) {
  GltfFile file = makeQuad();
  file.json["nodes"].push_back({{"name", "elsewhere"}});
  animate(file, "translation", {2, 1}, {0, 0, 0, 0, 0, 0}, "VEC3", "LINEAR", 1); // wrong, if someone asked
  EXPECT_EQ(loadAt(file, 0).instances.size(), 1u);
  file.json["animations"][0]["channels"][0]["target"].erase("node");
  EXPECT_EQ(loadAt(file, 0).instances.size(), 1u) << "a channel without a node is to be ignored";
}

TEST(GltfAnimation, RefusesWhatHasNoMeaning) {
  const auto refuse = [](const std::function<void(GltfFile&)>& edit, const std::vector<std::string>& parts) {
    GltfFile file = makeQuad();
    animate(file, "translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3", "LINEAR");
    edit(file);
    expectError([&] { loadAt(file, 0.5); }, parts);
  };
  const auto sampler = [](GltfFile& f) -> json& { return f.json["animations"][0]["samplers"][0]; };
  const float nan = std::nanf("");
  refuse(
      [&](GltfFile& f) {
        sampler(f)["input"] = f.add<float>({1, 1}, "SCALAR");
      },
      {"/animations/0/samplers/0/input (/accessors/6): key 1 is at 1 s, expected increasing times from 0"});
  refuse([&](GltfFile& f) { sampler(f)["input"] = f.add<float>({-1, 1}, "SCALAR"); }, {"key 0 is at -1 s"});
  refuse(
      [&](GltfFile& f) {
        sampler(f)["input"] = f.add<float>({0, nan}, "SCALAR");
      },
      {"input", "element 1 is not finite"});
  refuse(
      [&](GltfFile& f) {
        sampler(f)["output"] = f.add<float>({0, 0, 0, 0, nan, 0}, "VEC3");
      },
      {"output", "element 1 is not finite"});
  refuse(
      [&](GltfFile& f) {
        sampler(f)["input"] = f.add<float>({0, 1, 2}, "SCALAR");
      },
      {"/animations/0/samplers/0/output (/accessors/5): has 2 elements, expected 3, 1 for each of 3 keys"});
  refuse([&](GltfFile& f) { sampler(f)["interpolation"] = "CUBICSPLINE"; }, {"has 2 elements, expected 6"});
  refuse([&](GltfFile& f) { sampler(f)["interpolation"] = "QUADRATIC"; }, {"/animations/0/samplers/0/interpolation"});
  refuse(
      [&](GltfFile& f) {
        sampler(f)["output"] = f.add<float>({0, 0, 0, 1, 0, 0, 0, 1}, "VEC4");
      },
      {"has 4 components, expected 3"});
  refuse(
      [&](GltfFile& f) {
        sampler(f)["input"] = f.add<std::uint16_t>({0, 1}, "SCALAR");
      },
      {"expected SCALAR of FLOAT"});
  refuse([&](GltfFile& f) { f.json["animations"][0]["channels"][0]["sampler"] = 1; },
         {"/animations/0/channels/0/sampler: is 1, expected an index of the animation's 1 samplers"});
  refuse([&](GltfFile& f) { f.json["animations"][0]["channels"].push_back(f.json["animations"][0]["channels"][0]); },
         {"/animations/0/channels/1: animates the translation of /nodes/0, as an earlier channel does"});
  refuse([&](GltfFile& f) { f.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
         {"/nodes/0/matrix: is on an animated node"});
  refuse([&](GltfFile& f) { f.json["animations"][0]["channels"][0]["target"]["path"] = "weights"; },
         {"a node whose mesh has no morph targets"});
  refuse(
      [&](GltfFile& f) {
        f.json["animations"][0]["channels"][0]["target"]["path"] = "rotation";
        sampler(f)["output"] = f.add<float>({0, 0, 0, 0, 0, 0, 0, 1}, "VEC4");
      },
      {"/animations/0/samplers/0: is a rotation of length 0"});
}

} // namespace
} // namespace parity::tests
