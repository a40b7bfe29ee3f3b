// Where results go: an old report is replaced, and what stands in the way is an error.
#include <algorithm>

#include "cli/checks.h"

namespace parity::tests {
namespace {

class OutputTest : public RenderingTest {
protected:
  RunResult reportInto(const std::filesystem::path& folder, const std::string& scene) const {
    return runParity(join({{"report", scene, "-o", folder.string()}, kSmall}));
  }
};

TEST_F(OutputTest, ReportHoldsWhatItNamesAndNothingElse) {
  const std::filesystem::path folder = m_folder / "deep" / "out";
  EXPECT_NE(reportInto(folder, "builtin:furnace").exitCode, 4);
  std::vector<std::string> expected = listPictures(readReport(folder));
  EXPECT_EQ(expected.size(), 3u * (1 + 11)) << "of the view and of each material";
  expected = join({expected, listPixelFiles(readReport(folder)), reportFiles(1)});
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(listFiles(folder), expected);
}

TEST_F(OutputTest, TableOfManyMaterialsShowsThoseThatPassWhereItIsAskedTo) {
  const RunResult some = runParity(join({{"diff", "builtin:spheres"}, kSmall}));
  const RunResult all = runParity(join({{"diff", "builtin:spheres", "--all"}, kSmall}));
  EXPECT_TRUE(contains(some.out, "--all shows")) << some.out;
  EXPECT_FALSE(contains(all.out, "--all shows")) << all.out;
  EXPECT_GT(linesOf(all.out).size(), linesOf(some.out).size());
}

TEST_F(OutputTest, ReportReplacesAnOlderOneAndSparesWhatIsNotItsOwn) {
  const std::filesystem::path folder = m_folder / "out";
  EXPECT_NE(reportInto(folder, "builtin:spheres").exitCode, 4);
  writeFile(folder / "notes.txt", std::string("mine"));
  writeFile(folder / "images" / "mine.png", std::string("mine"));
  EXPECT_NE(reportInto(folder, "builtin:furnace").exitCode, 4);

  const nlohmann::json report = readReport(folder);
  EXPECT_EQ(report["scenes"][0]["name"], "furnace");
  std::vector<std::string> expected =
      join({listPictures(report), listPixelFiles(report), reportFiles(1), {"notes.txt", "images/mine.png"}});
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(listFiles(folder), expected) << "pictures of the older report are left";
}

TEST_F(OutputTest, ScenesOfOneNameAreKeptApart) {
  std::vector<std::string> command =
      join({{"report", "--budgets", writeBudgets(m_folder, "fail = 0.999"), "-o", path("out")}, kSun, kSmall});
  for (const char* folder : {"a", "b"}) {
    std::filesystem::create_directory(m_folder / folder);
    command.push_back(writeGlb(m_folder, makeQuad(), std::string(folder) + "/quad"));
  }
  EXPECT_TRUE(exitedWith(0, runParity(command)));
  const nlohmann::json report = readReport(m_folder / "out");
  EXPECT_EQ(report["scenes"][0]["name"], "quad");
  EXPECT_EQ(report["scenes"][1]["name"], "quad (2)");
  EXPECT_EQ(listPictures(report).size(), 2u * 3 * (1 + 1));
}

TEST_F(OutputTest, FileInTheWayOfTheReportIsSaidBeforeAnythingIsRendered) {
  writeFile(m_folder / "out", std::string("in the way"));
  expectRefused(reportInto(m_folder / "out", "builtin:furnace"), 4, {"out", "cannot be created as a folder"});
  expectRefused(reportInto(m_folder / "out" / "deeper", "builtin:furnace"), 4, {"out"});
  EXPECT_EQ(readWholeFile(m_folder / "out"), "in the way");
}

TEST_F(OutputTest, FileInTheWayOfAPictureIsSaid) {
  writeFile(m_folder / "file", std::string("in the way"));
  const std::vector<std::string> render = {"render", "builtin:furnace", "--path", "mobile", "-o"};
  expectRefused(runParity(join({render, {path("file/out.exr")}, kSmall})), 4, {"file"});
  std::filesystem::create_directory(m_folder / "folder.exr");
  expectRefused(runParity(join({render, {path("folder.exr")}, kSmall})), 4, {"folder.exr"});
  EXPECT_EQ(listFiles(m_folder.path()), std::vector<std::string>{"file"});
}

TEST_F(OutputTest, WhatAKilledRunLeftInAReportsFolderTheNextOneRemoves) {
  const std::filesystem::path folder = m_folder / "out";
  const std::vector<std::string> left = {".report.4711-0.json", "images/.0-furnace_0-auto_flip.4711-3.png",
                                         "images/.0-furnace_0-auto_m2_highend.4711-12.png",
                                         "pixels/.0-furnace_0-auto.4711-7.js"},
                                 others = {".gitignore", ".notes.4711-0.md", "images/.own.png",
                                           "images/.0-furnace_0-auto_flip.png"};
  for (const auto& files : {left, others})
    for (const std::string& file : files) {
      std::filesystem::create_directories((folder / file).parent_path());
      writeFile(folder / file, "x");
    }
  ASSERT_NE(runParity(join({{"report", "builtin:furnace", "-o", folder.string()}, kSmall})).exitCode, 4);
  for (const std::string& file : left) EXPECT_FALSE(std::filesystem::exists(folder / file)) << file;
  for (const std::string& file : others) EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
}

TEST_F(OutputTest, AnInterruptedRenderSaysThatNothingWasWritten) {
  RunOptions options;
  options.terminal = true; // where progress is shown
  options.interruptAt = "loading";
  const RunResult rendered =
      runParity(join({{"render", "builtin:spheres", "--path", "truth", "-o", path("a.exr")}, kSmall}), options);
  if (rendered.signal == options.interruptBy) { // else it was faster
    EXPECT_TRUE(contains(rendered.err, "error: render: interrupted: no output was written")) << rendered.err;
  }
}

} // namespace
} // namespace parity::tests
