// Which term is the cause: faults whose term is known are named, and nothing is attributed within budget.
#include <map>

#include "cli/checks.h"

namespace parity::tests {
namespace {

using Json = nlohmann::json;

class AttributionTest : public RenderingTest {
protected:
  // The only scene of a run that wrote JSON to stdout.
  static Json sceneOf(const RunResult& result) {
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.err;
    return Json::parse(result.out)["scenes"][0];
  }
  static Json diff(const std::string& scene, const std::vector<std::string>& options) {
    return sceneOf(runParity(join({{"diff", scene, "--json", "-"}, kSmall, options})));
  }
  static std::map<std::string, std::uint64_t> countsOf(const Json& scene) {
    std::map<std::string, std::uint64_t> counts;
    for (const Json& pass : scene["passes"]) counts[pass["name"]] = pass["count"];
    return counts;
  }
  static std::string whyNotAttributed(const Json& scene) {
    EXPECT_EQ(scene["passes"].back()["name"], "attribution");
    const Json& why = scene["passes"].back()["skipped"];
    return why.is_null() ? "" : why.get<std::string>();
  }
  static double flipWith(const Json& attribution, const std::string& term) {
    for (const Json& effect : attribution["terms"])
      if (effect["term"] == term) return effect["flip"];
    ADD_FAILURE() << "no " << term << " in " << attribution.dump();
    return -1;
  }
  std::string writeMetal(double roughness) const {
    GltfFile file = makeQuad();
    file.material()["pbrMetallicRoughness"] = {{"metallicFactor", 1}, {"roughnessFactor", roughness}};
    return writeEmbedded(m_folder, std::move(file), "metal");
  }
};

// karis2014 has local lights baked: mobile lacks them, and a matt white ball reflects them diffusely.
TEST_F(AttributionTest, ALightThatMobileLacksIsNamedAsTheCause) {
  const std::filesystem::path folder = m_folder / "out";
  const std::vector<std::string> lamps = {"builtin:lamps", "--mobile-preset", "karis2014"};
  const RunResult result =
      runParity(join({{"report"}, lamps, {"--annotate", "github"}, kSmall, {"-o", folder.string()}}));
  EXPECT_TRUE(exitedWith(2, result));
  const std::string cause = "localDiffuse (diffuse light of local lights): FLIP ";
  bool said = false, annotated = false;
  for (const std::string& line : linesOf(result.out)) {
    said |= contains(line, "white ball") && contains(line, "; " + cause) && contains(line, " with the high-end term");
    annotated |= contains(line, "::error ") && contains(line, "Cause: " + cause);
  }
  EXPECT_TRUE(said) << result.out;
  EXPECT_TRUE(annotated) << result.out;
  EXPECT_TRUE(contains(readWholeFile(folder / "junit.xml"), "cause: " + cause));
  const Json report = readReport(folder);
  for (const Json& material : report["scenes"][0]["views"][0]["materials"]) {
    const bool fails = material["verdict"] == "fail";
    EXPECT_EQ(material.contains("attribution"), fails) << material["name"];
    EXPECT_EQ(material["terms"].size(), 9u) << "of the whole view";
    if (material["name"] == "white ball") {
      EXPECT_LT(flipWith(material["attribution"], "localDiffuse"), 0.2 * material["attribution"]["flip"].get<double>());
    }
  }
  // Figures of terms do not depend on what a page shows.
  const Json again = Json::parse(runParity(join({{"diff"}, lamps, kSmall, {"--json", "-"}})).out);
  const auto& without = again["scenes"][0]["views"][0]["materials"];
  const auto& with = report["scenes"][0]["views"][0]["materials"];
  ASSERT_EQ(without.size(), with.size());
  for (std::size_t m = 0; m < with.size(); ++m)
    for (const char* key : {"terms", "attribution"})
      EXPECT_EQ(without[m].value(key, Json()), with[m].value(key, Json())) << with[m]["name"] << ' ' << key;
}

// Both paths have the same emissive term and no other: what differs is that mobile's target blends in its own numbers.
TEST_F(AttributionTest, WhatTheRenderTargetDoesToLayersIsBlamedOnNoTerm) {
  GltfFile file = makeQuad();
  file.json["extensionsUsed"] = {"KHR_materials_unlit"};
  file.material()["extensions"]["KHR_materials_unlit"] = Json::object();
  file.material()["pbrMetallicRoughness"] = {{"baseColorFactor", {0.02, 0.5, 0.8, 1}}};
  Json glass = file.material();
  glass["name"] = "glass";
  glass["alphaMode"] = "BLEND";
  glass["pbrMetallicRoughness"]["baseColorFactor"] = {0.9, 0.02, 0.1, 0.5};
  file.json["materials"].push_back(glass);
  file.json["meshes"].push_back(file.json["meshes"][0]);
  file.json["meshes"][1]["primitives"][0]["material"] = 1;
  file.json["nodes"].push_back({{"mesh", 1}, {"translation", {0.3, 0, 0.1}}});
  file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size() - 1);
  const std::string scene = writeEmbedded(m_folder, std::move(file), "layers");
  const Json result = diff(scene, {"--mobile-target", "rgba8-gamma2", "--attribution", "all"});
  const Json& material = result["views"][0]["materials"][1];
  ASSERT_EQ(material["name"], "glass");
  const double flip = material["attribution"]["flip"];
  EXPECT_GT(flip, 0.05) << "the target must make a difference";
  for (const Json& effect : material["attribution"]["terms"])
    EXPECT_NEAR(effect["flip"].get<double>(), flip, 0.02 * flip) << effect;
}

// A metal under a sun alone has no other light than sunSpecular: taking it over, mobile is the high-end path but for
// its halves.
TEST_F(AttributionTest, TheOnlyTermThereIsExplainsAllAndTheFigureIsTheReports) {
  const Json scene = diff(writeMetal(0.6), {"--sun", "60,80,9", "--mobile-preset", "karis2014", "--budgets",
                                            writeBudgets(m_folder, "fail = 0.001"), "--background", "0,0,0"});
  const Json& material = scene["views"][0]["materials"][0];
  ASSERT_TRUE(material.contains("attribution")) << material.dump(1);
  const Json& found = material["attribution"];
  EXPECT_EQ(found["flip"], material["figures"]["metrics"]["flip.mean"]);
  EXPECT_GT(found["flip"], 0.05);
  EXPECT_EQ(found["terms"].size(), 1u) << found.dump();
  EXPECT_LT(flipWith(found, "sunSpecular"), 0.004); // a tenth of a step of 8 bits: observed 0
}

// In half a smooth metal's highlight is no number by karis2014: that term is named, though no colour is left to judge.
TEST_F(AttributionTest, ATermThatIsNotANumberIsNamed) {
  const Json scene = diff(writeMetal(0), join({kSun, {"--mobile-preset", "karis2014"}}));
  const Json& material = scene["views"][0]["materials"][0];
  ASSERT_TRUE(contains(material["reason"], "NaN")) << material.dump(1);
  EXPECT_EQ(material["attribution"]["flip"], 1);
  EXPECT_LT(flipWith(material["attribution"], "sunSpecular"), 0.5);
}

// The shaders of a picture in one part write the terms, which are looked at where something is over budget.
TEST_F(AttributionTest, APictureInOnePartIsShadedOnce) {
  const std::string quad = writeMetal(0.6);
  const Json within = diff(quad, join({kSun, {"--budgets", writeBudgets(m_folder, "fail = 0.999")}}));
  EXPECT_EQ(whyNotAttributed(within), "no material is over budget");
  auto plain = countsOf(within);
  EXPECT_EQ(plain["surface"], plain["compare"]);
  EXPECT_EQ(plain["shade mobile"], plain["compare"]);
  EXPECT_EQ(plain["terms"], 0u);
  EXPECT_FALSE(within["views"][0]["materials"][0].contains("attribution"));
  EXPECT_EQ(within["views"][0]["materials"][0]["terms"].size(), 0u);

  const std::vector<std::string> strict = join({kSun, {"--budgets", writeBudgets(m_folder, "fail = 0.0001")}});
  const Json over = diff(quad, strict);
  auto more = countsOf(over);
  EXPECT_EQ(more["attribution"], over["views"][0]["materials"][0]["attribution"]["terms"].size());
  EXPECT_EQ(more["terms"], 2 * plain["compare"]) << "of two paths";
  for (const char* pass : {"shade highend", "shade mobile", "surface", "compare"})
    EXPECT_EQ(more[pass], plain[pass]) << pass;
  EXPECT_EQ(over["views"][0]["materials"][0]["figures"], within["views"][0]["materials"][0]["figures"]);

  // Surfaces of pictures in several parts are not kept: they are made again.
  auto sampled = countsOf(diff(quad, join({strict, {"--samples", "2"}})));
  EXPECT_EQ(sampled["terms"], sampled["surface"]);
  EXPECT_EQ(sampled["shade mobile"], sampled["surface"]);
  EXPECT_GT(sampled["surface"], 3 * sampled["compare"]);

  const Json none = diff(quad, join({strict, {"--attribution", "none"}}));
  EXPECT_EQ(whyNotAttributed(none), "not requested");
  EXPECT_EQ(countsOf(none)["terms"], 0u);
  EXPECT_FALSE(none["views"][0]["materials"][0].contains("attribution"));
}

TEST_F(AttributionTest, AllAttributesWhatIsSeenAndShadesOnce) {
  const std::vector<std::string> options =
      join({kSun, {"--budgets", writeBudgets(m_folder, "fail = 0.999"), "--attribution", "all"}});
  const Json scene = diff("builtin:materials", options);
  auto counts = countsOf(scene);
  EXPECT_EQ(counts["surface"], counts["compare"]);
  EXPECT_EQ(counts["terms"], 2 * counts["compare"]);
  EXPECT_GT(counts["attribution"], 2u);
  for (const Json& material : scene["views"][0]["materials"]) {
    const bool seen = !material["figures"].is_null();
    EXPECT_EQ(material.contains("attribution"), seen) << material["name"];
  }
}

// A view that does not show the material over budget is not attributed.
TEST_F(AttributionTest, OnlyTheViewsThatNeedItAreAttributed) {
  GltfFile file = makeQuad();
  file.json["materials"].push_back({{"name", "far"}});
  file.json["meshes"].push_back(file.json["meshes"][0]);
  file.json["meshes"][1]["primitives"][0]["material"] = 1;
  file.json["nodes"].push_back({{"mesh", 1}, {"translation", {50, 0, 0}}});
  file.json["scenes"][0]["nodes"].push_back(1);
  writeEmbedded(m_folder, std::move(file), "two");
  writeFile(m_folder / "b.toml", std::string(R"(
[[material]]
name = "far"
checks = [{ metric = "flip.mean", fail = 0.0001 }]
[[material]]
name = "*"
checks = [{ metric = "flip.mean", fail = 0.999 }]
[[whole]]
checks = [{ metric = "flip.mean", fail = 0.999 }])"));
  writeFile(m_folder / "suite.toml", std::string(R"(
budgets = "b.toml"
[[scene]]
file = "two-embedded.gltf"
sun = [30, 50, 4]
[[scene.view]]
name = "near"
orbit = [0, 80, 2]
target = [0.5, 0.5, 0]
[[scene.view]]
name = "far"
orbit = [0, 80, 2]
target = [50.5, 0.5, 0])"));
  const Json scene =
      sceneOf(runParity(join({{"report", "--suite", path("suite.toml"), "-o", path("out"), "--json", "-"}, kSmall})));
  ASSERT_EQ(scene["views"].size(), 2u) << scene.dump(1);
  EXPECT_EQ(scene["views"][0]["materials"][0]["terms"].size(), 0u);
  EXPECT_FALSE(scene["views"][0]["materials"][0].contains("attribution"));
  const Json& seen = scene["views"][1]["materials"][1];
  EXPECT_TRUE(seen.contains("attribution")) << seen.dump(1);
  auto counts = countsOf(scene);
  const std::uint64_t far = seen["figures"]["pixels"];
  EXPECT_EQ(counts["terms"], 2 * far);
  EXPECT_EQ(counts["surface"], counts["compare"]);
  EXPECT_EQ(counts["shade mobile"], counts["compare"]);
}

TEST_F(AttributionTest, AMaterialThatFailsByItsRegressionIsAttributed) {
  const std::string quad = writeMetal(0.6);
  const std::filesystem::path file = m_folder / "old.json";
  writeFile(m_folder / "b.toml", std::string("[[material]]\nname = \"*\"\n"
                                             "checks = [{ metric = \"flip.mean\", fail = 0.999 }]\n"
                                             "regress = [{ metric = \"flip.mean\", fail = 0.5 }]\n"
                                             "[[whole]]\nchecks = [{ metric = \"flip.mean\", fail = 0.999 }]\n"));
  const std::vector<std::string> options = join({kSun, {"--budgets", path("b.toml")}});
  RunResult first = runParity(join({{"diff", quad, "--json", file.string()}, kSmall, options}));
  ASSERT_TRUE(exitedWith(0, first));
  const auto since = [&] { return diff(quad, join({options, {"--baseline", file.string()}})); };
  EXPECT_EQ(whyNotAttributed(since()), "no material is over budget");
  Json old = Json::parse(readWholeFile(file));
  old["scenes"][0]["views"][0]["materials"][0]["figures"]["metrics"]["flip.mean"] = -1;
  writeFile(file, old.dump());
  const Json scene = since();
  const Json& material = scene["views"][0]["materials"][0];
  EXPECT_EQ(material["verdict"], "fail");
  EXPECT_TRUE(material.contains("attribution")) << material.dump(1);
}

// What the cache holds of stricter or looser budgets shows in no report.
TEST_F(AttributionTest, ReportsDoNotDependOnWhatTheCacheHolds) {
  const std::string quad = writeMetal(0.6);
  int runs = 0;
  const auto report = [&](const std::string& limits, const std::vector<std::string>& more) {
    const std::filesystem::path folder = m_folder / ("out" + std::to_string(runs++));
    const RunResult result = runParity(
        join({{"report", quad, "--size", "48x48", "-o", folder.string(), "--budgets", writeBudgets(m_folder, limits)},
              kSun,
              kRoughSky,
              more}));
    EXPECT_LE(result.exitCode, 2) << result.err;
    const Json info = Json::parse(readWholeFile(folder / "run.json"));
    return std::pair(readWholeFile(folder / "report.json"), info["cachedScenes"].size());
  };
  const std::string strict = "fail = 0.0001", loose = "fail = 0.999";
  const std::vector<std::string> none = {"--attribution", "none"}, all = {"--attribution", "all"};
  const auto fresh = [&](const std::string& limits, std::vector<std::string> more) {
    more.push_back("--no-cache");
    return report(limits, more).first;
  };
  const std::string strictFresh = fresh(strict, {}), looseFresh = fresh(loose, {}), noneFresh = fresh(strict, none),
                    allFresh = fresh(loose, all);
  EXPECT_TRUE(contains(strictFresh, "\"attribution\"") && contains(allFresh, "\"attribution\""));
  const auto cached = [&](const std::string& limits, std::vector<std::string> more) {
    more.insert(more.end(), {"--cache", path("cache")});
    return report(limits, more);
  };
  // Whether it is recalled, and what comes out.
  EXPECT_EQ(cached(strict, {}), std::pair(strictFresh, std::size_t{0}));
  EXPECT_EQ(cached(strict, {}), std::pair(strictFresh, std::size_t{1}));
  EXPECT_EQ(cached(loose, {}), std::pair(looseFresh, std::size_t{1})) << "it needs less than what was kept";
  EXPECT_EQ(cached(strict, none), std::pair(noneFresh, std::size_t{1}));
  EXPECT_EQ(cached(strict, {}), std::pair(strictFresh, std::size_t{1}));
  EXPECT_EQ(cached(loose, all), std::pair(allFresh, std::size_t{0})) << "its pictures come from other shaders";
  EXPECT_EQ(cached(loose, all), std::pair(allFresh, std::size_t{1}));
}

TEST_F(AttributionTest, AnAttributionThatTheCacheLacksIsRendered) {
  const std::string quad = writeMetal(0.6);
  const auto run = [&](const std::string& limits) {
    const RunResult result = runParity(join({{"diff", quad, "--size", "48x48", "--json", "-", "-v", "--cache",
                                              path("cache"), "--budgets", writeBudgets(m_folder, limits)},
                                             kSun,
                                             kRoughSky}));
    return std::pair(sceneOf(result), contains(result.err, "taken from the cache"));
  };
  EXPECT_FALSE(run("fail = 0.999").second);
  const auto [scene, recalled] = run("fail = 0.0001");
  EXPECT_FALSE(recalled);
  EXPECT_TRUE(scene["views"][0]["materials"][0].contains("attribution"));
  EXPECT_EQ(run("fail = 0.0001"), std::pair(scene, true));
}

} // namespace
} // namespace parity::tests
