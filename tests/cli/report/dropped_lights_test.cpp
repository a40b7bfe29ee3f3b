// The lights that mobile drops: named, and measured as two pictures of the high-end path, with and without, differ.
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "cli/checks.h"

namespace parity::tests {
namespace {

using Json = nlohmann::json;

// Eight lamps and a moon over eight materials, each an object of its own.
constexpr const char* kLamps = "builtin:lamps";

// The quad fills the picture.
const std::vector<std::string> kCloseUp = {"--orbit", "0,90,0.4", "--background", "0,0,0"};

// Candela of six lamps that do not burn the picture out: the last two are dropped.
const std::vector<double> kDim = {0.1, 0.12, 0.14, 0.16, 0.02, 0.06};

// The quad once more behind itself, in another material, and in front of it a small one that is unlit.
void addHiddenAndUnlit(GltfFile& file) {
  file.json["extensionsUsed"] = {"KHR_materials_unlit"};
  file.json["materials"].push_back({{"name", "hidden"}});
  file.json["materials"].push_back({{"name", "sign"}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
  const double sizes[] = {1, 0.1}, places[] = {-0.01, 0.01};
  for (int i = 0; i < 2; ++i) {
    file.json["meshes"].push_back(file.json["meshes"][0]);
    file.json["meshes"].back()["primitives"][0]["material"] = i + 1;
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back({{"mesh", i + 1},
                                  {"scale", {sizes[i], sizes[i], 1}},
                                  {"translation", {0.5 - sizes[i] / 2, 0.5 - sizes[i] / 2, places[i]}}});
  }
}

class DroppedLightsTest : public RenderingTest {
protected:
  // The only scene of a run that writes JSON to stdout.
  static Json diff(const std::string& scene, const std::vector<std::string>& options,
                   const std::vector<std::string>& size = kSmall) {
    const RunResult result = runParity(join({{"diff", scene, "--json", "-", "--attribution", "none"}, size, options}));
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.err;
    return Json::parse(result.out)["scenes"][0];
  }
  static Json dropped(const Json& scene) { return scene["views"][0].value("droppedLights", Json()); }
  static std::uint64_t countOf(const Json& scene, const std::string& pass) {
    for (const Json& each : scene["passes"])
      if (each["name"] == pass) return each["count"];
    ADD_FAILURE() << "no pass " << pass;
    return 0;
  }
  static std::string whyNone(const Json& scene) {
    for (const Json& each : scene["passes"])
      if (each["name"] == "dropped lights") return each["skipped"].is_null() ? "" : each["skipped"];
    return "no such pass";
  }
  static std::vector<std::string> namesOf(const Json& lights) {
    std::vector<std::string> names;
    for (const Json& each : lights) names.push_back(each.is_string() ? each : each["name"]);
    return names;
  }

  // A quad under point lights of these candela, side by side above it, and two suns where asked; the lights of
  // `without` are left out, all others keep their names.
  std::string writeLights(const std::vector<double>& candela, bool suns, const std::set<std::size_t>& without = {},
                          const std::function<void(GltfFile&)>& edit = {}) {
    GltfFile file = makeQuad();
    if (edit) edit(file);
    file.json["extensionsUsed"].push_back("KHR_lights_punctual");
    Json& lights = file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array();
    const auto add = [&](Json light, Json node) {
      node["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
      if (!without.contains(lights.size())) file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
      file.json["nodes"].push_back(node);
      lights.push_back(std::move(light));
    };
    for (std::size_t i = 0; i < candela.size(); ++i)
      add({{"type", "point"}, {"name", "lamp"}, {"intensity", candela[i]}, {"color", {1, 0.6, 0.1 * (i % 8)}}},
          {{"translation", {0.2 * static_cast<double>(i), 0.5, 0.4}}});
    if (suns) {
      add({{"type", "directional"}, {"intensity", 0.2}}, Json::object());
      add({{"type", "directional"}, {"intensity", 0.1}, {"name", "moon"}}, Json::object());
    }
    return writeEmbedded(m_folder, std::move(file), "lights" + std::to_string(m_files++));
  }

  // Mean FLIP of two pictures of `parity render` by `parity flip`.
  double flipOfRenders(const std::string& reference, const std::string& test,
                       const std::vector<std::string>& size = kSmall) const {
    std::vector<std::string> files;
    for (const std::string& scene : {reference, test}) {
      files.push_back((m_folder / ("picture" + std::to_string(files.size()) + ".png")).string());
      EXPECT_TRUE(
          exitedWith(0, runParity(join({{"render", scene, "--path", "highend", "-o", files.back()}, size, kCloseUp}))));
    }
    const RunResult result = runParity({"flip", files[0], files[1], "--json", "-"});
    const Json flip = Json::parse(result.out);
    return flip["pairs"][0]["regions"][0]["figures"]["metrics"]["flip.mean"];
  }

private:
  int m_files = 0;
};

TEST_F(DroppedLightsTest, AreNamedWithTheObjectsThatKeepAndDropThemAndTheirMaterials) {
  const Json scene = diff(kLamps, {});
  const Json found = dropped(scene);
  ASSERT_TRUE(found.is_object()) << scene["views"][0].dump(1);
  EXPECT_EQ(found["lights"], 9) << "the moon is one";
  EXPECT_EQ(found["notMeasured"].size(), 0u);
  EXPECT_EQ(countOf(scene, "dropped lights"), found["measured"].size());
  ASSERT_GT(found["measured"].size(), 3u);
  std::set<std::string> names, materials;
  for (const Json& material : scene["views"][0]["materials"]) materials.insert(material["name"]);
  double before = 1;
  for (const Json& light : found["measured"]) {
    EXPECT_TRUE(names.insert(light["name"]).second) << light["name"];
    EXPECT_NE(light["name"], "moon") << "mobile has one sun, and this is it";
    EXPECT_TRUE(light["kind"] == "point" || light["kind"] == "spot") << light;
    EXPECT_LE(light["keptBy"].get<int>() + light["droppedBy"].get<int>(), 8) << light;
    EXPECT_EQ(light["materials"].size(), light["droppedBy"]) << "each object has a material of its own: " << light;
    const double flip = light["materials"][0]["flip"];
    EXPECT_LE(flip, before) << "ranked by what they do";
    before = flip;
    for (const Json& effect : light["materials"]) {
      EXPECT_TRUE(materials.contains(effect["name"])) << effect;
      EXPECT_LE(effect["flip"], flip) << light;
    }
  }
  EXPECT_GT(found["measured"][0]["materials"][0]["flip"], 0.02);
  // As many as the floor can lack: of the eight lamps that reach it, it has four.
  int ofFloor = 0;
  for (const Json& light : found["measured"])
    for (const Json& effect : light["materials"]) ofFloor += effect["name"] == "floor" ? 1 : 0;
  EXPECT_GT(ofFloor, 0);
  EXPECT_LE(ofFloor, 4);
}

// The truth: the scene without the light, rendered and compared by the commands that know nothing of dropped lights.
TEST_F(DroppedLightsTest, FlipIsThatOfTwoRendersWithAndWithoutTheLight) {
  const std::vector<double> candela = {0.1, 0.02, 0.12, 0.14, 0.05, 0.2};
  const std::string all = writeLights(candela, true);
  const Json found = dropped(diff(all, kCloseUp));
  ASSERT_EQ(namesOf(found["measured"]).size(), 3u) << found.dump(1);
  const std::map<std::string, std::size_t> places = {{"lamp (2)", 1}, {"lamp (5)", 4}, {"moon", 7}};
  for (const Json& light : found["measured"]) {
    ASSERT_TRUE(places.contains(light["name"])) << light;
    ASSERT_EQ(light["materials"].size(), 1u);
    EXPECT_EQ(light["materials"][0]["name"], "paint");
    EXPECT_EQ(light["droppedBy"], 1);
    EXPECT_EQ(light["keptBy"], 0);
    const double truth = flipOfRenders(all, writeLights(candela, true, {places.at(light["name"])}));
    EXPECT_GT(truth, 0.002) << light["name"];
    // The pictures' bytes are the same; the means are summed otherwise (observed: 1e-7).
    EXPECT_NEAR(light["materials"][0]["flip"].get<double>(), truth, 1e-6) << light["name"];
  }
}

TEST_F(DroppedLightsTest, ALimitMeasuresTheBrightestAndNamesTheOthersAndZeroLooksAtNone) {
  const std::string scene = writeLights({0.1, 0.12, 0.14, 0.16, 0.02, 0.01, 0.06, 0.03}, false);
  const Json two = diff(scene, join({kCloseUp, {"--dropped-lights", "2"}}));
  const std::vector<std::string> brightest = {"lamp (7)", "lamp (8)"}, others = {"lamp (5)", "lamp (6)"};
  std::vector<std::string> measured = namesOf(dropped(two)["measured"]);
  std::ranges::sort(measured);
  EXPECT_GT(dropped(two)["measured"][1]["materials"][0]["flip"], 0.001);
  EXPECT_EQ(measured, brightest);
  EXPECT_EQ(namesOf(dropped(two)["notMeasured"]), others);
  EXPECT_EQ(countOf(two, "dropped lights"), 2u);
  EXPECT_EQ(countOf(two, "shade highend"), 3 * countOf(two, "surface")) << "the surface is kept";

  const Json none = diff(scene, join({kCloseUp, {"--dropped-lights", "0"}}));
  EXPECT_TRUE(dropped(none).is_null());
  EXPECT_EQ(whyNone(none), "not requested");
  EXPECT_EQ(countOf(none, "shade highend"), countOf(none, "surface"));
  Json with = two["views"][0], without = none["views"][0];
  with.erase("droppedLights");
  EXPECT_EQ(with, without) << "all other figures are the same";

  // Surfaces of a picture in several parts are made again.
  const Json sampled = diff(scene, join({kCloseUp, {"--dropped-lights", "2", "--samples", "2"}}));
  EXPECT_EQ(countOf(sampled, "shade highend"), countOf(sampled, "surface"));
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(dropped(sampled)["measured"][i]["materials"][0]["flip"].get<double>(),
                dropped(two)["measured"][i]["materials"][0]["flip"].get<double>(), 0.01);
}

// Of a large picture each light is shaded once for eight pictures; of one light alone, by the shaders that are there.
TEST_F(DroppedLightsTest, ManyLightsAreMeasuredAtOnceWithTheSameFigures) {
  const std::vector<double> candela = {0.1,   0.12,  0.14,  0.16,  0.02,  0.019, 0.018,
                                       0.017, 0.016, 0.015, 0.014, 0.013, 0.012, 0.011};
  const std::string all = writeLights(candela, false);
  const std::vector<std::string> large = {"--size", "512x512", "--validation"};
  const Json many = diff(all, join({kCloseUp, {"--dropped-lights", "10"}}), large),
             one = diff(all, join({kCloseUp, {"--dropped-lights", "1"}}), large);
  const Json lights = dropped(many)["measured"];
  ASSERT_EQ(lights.size(), 10u);
  EXPECT_EQ(countOf(many, "dropped lights"), 10u);
  EXPECT_EQ(countOf(many, "shade highend"), 3 * countOf(many, "surface")) << "eight at once, then two";
  EXPECT_EQ(countOf(one, "shade highend"), 2 * countOf(one, "surface"));
  std::map<std::string, double> effects;
  for (const Json& light : lights) effects[light["name"]] = light["materials"][0]["flip"];
  const Json alone = dropped(one)["measured"][0];
  EXPECT_NEAR(effects.at(alone["name"]), alone["materials"][0]["flip"].get<double>(), 1e-7) << alone;
  // The last one of the first eight and the two after it, by the commands that know nothing of dropped lights.
  for (const std::size_t i : {11u, 12u, 13u}) {
    const double truth = flipOfRenders(all, writeLights(candela, false, {i}), large);
    EXPECT_GT(truth, 1e-4);
    EXPECT_NEAR(effects.at("lamp (" + std::to_string(i + 1) + ")"), truth, 1e-6) << i;
  }
  // Surfaces of several samples are made again: once for all eight pictures.
  const Json sampled = diff(all, join({kCloseUp, {"--samples", "2"}}), large);
  EXPECT_EQ(countOf(sampled, "surface"), 4 * countOf(many, "surface"));
  for (const Json& light : dropped(sampled)["measured"])
    EXPECT_NEAR(light["materials"][0]["flip"].get<double>(), effects.at(light["name"]), 0.01) << light;
}

// Where a view keeps its terms, pictures at once hold the light of lights alone, and the other terms are added.
TEST_F(DroppedLightsTest, KeptTermsGiveTheSameFigures) {
  const std::vector<std::string> large = {"--size", "640x640"};
  const auto report = [&](const std::string& attribution) {
    const std::filesystem::path folder = m_folder / attribution;
    const RunResult result = runParity(join(
        {{"report", kLamps, "-o", folder.string(), "--attribution", attribution, "--pictures", "none", "--no-cache"},
         large}));
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.err;
    const std::string info = readWholeFile(folder / "run.json");
    return std::pair(Json::parse(readWholeFile(folder / "report.json"))["scenes"][0],
                     contains(info, "add terms of no light"));
  };
  const auto [whole, addsToWhole] = report("none");
  const auto [kept, addsToKept] = report("over-budget");
  EXPECT_FALSE(addsToWhole);
  EXPECT_TRUE(addsToKept);
  ASSERT_GT(dropped(whole)["measured"].size(), 3u);
  EXPECT_EQ(countOf(whole, "shade highend"), 2 * countOf(whole, "surface")) << "all at once";
  EXPECT_EQ(countOf(kept, "shade highend"), 2 * countOf(kept, "surface"));
  EXPECT_EQ(dropped(kept), dropped(whole));
}

TEST_F(DroppedLightsTest, NothingIsDoneWhereMobileHasAllLights) {
  for (const std::string& scene : {writeLights({1, 2, 3, 4}, false), std::string("builtin:materials")}) {
    const Json result = diff(scene, kSun);
    EXPECT_TRUE(dropped(result).is_null()) << scene;
    EXPECT_EQ(whyNone(result), "no light of a visible object is dropped") << scene;
    EXPECT_EQ(countOf(result, "shade highend"), countOf(result, "surface"));
  }
  // Baked, all of them are.
  const Json baked = dropped(diff(writeLights({1, 2, 3, 4}, false), join({kSun, {"--mobile-preset", "karis2014"}})));
  EXPECT_EQ(baked["measured"].size(), 4u) << baked;
  EXPECT_EQ(baked["lights"], 5);
}

// An object that another hides, one of an unlit material and one that the report is not about lack no light.
TEST_F(DroppedLightsTest, OnlyLitObjectsThatAreSeenAndReportedCount) {
  const Json one = dropped(diff(kLamps, {"--material", "white ball"}));
  ASSERT_TRUE(one.is_object());
  for (const Json& light : one["measured"]) {
    EXPECT_EQ(light["droppedBy"], 1) << light;
    EXPECT_EQ(light["keptBy"], 0) << light;
    ASSERT_EQ(light["materials"].size(), 1u) << light;
    EXPECT_EQ(light["materials"][0]["name"], "white ball");
  }

  const Json found = dropped(diff(writeLights(kDim, false, {}, addHiddenAndUnlit), kCloseUp));
  ASSERT_EQ(found["measured"].size(), 2u);
  for (const Json& light : found["measured"]) {
    EXPECT_EQ(light["droppedBy"], 1) << light;
    ASSERT_EQ(light["materials"].size(), 1u) << light;
    EXPECT_EQ(light["materials"][0]["name"], "paint");
  }
}

TEST_F(DroppedLightsTest, TheTableSaysItInALine) {
  const std::string scene = writeLights(kDim, false);
  const RunResult result =
      runParity(join({{"diff", scene, "--attribution", "none", "--dropped-lights", "1"}, kSmall, kCloseUp}));
  EXPECT_TRUE(contains(result.out, "\n  mobile drops 2 of 6 lights; without 'lamp (6)' the high-end picture of 'paint' "
                                   "changes by FLIP 0."))
      << result.out;
  EXPECT_TRUE(contains(result.out, "; 1 more was not measured (--dropped-lights)\n")) << result.out;
}

TEST_F(DroppedLightsTest, TheCacheGivesTheSameAndKnowsTheLimit) {
  const std::string scene = writeLights(kDim, false);
  const auto run = [&](const std::string& limit) {
    const std::filesystem::path folder = m_folder / "out";
    const RunResult result = runParity(join({{"report", scene, "-o", folder.string(), "--size", "64x64", "--cache",
                                              path("cache"), "--dropped-lights", limit},
                                             kCloseUp}));
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.err;
    const Json info = Json::parse(readWholeFile(folder / "run.json"));
    return std::pair(readWholeFile(folder / "report.json"), info["cachedScenes"].size());
  };
  const auto first = run("8"), again = run("8");
  EXPECT_EQ(first.second, 0u);
  EXPECT_EQ(again, std::pair(first.first, std::size_t{1}));
  EXPECT_EQ(dropped(Json::parse(again.first)["scenes"][0])["measured"].size(), 2u);
  const auto fewer = run("1");
  EXPECT_EQ(fewer.second, 0u) << "it is another result";
  EXPECT_EQ(dropped(Json::parse(fewer.first)["scenes"][0])["measured"].size(), 1u);
}

} // namespace
} // namespace parity::tests
