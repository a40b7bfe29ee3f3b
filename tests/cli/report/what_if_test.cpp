// --what-if: the figures and verdicts of a run with that preset, from a run without it.
#include <map>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class WhatIfTest : public RenderingTest {
protected:
  json diff(const std::vector<std::string>& more, const std::vector<std::string>& scene = {"builtin:spheres"}) {
    const std::string file = path("diff.json");
    const RunResult result = runParity(join(
        {{"diff"}, scene, {"--json", file, "--attribution", "none"}, kSmall, kSun, {"--env", "builtin:sky"}, more}));
    EXPECT_TRUE(isReported(result)) << result.err;
    m_out = result.out;
    return json::parse(readWholeFile(file)).at("scenes").at(0);
  }
  // Of each seen material what the one run says it would be, and what the other is.
  static void expectSame(const json& asked, const json& plain, const std::string& preset) {
    std::size_t seen = 0;
    const json &would = asked["views"][0]["materials"], &is = plain["views"][0]["materials"];
    ASSERT_EQ(would.size(), is.size());
    for (std::size_t i = 0; i < would.size(); ++i) {
      if (is[i]["figures"].is_null()) {
        EXPECT_FALSE(would[i].contains("whatIf"));
        continue;
      }
      ++seen;
      const json& whatIf = would[i]["whatIf"].at(0);
      EXPECT_EQ(whatIf["preset"], preset);
      EXPECT_EQ(whatIf["figures"].dump(), is[i]["figures"].dump()) << is[i]["name"];
      EXPECT_EQ(whatIf["verdict"], is[i]["verdict"]) << is[i]["name"];
      EXPECT_EQ(whatIf["reason"], is[i]["reason"]) << is[i]["name"];
    }
    EXPECT_GT(seen, 3u);
  }
  std::string m_out;
};

TEST_F(WhatIfTest, IsToTheLastBitARunWithThatPreset) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{},
                                               {"--mobile-target", "rgba8-srgb", "--samples", "2"},
                                               {"--terms", "--sky-sh", "9", "--metrics", "flip,psnr,bias,ssim"}}) {
    const json asked = diff(join({{"--what-if", "refit"}, more}));
    EXPECT_TRUE(contains(m_out, "with refit: FLIP ")) << m_out;
    expectSame(asked, diff(join({{"--mobile-preset", "refit"}, more})), "refit");
    json without = diff(more), rest = asked;
    for (json& material : rest["views"][0]["materials"]) material.erase("whatIf");
    EXPECT_EQ(rest["views"], without["views"]) << "the run itself stays as it is";
  }
}

TEST_F(WhatIfTest, SaysItInWordsAndCountsTheWork) {
  const json scene = diff({"--what-if", "karis2014,refit"});
  const json& material = scene["views"][0]["materials"][0];
  ASSERT_EQ(material["whatIf"].size(), 2u);
  const std::string words = material["whatIf"][1]["words"];
  EXPECT_TRUE(words.starts_with("with refit: FLIP 0.")) << words;
  EXPECT_TRUE(contains(words, " instead of 0.")) << words;
  EXPECT_TRUE(contains(words, " EV instead of ")) << words;
  EXPECT_TRUE(words.ends_with(", " + material["whatIf"][1]["verdict"].get<std::string>())) << words;
  std::map<std::string, std::uint64_t> counts;
  for (const json& pass : scene["passes"]) counts[pass["name"]] = pass["count"];
  EXPECT_EQ(counts.at("shade what-ifs"), 2 * counts.at("surface"));
  EXPECT_EQ(counts.at("shade mobile"), counts.at("surface"));
  for (const json& pass : diff({})["passes"])
    if (pass["name"] == "shade what-ifs") {
      EXPECT_EQ(pass["skipped"], "not requested");
    }
}

TEST_F(WhatIfTest, IsKeptInTheCacheByAllThatThePresetSets) {
  const auto report = [&](const std::string& folder, const std::vector<std::string>& more) {
    const RunResult result = runParity(join({{"report", "builtin:spheres", "--cache", path("cache"), "--size", "48x48",
                                              "--what-if", "refit", "-q", "-o", path(folder)},
                                             kSun,
                                             kRoughSky,
                                             more}));
    EXPECT_TRUE(isReported(result)) << result.err;
    return json::parse(readWholeFile(m_folder / folder / "run.json"))["cachedScenes"].size();
  };
  EXPECT_EQ(report("first", {}), 0u);
  EXPECT_EQ(report("again", {}), 1u);
  EXPECT_TRUE(readWholeFile(m_folder / "first/report.json") == readWholeFile(m_folder / "again/report.json"));
  EXPECT_TRUE(contains(readWholeFile(m_folder / "again/report.json"), "with refit: FLIP"));
  // The run's own preset has this value already, but refit has another.
  EXPECT_EQ(report("other", {"--sky-sh", "4"}), 0u);
  EXPECT_EQ(report("loose", {"--budgets", writeBudgets(m_folder, "fail = 0.999"), "--attribution", "none"}), 1u);
  const json loose = readReport(m_folder / "loose");
  for (const json& material : loose["scenes"][0]["views"][0]["materials"])
    for (const json& whatIf : material.value("whatIf", json::array())) EXPECT_NE(whatIf["verdict"], "fail");
}

TEST_F(WhatIfTest, AnUnknownPresetIsRefusedWithTheNearest) {
  const RunResult unknown = runParity({"diff", "builtin:spheres", "--what-if", "refitt"});
  EXPECT_TRUE(exitedWith(64, unknown));
  EXPECT_TRUE(contains(unknown.err, "--what-if: 'refitt' is unknown; did you mean 'refit'?")) << unknown.err;
  const RunResult reference = runParity({"diff", "builtin:spheres", "--what-if", "refit", "--paths", "mobile,highend"});
  EXPECT_TRUE(exitedWith(64, reference));
  EXPECT_TRUE(contains(reference.err, "--what-if: 'refit' is a preset of 'mobile', which is not a test path here"))
      << reference.err;
}

// Small pictures of textures: written once for two scenes, gone with the next report.
TEST_F(WhatIfTest, CardsHavePicturesThatTheFolderHoldsOnce) {
  const std::string image = "shared.png";
  base::Image8 pixels(4, 4, 3, 90);
  pixels.pixels[0] = 200;
  base::writeImage8(m_folder / image, pixels);
  std::vector<std::string> scenes;
  for (const char* name : {"one", "two"}) {
    GltfFile file = makeQuad();
    file.json["images"] = {{{"uri", image}, {"name", "</script><b>\u202E"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.material()["name"] = "<img src=x onerror=alert(1)>";
    file.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    scenes.push_back(writeEmbedded(m_folder, std::move(file), name));
  }
  const std::vector<std::string> options = {"--attribution", "none", "--size", "48x48", "-q", "--cache", path("cache")};
  const auto run = [&](const std::vector<std::string>& which, const std::vector<std::string>& more) {
    EXPECT_TRUE(isReported(runParity(join({{"report"}, which, options, kSun, kRoughSky, more}))));
  };
  const auto textures = [&](const std::string& folder) {
    std::vector<std::string> files = listFiles(m_folder / folder);
    std::erase_if(files, [](const std::string& file) { return !contains(file, "images/texture-"); });
    return files;
  };
  run(scenes, {"-o", path("out")});
  const json report = readReport(m_folder / "out");
  ASSERT_EQ(textures("out").size(), 1u);
  for (const json& scene : report["scenes"]) {
    const json& texture = scene["materials"][0]["inputs"][0]["texture"];
    EXPECT_EQ(texture["picture"], textures("out")[0]);
    EXPECT_EQ(texture["file"], image);
    EXPECT_EQ(texture["width"], 4);
  }
  run(scenes, {"-o", path("again")});
  EXPECT_EQ(textures("again"), textures("out"));
  EXPECT_TRUE(readWholeFile(m_folder / "again" / textures("out")[0]) ==
              readWholeFile(m_folder / "out" / textures("out")[0]));
  EXPECT_TRUE(readWholeFile(m_folder / "again/report.json") == readWholeFile(m_folder / "out/report.json"));
  if (kHasPage) {
    run(scenes, {"-o", path("single"), "--single-file"});
    const std::string page = readWholeFile(m_folder / "single/index.html");
    const std::string name = "data-file=\"" + textures("out")[0] + "\"";
    EXPECT_NE(page.find(name), std::string::npos);
    EXPECT_EQ(page.find(name), page.rfind(name)) << "two scenes share it";
    EXPECT_FALSE(contains(page, "<img src=x")) << "of a name";
  }
  run({"builtin:furnace"}, {"-o", path("out")});
  EXPECT_TRUE(textures("out").empty()) << "an older report's";
}

} // namespace
} // namespace parity::tests
