// parity report and diff --truth: the truth beside both paths, which judges nothing.
#include <set>

#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class TruthTest : public RenderingTest {
protected:
  RunResult run(const std::string& scene, const std::string& folder, const std::vector<std::string>& more) const {
    const RunResult result =
        runParity(join({{"report", scene, "--validation", "-o", (m_folder / folder).string()}, kSun, more}));
    EXPECT_EQ(result.signal, 0) << result.err;
    return result;
  }
};

json viewOf(const json& report) { return report.at("scenes").at(0).at("views").at(0); }

std::string settingOf(const json& report, const std::string& name) {
  for (const json& setting : report.at("settings"))
    if (setting.at("name") == name) return setting.at("value");
  return "none";
}

// The report but for what tells of the truth.
json withoutTruth(json report) {
  for (const char* list : {"settings", "conditions"})
    std::erase_if(report[list].get_ref<json::array_t&>(), [](const json& s) {
      const std::string name = s["name"];
      return contains(name, "truth") || name == "interreflection";
    });
  const std::set<std::string> passes = {"truth materials", "truth integrals", "truth occluders",
                                        "compare with the truth", "terms"};
  for (json& scene : report["scenes"]) {
    std::erase_if(scene["passes"].get_ref<json::array_t&>(),
                  [&](const json& pass) { return passes.contains(pass["name"].get<std::string>()); });
    for (json& view : scene["views"]) {
      view["whole"].erase("truth");
      for (json& material : view["materials"]) material.erase("truth");
    }
  }
  return report;
}

TEST_F(TruthTest, StandsBesideBothPathsAndChangesNothingElse) {
  const std::vector<std::string> size = {"--size", "64x48"};
  const RunResult plain = run("builtin:spheres", "plain", join({size, {"--terms"}}));
  const RunResult with = run("builtin:spheres", "with", join({size, {"--truth", "--error", "5%"}}));
  EXPECT_EQ(with.exitCode, plain.exitCode);
  const json report = readReport(m_folder / "with"), view = viewOf(report);
  EXPECT_EQ(withoutTruth(report), withoutTruth(readReport(m_folder / "plain")));
  EXPECT_EQ(settingOf(report, "truth"), "exact integrals, multiple scattering between microfacets (Kulla-Conty), "
                                        "height-correlated Smith, schlick Fresnel curve, balanced diffuse lobe, to a "
                                        "standard error of 5 %");

  std::size_t seen = 0;
  for (const json& material : view["materials"]) {
    const json& truth = material.at("truth");
    if (truth["figures"].is_null()) continue;
    ++seen;
    EXPECT_EQ(truth["figures"]["nonFinite"], 0);
    EXPECT_LE(truth["figures"]["error"]["worst"], 0.0501);
    for (const char* path : {"reference", "test"})
      for (const char* figure : {"flip.mean", "flip.p95", "flip.max", "relmse", "bias.ev"})
        EXPECT_TRUE(truth["figures"][path]["metrics"][figure].is_number()) << material["name"] << figure;
    // The same light as the terms that the report has anyway, in their order.
    auto term = material["terms"].begin();
    for (const json& each : truth["terms"]) {
      while (term != material["terms"].end() && (*term)["term"] != each["term"]) {
        EXPECT_EQ((*term)["test"], 0) << "left out, but not black";
        ++term;
      }
      ASSERT_NE(term, material["terms"].end());
      EXPECT_EQ(each["luminance"]["reference"], (*term)["reference"]);
      EXPECT_EQ(each["luminance"]["test"], (*term)["test"]);
      EXPECT_TRUE(each["figures"]["reference"]["relmse"].is_number());
      ++term;
    }
    for (const auto& [kind, picture] : truth["images"].items())
      EXPECT_TRUE(std::filesystem::exists(m_folder / "with" / picture.get<std::string>())) << kind << picture;
  }
  EXPECT_GT(seen, 20u);
  EXPECT_GT(view["whole"]["truth"]["figures"]["error"]["samples"], 30);
  EXPECT_TRUE(contains(readWholeFile(m_folder / "with" / "report.json"), "exact integrals, multiple scattering"));

  // A later run without it leaves none of its pictures.
  run("builtin:furnace", "with", {"--size", "16x16"});
  for (const std::string& file : listFiles(m_folder / "with")) EXPECT_FALSE(contains(file, "truth")) << file;
}

TEST_F(TruthTest, DependsNeitherOnTheCacheNorOnThreads) {
  const std::vector<std::string> options =
      join({{"--truth", "--error", "5%", "--scattering", "single", "--exposure", "0.7", "--size", "32x24"}, kRoughSky});
  const std::vector<std::string> cached = join({options, {"--cache", (m_folder / "cache").string()}});
  run("builtin:furnace", "first", cached);
  const std::string first = readWholeFile(m_folder / "first" / "report.json");
  run("builtin:furnace", "again", join({cached, {"--threads", "1"}}));
  EXPECT_TRUE(readWholeFile(m_folder / "again" / "report.json") == first);
  run("builtin:furnace", "anew", join({options, {"--no-cache", "--threads", "1"}}));
  EXPECT_TRUE(readWholeFile(m_folder / "anew" / "report.json") == first);
}

TEST_F(TruthTest, NamesSingleScatteringAndTheGeometryTerm) {
  run("builtin:furnace", "single",
      {"--truth", "--error", "10%", "--scattering", "single", "--geometry-term", "schlick-smith", "--shadows", "--size",
       "16x16"});
  EXPECT_EQ(
      settingOf(readReport(m_folder / "single"), "truth"),
      "exact integrals, single scattering between microfacets, Schlick-Smith, schlick Fresnel curve, balanced diffuse "
      "lobe, with shadows, to a standard error of 10 %");
}

// A white furnace: both high-end and truth are 1 (docs/shading.md 5), so what is between them is the truth's noise and
// nothing else: the very case that the notes are for. Mobile does not compensate.
TEST_F(TruthTest, InAWhiteFurnaceHighendIsTheTruth) {
  const std::string file = (m_folder / "furnace.json").string();
  const RunResult result =
      runParity({"diff", "builtin:furnace", "--size", "64x48", "--truth", "--error", "1%", "--json", file});
  EXPECT_TRUE(exitedWith(2, result));
  for (const char* word : {"hi/truth", "mo/truth", "~"}) EXPECT_TRUE(contains(result.out, word)) << word;
  const json view = viewOf(json::parse(readWholeFile(file)));
  for (const json& material : view["materials"]) {
    ASSERT_EQ(material["truth"]["terms"].size(), 1u) << "all else is black";
    const json& light = material["truth"]["terms"][0]["luminance"];
    EXPECT_NEAR(light["reference"].get<double>() / light["truth"].get<double>(), 1, 0.01) << material["name"];
  }
  const json& whole = view["whole"]["truth"];
  const double noise = whole["figures"]["error"]["relmse"];
  EXPECT_NEAR(whole["figures"]["reference"]["metrics"]["relmse"].get<double>() / noise, 1, 0.3);
  ASSERT_EQ(whole["notes"].size(), 1u);
  EXPECT_TRUE(contains(whole["notes"][0], "high-end: the difference to the truth"));
  EXPECT_GT(whole["figures"]["test"]["metrics"]["relmse"], 100 * noise);
}

} // namespace
} // namespace parity::tests
