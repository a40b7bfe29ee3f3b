// Suites of many scenes: globs of files, lists of values, names from templates, views of the suite, overrides, include,
// tags. What such a suite means, and the mistakes that it must name.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "base/cache.h"
#include "base/expect_error.h"
#include "base/file.h"
#include "base/temp_folder.h"
#include "job/knobs.h"
#include "job/scene_times.h"
#include "mobile/options.h"

namespace parity::job {
namespace {

using base::expectError;
using scenes::Suite;

class SuiteOfMany : public testing::Test {
protected:
  void touch(const std::string& file) {
    std::filesystem::create_directories((m_folder / file).parent_path());
    base::writeText(m_folder / file, "");
  }
  Suite load(const std::string& text, const std::string& file = "suite.toml") {
    base::writeText(m_folder / file, text);
    return scenes::loadSuite(m_folder / file, suiteKnobs());
  }
  std::vector<std::string> names(const std::string& text) {
    std::vector<std::string> all;
    for (const scenes::SuiteEntry& entry : load(text).entries) all.push_back(entry.name);
    return all;
  }
  // Of the entries, relative to the suite.
  std::vector<std::string> files(const std::string& text) {
    std::vector<std::string> all;
    for (const scenes::SuiteEntry& entry : load(text).entries)
      all.push_back(std::filesystem::path(entry.scene).lexically_relative(m_folder.path()).generic_string());
    return all;
  }
  void expectRefused(const std::string& text, std::vector<std::string> parts) {
    parts.push_back("suite.toml: ");
    expectError([&] { load(text); }, parts);
  }

  base::TempFolder m_folder;
};

using Texts = std::vector<std::string>;

TEST_F(SuiteOfMany, GlobsFindSceneFilesInOneOrder) {
  for (const char* file : {"a/x.glb", "a/b/y.gltf", "a/b/c/z.GLB", "a/b/c/z.bin", "a/.hidden/h.glb", "a/b/.h.glb",
                           "top.glb", "a/old/w.glb"})
    touch(file);
  EXPECT_EQ(files("[[scene]]\nfiles = [\"a/**/*.gl*\", \"a/**/*.GLB\"]\n"),
            (Texts{"a/b/c/z.GLB", "a/b/y.gltf", "a/old/w.glb", "a/x.glb"}));
  EXPECT_EQ(files("[[scene]]\nfiles = [\"a/**\"]\nexclude = [\"a/old/*\", \"**/y.*\"]\n"),
            (Texts{"a/b/c/z.GLB", "a/x.glb"}));
  EXPECT_EQ(files("[[scene]]\nfiles = [\"*/*.glb\"]\n"), (Texts{"a/x.glb"})) << "'*' stays within a folder";
  EXPECT_EQ(files("[[scene]]\nfiles = [\"**/**/c/*\"]\n"), (Texts{"a/b/c/z.GLB"}));
  EXPECT_EQ(files("[[scene]]\nfiles = [\"a/.hidden/*\"]\n"), (Texts{"a/.hidden/h.glb"}));
  EXPECT_EQ(files("[[scene]]\nfiles = [\"a/[!b]*/*\"]\n"), (Texts{"a/old/w.glb"}));
  EXPECT_EQ(files("[[scene]]\nfiles = [\"a/x.glb\", \"a/*.glb\", \"none.glb\"]\n"), (Texts{"a/x.glb", "none.glb"}))
      << "each once; a name without wildcards is a file, which loading looks for";
}

TEST_F(SuiteOfMany, LinksToFoldersAreNotFollowedForEver) {
  touch("a/x.glb");
  std::filesystem::create_directory_symlink(m_folder / "a", m_folder / "a/loop");
  EXPECT_EQ(files("[[scene]]\nfiles = [\"**/*.glb\"]\n"), (Texts{"a/x.glb"}));
  EXPECT_EQ(files("[[scene]]\nfiles = [\"a/loop/*.glb\"]\n"), (Texts{"a/loop/x.glb"})) << "where it is named";
}

TEST_F(SuiteOfMany, AGlobThatNamesNothingIsAMistake) {
  touch("a/x.glb");
  expectRefused("[[scene]]\nfiles = [\"a/*.gltf\"]\n",
                {"line 2: files: no scene file (.gltf, .glb) matches 'a/*.gltf'"});
  expectRefused("[[scene]]\nfiles = [\"b/*.glb\"]\n", {"line 2: files: 'b/*.glb': there is no folder '", "b'"});
  expectRefused("[[scene]]\nfiles = [\"a/*\"]\nexclude = [\"a/x*\"]\n", {"'exclude' leaves no file of 'a/*'"});
  expectRefused("[[scene]]\nfiles = [\"a/*\"]\nexclude = [\"a/y*\"]\n", {"'exclude': no file matches 'a/y*'"});
  expectRefused("[[scene]]\nfile = \"a/x.glb\"\nfiles = [\"a/*\"]\n",
                {"line 3: files: cannot be combined with 'file'"});
  expectRefused("[[scene]]\nfile = \"a/x.glb\"\nexclude = [\"a/*\"]\n", {"line 3: exclude: needs 'files'"});
  expectRefused("[[scene]]\nfiles = []\n", {"line 2: files: is not a list of strings"});
}

TEST_F(SuiteOfMany, ListsMultiplyAndNamesSayWhich) {
  touch("a/x.glb");
  touch("a/y.glb");
  const std::string text = "[[scene]]\nfiles = [\"a/*\"]\nenvironments = [\"e/studio.hdr\", \"builtin:sky\"]\n"
                           "presets = [\"ue4-2020\", \"refit\"]\n";
  EXPECT_EQ(names(text), (Texts{"x, studio, ue4-2020", "x, studio, refit", "x, sky, ue4-2020", "x, sky, refit",
                                "y, studio, ue4-2020", "y, studio, refit", "y, sky, ue4-2020", "y, sky, refit"}));
  const std::vector<SceneRequest> all = requestsOf(load(text), {}, {});
  EXPECT_EQ(all[1].settings.of<mobile::Options>().preset, "refit");
  EXPECT_EQ(all[1].settings.scene.environment, (m_folder / "e/studio.hdr").string());
  EXPECT_EQ(all[2].settings.of<mobile::Options>().preset, "ue4-2020");
  EXPECT_EQ(all[2].settings.scene.environment, "builtin:sky");
  EXPECT_EQ(names(text + "name = \"{environment}/{folder}-{stem} {preset}\"\n").at(3), "sky/a-x refit");
  EXPECT_EQ(names("[[scene]]\nfile = \"a/x.glb\"\nenvironments = [\"builtin:sky\"]\n"), Texts{"x"}) << "a list of one";
}

TEST_F(SuiteOfMany, ListsOfDefaultsHoldUnlessTheSceneSaysOtherwise) {
  const std::string defaults = "[defaults]\nenvironments = [\"builtin:sky\", \"builtin:night\"]\n";
  EXPECT_EQ(names(defaults +
                  "[[scene]]\nfile = \"a.glb\"\n[[scene]]\nfile = \"b.glb\"\nenvironment = \"builtin:studio\"\n"
                  "[[scene]]\nfile = \"c.glb\"\nenvironments = [\"builtin:white\", \"builtin:sky\"]\n"),
            (Texts{"a, sky", "a, night", "b", "c, white", "c, sky"}));
}

TEST_F(SuiteOfMany, PlaceholdersWithoutAValueAndEqualNamesAreNamed) {
  touch("a/x.glb");
  touch("b/x.glb");
  expectRefused("[[scene]]\nfiles = [\"*/x.glb\"]\n",
                {"line 1", "two scenes have the name 'x'", "a/x.glb", "b/x.glb", "name = \"{folder}, {stem}\""});
  EXPECT_EQ(names("[[scene]]\nfiles = [\"*/x.glb\"]\nname = \"{folder}, {stem}\"\n"), (Texts{"a, x", "b, x"}));
  expectRefused("[[scene]]\nfile = \"a/x.glb\"\nname = \"{stm}\"\n",
                {"line 3: name: '{stm}' has no value here; did you mean 'stem'?"});
  expectRefused("[[scene]]\nfile = \"a/x.glb\"\nname = \"{environment}\"\n", {"'{environment}' has no value here"});
  EXPECT_EQ(
      names("[defaults]\nenvironment = \"builtin:sky\"\n[[scene]]\nfile = \"a/x.glb\"\nname = \"{environment}\"\n"),
      Texts{"sky"});
  expectRefused("[[scene]]\nfile = \"x.glb\"\nenvironment = \"builtin:sky\"\nenvironments = [\"builtin:sky\"]\n",
                {"line 4: environments: cannot be combined with a single value", "line 3: environment"});
  expectRefused("[[scene]]\nfile = \"x.glb\"\npresets = [\"refit\", \"refit\"]\n", {"'refit' is listed twice"});
  expectRefused("[[scene]]\nfile = \"x.glb\"\npresets = [\"refitt\"]\n", {"line 3: presets: 'refitt' is unknown"});
}

TEST_F(SuiteOfMany, ViewsOfTheSuiteAreEverySceneS) {
  const std::string views =
      "[[view]]\nname = \"front\"\norbit = [0, 90, 0]\n[[view]]\nname = \"side\"\norbit = [90, 90, 0]\n";
  const auto viewsOf = [&](const std::string& scene) {
    Texts all;
    const Suite suite = load(views + "[[scene]]\nfile = \"x.glb\"\n" + scene);
    for (const scenes::ViewRequest& view : suite.entries.at(0).views) all.push_back(view.name);
    return all;
  };
  EXPECT_EQ(viewsOf(""), (Texts{"front", "side"}));
  EXPECT_EQ(viewsOf("views = [\"side\"]\n"), Texts{"side"});
  EXPECT_EQ(viewsOf("[[scene.view]]\nname = \"own\"\n"), Texts{"own"});
  EXPECT_EQ(viewsOf("views = [\"side\"]\n[[scene.view]]\nname = \"own\"\n"), (Texts{"side", "own"}));
  expectRefused(views + "[[scene]]\nfile = \"x.glb\"\nviews = [\"sde\"]\n",
                {"line 9: views: no [[view]] of the suite has the name 'sde'; did you mean 'side'?"});
  expectRefused(views + "[[scene]]\nfile = \"x.glb\"\nviews = [\"side\"]\n[[scene.view]]\nname = \"side\"\n",
                {"two views have the name 'side'"});
}

TEST_F(SuiteOfMany, OverridesChangeWhatTheyMean) {
  const std::string scenes =
      "[[view]]\nname = \"front\"\n[[view]]\nname = \"side\"\norbit = [90, 90, 0]\n"
      "[[scene]]\nfile = \"hero.glb\"\ntags = [\"big\"]\nexposure = 1\n[[scene]]\nfile = \"rock.glb\"\n";
  const std::vector<SceneRequest> all = requestsOf(
      load(scenes + "[[override]]\nscenes = [\"hero\"]\nexposure = 2\ntags = [\"new\"]\nbudgets = \"b.toml\"\n"
                    "[[override]]\nscenes = [\"tag:new\"]\nexposure = 3\n[[override.view]]\nname = \"s*\"\nfov = 20\n"),
      {}, {{"exposure", {{"9"}, "--exposure"}}});
  EXPECT_EQ(all[0].settings.exposureEv, 3) << "the later one, which sees the tag of the earlier";
  EXPECT_EQ(all[1].settings.exposureEv, 9) << "the command line, as no override means it";
  EXPECT_EQ(all[0].tags, (Texts{"big", "new"}));
  EXPECT_EQ(all[0].budgets, (m_folder / "b.toml").string());
  EXPECT_EQ(all[0].views[1].fovYDeg, 20);
  EXPECT_EQ(all[0].views[1].orbit, glm::vec3(90, 90, 0)) << "what it does not name stays";
  EXPECT_EQ(all[0].views[0].fovYDeg, 45);
  EXPECT_EQ(all[1].views[1].fovYDeg, 45);
  expectRefused(scenes + "[[override]]\nscenes = [\"heroo\"]\n",
                {"scenes: no scene matches 'heroo'; did you mean 'hero'?"});
  expectRefused(scenes + "[[override]]\nscenes = [\"tag:x\"]\n", {"no scene has the tag 'x'"});
  expectRefused(scenes + "[[override]]\nexposure = 1\n", {"scenes: is missing"});
  expectRefused(scenes + "[[override]]\nscenes = [\"*\"]\n[[override.view]]\nname = \"top\"\nfov = 3\n",
                {"no view of these scenes matches 'top'"});
}

TEST_F(SuiteOfMany, IncludedScenesComeFirstWithTheirOwnWords) {
  std::filesystem::create_directories(m_folder / "team");
  base::writeText(m_folder / "team/a.toml",
                  "budgets = \"t.toml\"\n[defaults]\nexposure = 1\n[[scene]]\nfile = \"x.glb\"\n");
  const std::string text =
      "include = [\"team/a.toml\"]\n[defaults]\nexposure = 2\nprecision = \"fp32\"\n[[scene]]\nfile = \"y.glb\"\n";
  const Suite suite = load(text);
  const std::vector<SceneRequest> all = requestsOf(suite, {}, {});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].scene, (m_folder / "team/x.glb").string());
  EXPECT_EQ(all[0].settings.exposureEv, 1);
  EXPECT_EQ(all[0].settings.of<mobile::Options>().precision, mobile::Precision::fp32);
  EXPECT_EQ(all[0].budgets, (m_folder / "team/t.toml").string());
  EXPECT_EQ(all[1].settings.exposureEv, 2);
  EXPECT_FALSE(all[1].budgets);
  EXPECT_EQ(suite.name, "suite");
  EXPECT_EQ(requestsOf(suite, {}, {{"exposure", {{"5"}, ""}}})[0].settings.exposureEv, 5) << "before any defaults";
  base::writeText(m_folder / "team/a.toml", "include = [\"../suite.toml\"]\n");
  expectError([&] { load("include = [\"team/a.toml\"]\n"); },
              {"a.toml: line 1: include: '", "suite.toml' includes itself"});
  expectError([&] { load("include = [\"none.toml\"]\n"); }, {"none.toml"});
}

TEST_F(SuiteOfMany, TagsAreWords) {
  EXPECT_EQ(load("[[scene]]\nfile = \"x.glb\"\ntags = [\"b\", \"a\", \"b\"]\n").entries.at(0).tags, (Texts{"a", "b"}));
  expectRefused("[[scene]]\nfile = \"x.glb\"\ntags = [\"a b\"]\n", {"line 3: tags: 'a b' holds a character"});
}

// As the issue asks: 12 scenes in 2 environments from 2 views in 15 lines.
TEST_F(SuiteOfMany, FifteenLinesAreEnoughForFortyEightPictures) {
  for (int i = 0; i < 12; ++i) touch(fmt::format("assets/{0}/{0}.glb", i));
  const std::string text = R"(name = "nightly"
[defaults]
environments = ["studio.hdr", "garden.hdr"]
[[view]]
name = "front"
orbit = [0, 80, 0]
[[view]]
name = "side"
orbit = [90, 80, 0]
[[scene]]
files = ["assets/**/*.glb"]
)";
  EXPECT_LE(std::ranges::count(text, '\n'), 15);
  const Suite suite = load(text);
  EXPECT_EQ(suite.entries.size(), 24u);
  std::size_t views = 0;
  for (const scenes::SuiteEntry& entry : suite.entries) views += entry.views.size();
  EXPECT_EQ(views, 48u);
}

// Times are kept by what the scene is; what is not known counts as the median.
TEST_F(SuiteOfMany, TimesOfEarlierRunsAreFoundAgain) {
  const base::Cache cache(m_folder / "cache");
  const std::vector<SceneRequest> all =
      requestsOf(load("[[scene]]\nfile = \"a.glb\"\n[[scene]]\nfile = \"b.glb\"\n[[scene]]\nfile = \"c.glb\"\n"
                      "[[scene]]\nname = \"a at night\"\nfile = \"a.glb\"\nenvironment = \"builtin:night\"\n"),
                 {}, {});
  EXPECT_TRUE(estimateTimes(cache, all).seconds.empty());
  keepSceneTime(cache, all[0], 3);
  keepSceneTime(cache, all[1], 5);
  keepSceneTime(cache, all[3], 4);
  SceneRequest larger = all[0];
  larger.settings.width = 64;
  EXPECT_EQ(findSceneTime(cache, larger), 3) << "whatever the run was asked for";
  const SceneTimes times = estimateTimes(cache, all);
  EXPECT_EQ(times.known, 3u);
  EXPECT_EQ(times.seconds, (std::vector<double>{3, 5, 4, 4}));
  EXPECT_FALSE(findSceneTime(base::Cache::disabled(), all[0]));
}

} // namespace
} // namespace parity::job
