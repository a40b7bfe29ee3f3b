// Several scenes, environments and pairs at once: from standard input, from the command line; and the table of them as
// CSV.
#include <algorithm>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

class ListsTest : public RenderingTest {
protected:
  RunResult runHere(const std::vector<std::string>& arguments, const std::string& input = "") const {
    RunOptions options;
    options.workingFolder = m_folder.path();
    options.input = input;
    return runParity(arguments, options);
  }
  std::vector<std::string> sceneNames() const {
    std::vector<std::string> names;
    const nlohmann::json report = readReport(m_folder / "parity-report");
    for (const auto& scene : report["scenes"]) names.push_back(scene["name"]);
    return names;
  }
};

using Words = std::vector<std::string>;

TEST_F(ListsTest, ScenesOfAReportAreReadFromStandardInput) {
  const std::string list = "# scenes\n\n  builtin:furnace\r\nbuiltin:lights";
  EXPECT_TRUE(isReported(runHere(join({{"report", "-"}, kSmall}), list)));
  EXPECT_EQ(sceneNames(), (Words{"furnace", "lights"}));
  EXPECT_TRUE(isReported(runHere(join({{"report", "builtin:spheres", "-"}, kSmall}), "builtin:furnace\n")));
  EXPECT_EQ(sceneNames(), (Words{"spheres", "furnace"})) << "the list stands where - does";
  expectRefused(runHere({"report", "-"}, "# nothing\n\n"), 4, {"stdin", "names no scene"});
  expectRefused(runHere({"report", "-", "-"}, "builtin:furnace\n"), 64, {"give it once"});
  expectRefused(runHere({"bench", "-"}, ""), 4, {"stdin", "names no scene"});
  expectRefused(runHere({"bake", "-"}, ""), 4, {"stdin", "names no scene"});
  expectRefused(runHere({"budget", "suggest", "-"}, ""), 4, {"stdin", "names no report"});
}

TEST_F(ListsTest, PairsAndReportsAreReadFromStandardInput) {
  const base::Image image(8, 8, 3);
  base::writeImage(m_folder / "a.exr", image);
  base::writeImage(m_folder / "b c.exr", image);
  const RunResult flip = runHere({"flip", "--pairs", "-", "--csv", "-"}, "a.exr \"b c.exr\"\na.exr a.exr\n");
  EXPECT_TRUE(exitedWith(0, flip));
  EXPECT_EQ(linesOf(flip.out).size(), 3u) << flip.out;
  expectRefused(runHere({"flip", "--pairs", "-"}, "a.exr\n"), 4, {"stdin: line 1", "has 1 path"});
  expectRefused(runHere({"flip", "--pairs", "-"}, ""), 4, {"stdin", "has no pairs"});

  ASSERT_TRUE(isReported(runHere(join({{"report", "builtin:spheres"}, kSun, kSmall}))));
  const RunResult suggest = runHere({"budget", "suggest", "-"}, "parity-report\n");
  EXPECT_TRUE(exitedWith(0, suggest));
  EXPECT_EQ(suggest.out, runHere({"budget", "suggest", "parity-report"}).out);
}

TEST_F(ListsTest, AMistypedSceneDoesNotReplaceTheReportOfTheDefaultFolder) {
  ASSERT_TRUE(isReported(runHere(join({{"report", "builtin:spheres"}, kSun, kSmall}))));
  const std::string before = readWholeFile(m_folder / "parity-report" / "report.json");
  expectRefused(runHere({"report", "typo.glb"}), 4, {"typo.glb", "does not exist", "parity-report", "stays"});
  EXPECT_EQ(readWholeFile(m_folder / "parity-report" / "report.json"), before);
  // A folder that was asked for tells a CI server what was missing.
  EXPECT_TRUE(exitedWith(4, runHere({"report", "typo.glb", "-o", "nightly"})));
  EXPECT_TRUE(contains(readWholeFile(m_folder / "nightly" / "junit.xml"), "does not exist"));
  // Beside a scene that is there, one that is missing is an error of the report.
  EXPECT_TRUE(exitedWith(4, runHere(join({{"report", "builtin:spheres", "typo.glb"}, kSun, kSmall}))));
  EXPECT_EQ(readReport(m_folder / "parity-report")["scenes"].size(), 2u);
}

TEST_F(ListsTest, EachSceneIsComparedInEachEnvironment) {
  const Words quick = {"--prefilter-size", "64", "--prefilter-samples", "8"};
  const Words lit = {"--env", "builtin:white", "--env", "builtin:night"};
  ASSERT_TRUE(isReported(runHere(join({{"report"}, lit, {"builtin:furnace", "builtin:spheres"}, quick, kSmall}))));
  EXPECT_EQ(sceneNames(), (Words{"furnace, white", "furnace, night", "spheres, white", "spheres, night"}));
  const nlohmann::json report = readReport(m_folder / "parity-report");
  EXPECT_EQ(report["scenes"][0]["environment"], "builtin:white");
  EXPECT_EQ(report["scenes"][1]["environment"], "builtin:night");
  EXPECT_NE(report["scenes"][0]["views"][0]["whole"], report["scenes"][1]["views"][0]["whole"]) << "another light";
  const RunResult diff = runHere(join({{"diff", "builtin:furnace"}, lit, quick, kSmall}));
  EXPECT_TRUE(contains(diff.out, "furnace, white")) << diff.out;
  EXPECT_TRUE(contains(diff.out, "furnace, night")) << diff.out;
  ASSERT_TRUE(isReported(runHere(join({{"report", "builtin:furnace", "--env", "builtin:white"}, quick, kSmall}))));
  EXPECT_EQ(sceneNames(), Words{"furnace"}) << "of one environment nothing has to be said";
}

TEST_F(ListsTest, CsvHasALineForEachMaterialOfEachView) {
  const RunResult diff = runHere(join({{"diff", "builtin:spheres", "--csv", "-"}, kSun, kSmall}));
  const std::vector<std::string> lines = linesOf(diff.out);
  ASSERT_GT(lines.size(), 2u) << diff.out;
  EXPECT_TRUE(
      lines[0].starts_with("scene,view,environment,reference,test,kind,material,verdict,pixels,non_finite,flip."))
      << lines[0];
  EXPECT_TRUE(lines[1].starts_with("spheres,auto,")) << lines[1];
  EXPECT_TRUE(contains(lines[1], ",whole,,")) << lines[1];
  for (std::size_t i = 2; i < lines.size(); ++i) EXPECT_TRUE(contains(lines[i], ",material,")) << lines[i];

  ASSERT_TRUE(isReported(runHere(join({{"report", "builtin:spheres", "--csv", "all.csv"}, kSun, kSmall}))));
  EXPECT_EQ(readWholeFile(m_folder / "all.csv"), diff.out) << "the same scene, the same table";
  expectRefused(runHere(join({{"report", "builtin:spheres", "--csv", "parity-report/report.json"}, kSmall})), 64,
                {"--csv"});
}

} // namespace
} // namespace parity::tests
