// The exit code says which kind of outcome it was, never how many (docs/design.md 8a).
#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

// builtin:spheres has 24 materials, most of which the two paths show with a mean FLIP between 0.01 and 0.5. So dark,
// none has pixels that are white in both pictures, of which it would warn.
class ExitCodeTest : public RenderingTest {
protected:
  RunResult diffSpheres(const std::string& limits, const std::vector<std::string>& more = {}) const {
    return runParity(join(
        {{"diff", "builtin:spheres", "--exposure", "-3", "--budgets", writeBudgets(m_folder, limits)}, kSmall, more}));
  }
  std::string writePicture(const std::string& name, int width, int height) const {
    base::writeImage8(m_folder / name, base::Image8(width, height, 3, 128));
    return path(name);
  }
};

TEST_F(ExitCodeTest, Is0WithinBudget) {
  EXPECT_TRUE(exitedWith(0, diffSpheres("warn = 0.999, fail = 0.999")));
  EXPECT_TRUE(exitedWith(0, diffSpheres("warn = 0.999, fail = 0.999", {"--warn-exit"})));
}

TEST_F(ExitCodeTest, Is1ForWarningsOnlyWhereAskedFor) {
  const RunResult silent = diffSpheres("warn = 0.0001, fail = 0.999");
  EXPECT_TRUE(exitedWith(0, silent));
  EXPECT_TRUE(contains(silent.out, "verdict: warn")) << silent.out;
  EXPECT_TRUE(exitedWith(1, diffSpheres("warn = 0.0001, fail = 0.999", {"--warn-exit"})));
}

TEST_F(ExitCodeTest, Is2OverBudgetHoweverManyMaterialsAre) {
  const RunResult many = diffSpheres("fail = 0.0001");
  EXPECT_TRUE(exitedWith(2, many));
  EXPECT_TRUE(contains(many.out, "verdict: fail")) << many.out;
  EXPECT_TRUE(exitedWith(2, diffSpheres("fail = 0.0001", {"--warn-exit"})));
  EXPECT_TRUE(exitedWith(2, diffSpheres("fail = 0.0001", {"--material", "metal 1.0"})));
}

TEST_F(ExitCodeTest, Is3ForImagesOfDifferentSize) {
  const std::string large = writePicture("large.png", 32, 16), small = writePicture("small.png", 16, 16);
  const std::filesystem::path map = m_folder / "map.png";
  expectRefused(runParity({"flip", large, small, "-o", map.string()}), 3, {"small.png", "16x16", "32x16"});
  EXPECT_FALSE(std::filesystem::exists(map));
}

TEST_F(ExitCodeTest, Is4ForWhatCannotBeReadOrWritten) {
  const std::string picture = writePicture("picture.png", 16, 16);
  expectRefused(runParity({"flip", picture, path("none.png")}), 4, {"none.png", "does not exist"});
  expectRefused(runParity({"flip", picture, picture, "-o", picture + "/map.exr"}), 4, {"picture.png"});
  EXPECT_TRUE(exitedWith(4, diffSpheres("fail = 0.999", {"--material", "no such *"})));
}

// Two pictures of nothing but background are alike: that is no pass.
TEST_F(ExitCodeTest, Is4WhereAViewShowsNothing) {
  EXPECT_TRUE(exitedWith(4, diffSpheres("fail = 0.999", {"--orbit", "30,60,3", "--target", "0,500,0"})));
}

TEST_F(ExitCodeTest, Is4WhereNoMaterialWasCompared) {
  const std::filesystem::path budgets = m_folder / "large.toml", folder = m_folder / "out";
  writeFile(budgets,
            "[[material]]\nname = \"*\"\nmin_pixels = 100000\nchecks = [ { metric = \"flip.mean\", fail = 0.9 } ]\n");
  const RunResult result = runParity(
      join({{"report", "builtin:spheres", "--budgets", budgets.string(), "-o", folder.string(), "-q"}, kSmall}));
  EXPECT_TRUE(exitedWith(4, result));
  EXPECT_EQ(result.err, "error: no material was compared: 24 too small\n");
  EXPECT_EQ(readReport(folder)["problems"][0]["reason"], "no material was compared: 24 too small");
  EXPECT_TRUE(
      contains(readWholeFile(folder / "junit.xml"), "<error type=\"error\" message=\"no material was compared"));
}

TEST_F(ExitCodeTest, Is2WhereAnAssetHasLostAMaterialThatHasToBeSeen) {
  const std::filesystem::path budgets = m_folder / "hero.toml", folder = m_folder / "out";
  writeFile(budgets,
            "[[material]]\nname = \"Hero\"\nrequire_seen = true\npreset = \"strict\"\n"
            "[[material]]\nname = \"*\"\nmin_pixels = 1\nchecks = [ { metric = \"flip.mean\", fail = 0.999 } ]\n"
            "[[whole]]\nchecks = [ { metric = \"flip.mean\", fail = 0.999 } ]\n");
  const auto report = [&](const std::vector<std::string>& more) {
    return runParity(join(
        {{"report", "builtin:spheres", "--exposure", "-3", "--budgets", budgets.string(), "-o", folder.string(), "-q"},
         kSmall,
         more}));
  };
  const RunResult lost = report({});
  EXPECT_TRUE(exitedWith(2, lost));
  EXPECT_TRUE(contains(lost.err, "hero.toml, line 1: require_seen requires material 'Hero'")) << lost.err;
  EXPECT_TRUE(contains(readWholeFile(folder / "junit.xml"), "require_seen requires material &#39;Hero&#39;"));
  // The same rule without it only judges nothing: a warning of the run.
  writeFile(budgets,
            "[[material]]\nname = \"Hero\"\npreset = \"strict\"\n"
            "[[material]]\nname = \"*\"\nmin_pixels = 1\nchecks = [ { metric = \"flip.mean\", fail = 0.999 } ]\n"
            "[[whole]]\nchecks = [ { metric = \"flip.mean\", fail = 0.999 } ]\n");
  EXPECT_TRUE(exitedWith(0, report({})));
  const RunResult warned = report({"--warn-exit"});
  EXPECT_TRUE(exitedWith(1, warned));
  ASSERT_EQ(linesOf(warned.err).size(), 1u) << warned.err;
  EXPECT_TRUE(warned.err.starts_with("warning: hero.toml: a rule judges nothing")) << warned.err;
  EXPECT_TRUE(contains(readWholeFile(folder / "junit.xml"),
                       "<failure type=\"warning\" message=\"hero.toml: a rule judges nothing"));
}

// The highest that applies wins.
TEST_F(ExitCodeTest, Is4WhereOneSceneIsOverBudgetAndAnotherFailed) {
  const RunResult result = runParity(join({{"report", "builtin:furnace", "builtin:nothing", "--budgets",
                                            writeBudgets(m_folder, "fail = 0.0"), "-o", path("out")},
                                           kSmall}));
  EXPECT_TRUE(exitedWith(4, result));
  EXPECT_EQ(readReport(m_folder / "out")["scenes"][0]["verdict"], "fail");
}

// The rows of usage_test.cpp try the parser alone.
TEST(WrongCommandLine, Exits64WithTheReasonOnStderrAndWritesNothing) {
  const TempFolder folder;
  RunOptions options;
  options.workingFolder = folder.path();
  const std::pair<std::vector<std::string>, std::string> rows[] = {
      {{}, "subcommand"},
      {{"diff", "builtin:furnace", "--colour"}, "--colour"},
      {{"report", "builtin:furnace", "-o", "out", "--size", "0x10"}, "--size"},
      {{"flip", "a.png", "b.png", "-o", "map.tga"}, "map.tga"},
      {{"render", "builtin:furnace", "-o", "o.png", "--path", "mobile", "--terms"}, "--terms"},
      {{"render", "builtin:furnace", "--path", "highend", "-o", "o.exr", "--term", "NoL"}, "path mobile"}};
  for (const auto& [arguments, part] : rows) {
    const RunResult result = runParity(arguments, options);
    EXPECT_TRUE(exitedWith(64, result));
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(contains(result.err, part)) << part << " in: " << result.err;
    EXPECT_LE(linesOf(result.err).size(), 2u) << "a reason and where to find help: " << result.err;
    EXPECT_EQ(listFiles(folder.path()), std::vector<std::string>());
  }
}

class UnknownNameTest : public RenderingTest {};

// Names that only the scene can tell from wrong ones.
TEST_F(UnknownNameTest, CameraOrGlobThatTheSceneDoesNotKnowIsSaidWithTheKnownOnes) {
  const std::string output = path("out.exr");
  const std::vector<std::string> render = {"render", "builtin:furnace", "--path", "mobile", "-o", output};
  expectRefused(runParity(join({render, {"--camera", "left"}, kSmall})), 64, {"left", "default"});
  expectRefused(runParity(join({render, {"--fully-rough", "rock*"}, kSmall})), 64, {"rock*", "no material"});
  EXPECT_FALSE(std::filesystem::exists(output));
}

} // namespace
} // namespace parity::tests
