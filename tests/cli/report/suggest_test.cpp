// parity budget suggest on the suites that are shipped: an unchanged run with the suggested budgets exits 0.
#include <map>

#include "cli/checks.h"

namespace parity::tests {
namespace {

class SuggestTest : public RenderingTest {
protected:
  // A shipped suite without its baked light, which would have to be made first.
  std::string suite(const std::string& name) const {
    std::string text;
    for (const std::string& line : linesOf(readWholeFile(PARITY_SOURCE_DIR "/scenes/data/" + name)))
      if (!line.starts_with("baked = ")) text += line + "\n";
    return write(name, text);
  }
  // The cache makes the pictures once: budgets judge afterwards.
  RunResult report(const std::string& folder, const std::vector<std::string>& scenes,
                   const std::vector<std::string>& more = {}) const {
    return runParity(
        join({{"report"}, scenes, {"-o", path(folder), "--size", "48x48", "--cache", path("cache")}, kRoughSky, more}));
  }
  void expectUnchangedRunPasses(const std::vector<std::string>& scenes, const std::vector<std::string>& suggest,
                                const std::vector<std::string>& more = {}) const {
    ASSERT_TRUE(exitedWith(0, runParity(join({{"budget", "suggest"}, suggest, {"-o", path("b.toml")}}))));
    const RunResult result = report("again", scenes, join({{"--budgets", path("b.toml"), "--warn-exit"}, more}));
    EXPECT_TRUE(exitedWith(0, result)) << readWholeFile(path("b.toml"));
  }
  // How many rules of the file have each name; "": of whole images.
  std::map<std::string, int> rules() const {
    std::map<std::string, int> count;
    for (const std::string& line : linesOf(readWholeFile(path("b.toml"))))
      if (line == "[[whole]]" || line.starts_with("name = ")) ++count[line == "[[whole]]" ? "" : line];
    return count;
  }
};

TEST_F(SuggestTest, AnUnchangedRunOfEachShippedSuitePassesWithoutAWarning) {
  for (const char* name : {"demo.toml", "evidence.toml"}) {
    const std::vector<std::string> scenes = {"--suite", suite(name)};
    ASSERT_TRUE(isReported(report("first", scenes))) << name;
    expectUnchangedRunPasses(scenes, {path("first")});
    for (const auto& [rule, count] : rules()) EXPECT_EQ(count, 1) << name << ": " << rule;
    expectUnchangedRunPasses(scenes, {path("first"), "--per-scene"});
    EXPECT_GT(rules()[""], 1);
    expectUnchangedRunPasses(scenes, {path("first"), "--regress"}, {"--baseline", path("first")});
    expectUnchangedRunPasses(scenes, {path("first"), "--metrics", "psnr,bias.ev"});
  }
}

TEST_F(SuggestTest, TheLastOfSeveralRunsPasses) {
  const std::vector<std::string> scenes = {"builtin:spheres", "builtin:materials"};
  std::vector<std::string> folders;
  for (const char* preset : {"ue4-2020", "karis2014"}) {
    folders.push_back(path(preset));
    ASSERT_TRUE(isReported(report(preset, scenes, {"--mobile-preset", preset})));
  }
  for (const char* preset : {"ue4-2020", "karis2014"})
    expectUnchangedRunPasses(scenes, folders, {"--mobile-preset", preset});
}

// A mirror by the article's sun is infinite.
TEST_F(SuggestTest, InfinitePixelsAreAcceptedLoudlyAndNoMoreOfThem) {
  GltfFile file = makeQuad();
  file.material()["pbrMetallicRoughness"] = {{"metallicFactor", 1}, {"roughnessFactor", 0}};
  const std::vector<std::string> scenes = {writeGlb(m_folder, file, "mirror"),
                                           "builtin:furnace",
                                           "--mobile-preset",
                                           "karis2014",
                                           "--orbit",
                                           "0,90,0",
                                           "--sun",
                                           "90,0,3"};
  ASSERT_TRUE(exitedWith(2, report("first", scenes)));
  const RunResult suggested = runParity({"budget", "suggest", path("first"), "-o", path("b.toml")});
  EXPECT_TRUE(exitedWith(0, suggested));
  EXPECT_TRUE(contains(suggested.err, "NaN OR INFINITE")) << suggested.err;
  EXPECT_TRUE(contains(readWholeFile(path("b.toml")), "NaN OR INFINITE"));
  const RunResult again = report("again", scenes, {"--budgets", path("b.toml"), "--warn-exit"});
  EXPECT_TRUE(exitedWith(0, again)) << readWholeFile(path("b.toml"));
  EXPECT_TRUE(contains(again.err, "pixels are NaN or infinite")) << again.err;
  EXPECT_TRUE(contains(readWholeFile(m_folder / "again" / "junit.xml"), "<system-out>accepted: "));
  std::string fewer = readWholeFile(path("b.toml"));
  const std::string key = "max_non_finite = ";
  for (std::size_t at = fewer.find(key); at != std::string::npos; at = fewer.find(key, at + 1))
    fewer.replace(at + key.size(), fewer.find('\n', at) - at - key.size(), "1");
  write("b.toml", fewer);
  EXPECT_TRUE(exitedWith(2, report("again", scenes, {"--budgets", path("b.toml")})));
}

TEST_F(SuggestTest, ASceneThatCannotBeLoadedIsAnErrorOfTheSuggestion) {
  const std::vector<std::string> scenes = {"builtin:furnace", write("broken.glb", "none")};
  ASSERT_TRUE(exitedWith(4, report("first", scenes)));
  const RunResult result = runParity({"budget", "suggest", path("first"), "-o", path("b.toml")});
  EXPECT_TRUE(exitedWith(4, result));
  EXPECT_TRUE(contains(result.err, "scene 'broken' could not be compared")) << result.err;
  EXPECT_TRUE(contains(readWholeFile(path("b.toml")), "# AN UNCHANGED RUN IS AN ERROR: scene 'broken'"));
  EXPECT_TRUE(exitedWith(0, report("again", {"builtin:furnace"}, {"--budgets", path("b.toml")})));
}

} // namespace
} // namespace parity::tests
