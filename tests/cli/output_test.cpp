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
  expected = join({expected, listPixelFiles(readReport(folder)), reportFiles()});
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(listFiles(folder), expected);
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
      join({listPictures(report), listPixelFiles(report), reportFiles(), {"notes.txt", "images/mine.png"}});
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(listFiles(folder), expected) << "pictures of the older report are left";
}

TEST_F(OutputTest, ScenesOfOneNameAreKeptApart) {
  std::vector<std::string> command =
      join({{"report", "--budgets", writeBudgets(m_folder, "fail = 0.999"), "-o", (m_folder / "out").string()},
            kSun,
            kSmall});
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
  expectRefused(reportInto(m_folder / "out", "builtin:furnace"), 4, {"out", "cannot be made a folder"});
  expectRefused(reportInto(m_folder / "out" / "deeper", "builtin:furnace"), 4, {"out"});
  EXPECT_EQ(readWholeFile(m_folder / "out"), "in the way");
}

TEST_F(OutputTest, FileInTheWayOfAPictureIsSaid) {
  writeFile(m_folder / "file", std::string("in the way"));
  const std::vector<std::string> render = {"render", "builtin:furnace", "--path", "mobile", "-o"};
  expectRefused(runParity(join({render, {(m_folder / "file" / "out.exr").string()}, kSmall})), 4, {"file"});
  std::filesystem::create_directory(m_folder / "folder.exr");
  expectRefused(runParity(join({render, {(m_folder / "folder.exr").string()}, kSmall})), 4, {"folder.exr"});
  EXPECT_EQ(listFiles(m_folder.path()), std::vector<std::string>{"file"});
}

} // namespace
} // namespace parity::tests
