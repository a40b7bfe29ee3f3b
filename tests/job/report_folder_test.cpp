// The folder of a report: a second report leaves nothing of the first, and nothing goes that no report has written.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/temp_folder.h"
#include "job/report_folder.h"
#include "report/dashboard_files.h"

namespace parity::job {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> filesIn(const fs::path& folder) {
  std::vector<std::string> files;
  if (fs::exists(folder))
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(folder).generic_string());
  std::ranges::sort(files);
  return files;
}

report::Report reportOf(std::size_t scenes) {
  report::Report report;
  for (std::size_t i = 0; i < scenes; ++i) {
    report.scenes.emplace_back().name = "scene";
    report.scenes.back().error = "is no scene";
  }
  report::settleVerdicts(report);
  return report;
}

void write(const fs::path& folder, std::size_t scenes, bool singleFile) {
  prepareReportFolder(folder, singleFile);
  const report::Bench none;
  writeReport(folder, reportOf(scenes), {}, {none, singleFile, {}});
}

TEST(ReportFolder, HasAFileForEachScene) {
  if (!report::hasDashboard()) GTEST_SKIP() << "this build has no page";
  const base::TempFolder folder;
  write(folder.path(), 11, false);
  EXPECT_EQ(filesIn(folder / "scenes").size(), 11u);
  EXPECT_TRUE(base::readText(folder / "scenes" / "10.js").starts_with("parityScene({\"file\":\"scenes/10.js\","));
}

TEST(ReportFolder, OfAnOlderReportHasNoScenesLeft) {
  if (!report::hasDashboard()) GTEST_SKIP() << "this build has no page";
  const base::TempFolder folder;
  write(folder.path(), 3, false);
  write(folder.path(), 1, false);
  EXPECT_EQ(filesIn(folder / "scenes"), std::vector<std::string>{"0.js"});
  write(folder.path(), 1, true);
  EXPECT_FALSE(fs::exists(folder / "scenes"));
  EXPECT_EQ(filesIn(folder.path()), (std::vector<std::string>{"index.html", "junit.xml", "report.json", "run.json"}));
}

TEST(ReportFolder, KeepsWhatNoReportHasWritten) {
  const base::TempFolder folder;
  const std::vector<std::string> others = {"scenes/.js", "scenes/1.json", "scenes/1a.js", "scenes/list.js"};
  for (const std::string& file : others) base::writeText(folder / file, "mine");
  base::writeText(folder / "scenes/7.js", "");
  prepareReportFolder(folder.path(), false);
  EXPECT_EQ(filesIn(folder.path()), others);
}

} // namespace
} // namespace parity::job
