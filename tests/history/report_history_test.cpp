// What a report's page is told of a history: the runs, each row over them, and pictures of approved states.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/hash.h"
#include "history/history_folder.h"
#include "history/night_report.h"
#include "history/pictures.h"
#include "history/report_history.h"

namespace parity::tests {
namespace {

using compare::Verdict;
using nlohmann::json;

class ReportHistoryTest : public HistoryTest {
protected:
  history::RowRecord& row(std::size_t material) { return m_nights.state().scenes[0].views[0].materials[material]; }
  void addNights(int count) {
    history::Store store = writer();
    for (int i = 0; i < count; ++i) store.add(m_nights.next());
  }
  history::ReportHistory history(const report::Report& report,
                                 const std::string& started = "2027-01-01T00:00:00Z") const {
    return {folder(), report, started};
  }
  json trendOf(std::size_t material, const std::string& started = "2027-01-01T00:00:00Z") {
    const report::Report report = reportOf(m_nights.state());
    return json::parse(history(report, started).trendsJson(report.scenes[0]))["views"][0][material];
  }
  // Three pictures in the history, named by what they are of.
  history::PictureHashes picturesOf(const std::string& what) const {
    history::PictureHashes hashes;
    for (std::string* hash : {&hashes.reference, &hashes.test, &hashes.flip}) {
      const std::string bytes = fmt::format("{} {}", what, hash - &hashes.reference);
      *hash = base::Hasher().addValue(std::hash<std::string>()(bytes)).hex();
      std::filesystem::create_directories(history::pictureFile(folder(), *hash).parent_path());
      base::writeText(history::pictureFile(folder(), *hash), bytes);
    }
    return hashes;
  }
  Nights m_nights{{}};
};

TEST_F(ReportHistoryTest, ARowIsShownOverTheRunsWithItsChanges) {
  addNights(2);
  const Planted asset = m_nights.plant("asset", 0, 1).at(0);
  row(0).verdict = Verdict::fail;
  addNights(3);
  const json trend = trendOf(0);
  EXPECT_EQ(trend["figures"]["flip.mean"], json::parse(fmt::format("[[0,1,{}],[2,4,{}]]", asset.before, asset.now)));
  EXPECT_EQ(trend["verdicts"], json::parse(R"([[0,1,"pass"],[2,4,"fail"]])"));
  ASSERT_EQ(trend["changes"].size(), 1u);
  EXPECT_EQ(trend["changes"][0], json::parse(fmt::format(R"({{"run":2,"kind":"regressed","cause":"asset",
    "metric":"flip.mean","before":{},"after":{},"figures":10}})",
                                                         asset.before, asset.now)));
  EXPECT_EQ(trendOf(1)["changes"], json::array());
  EXPECT_FALSE(trend.contains("approved"));
  const json early = trendOf(0, "2026-01-02T04:00:00Z"); // as if the report was the third night
  EXPECT_EQ(early["figures"]["flip.mean"], json::parse(fmt::format("[[0,1,{}]]", asset.before)));
  EXPECT_EQ(early["changes"], json::array());
}

TEST_F(ReportHistoryTest, RunsOfTheSuiteAndItsBranchAreNamedOldestFirst) {
  addNights(2);
  m_nights.state().suite = "another";
  addNights(1);
  m_nights.state().suite = "nightly";
  addNights(1);
  const report::Report report = reportOf(m_nights.state());
  const json runs = json::parse(history(report).runsJson());
  EXPECT_EQ(runs["suite"], "nightly");
  EXPECT_EQ(runs["branch"], "main");
  ASSERT_EQ(runs["runs"].size(), 3u);
  EXPECT_EQ(runs["runs"][0]["started"], "2026-01-01T03:00:00Z");
  EXPECT_EQ(runs["runs"][2]["started"], "2026-01-04T03:00:00Z");
  EXPECT_EQ(runs["runs"][2]["commit"].get<std::string>().size(), 40u);
}

TEST_F(ReportHistoryTest, WhatNoRunHasIsNull) {
  addNights(1);
  m_nights.state().scenes[0].views[0].materials[1].name = "fresh";
  EXPECT_TRUE(trendOf(1).is_null());
  EXPECT_FALSE(trendOf(0).is_null());
  m_nights.state().suite = "another";
  const report::Report report = reportOf(m_nights.state());
  EXPECT_FALSE(history(report).knowsAny());
}

TEST_F(ReportHistoryTest, PicturesOfTheApprovedStateAreFoundAndKeptByGc) {
  { history::Store store = writer(); } // the folder
  row(0).verdict = Verdict::fail;
  addNights(1);
  m_nights.plant("asset", 0, 1);
  row(0).pictures = picturesOf("approved");
  const double approved = figureOf(row(0), "flip.mean");
  addNights(1);
  m_nights.plant("asset", 0, 1); // of the same verdict, so its pictures are neither the first nor the last of it
  row(0).pictures = picturesOf("later");
  addNights(2);
  report::Report report = reportOf(m_nights.state());
  compare::CheckResult check;
  check.metric = "flip.mean";
  check.approval.emplace();
  check.approval->value = approved;
  report.scenes[0].views[0].materials[0].checks = {check};
  const auto before = history(report);
  const json trend = json::parse(before.trendsJson(report.scenes[0]))["views"][0][0];
  ASSERT_TRUE(trend.contains("approved")) << trend;
  EXPECT_EQ(trend["approved"]["run"], 1);
  const auto pictures = before.approvedPictures();
  ASSERT_EQ(pictures.size(), 3u);
  std::set<std::string> texts;
  for (const report::ApprovedPicture& each : pictures) texts.insert(base::readText(each.source, 100));
  EXPECT_EQ(texts, (std::set<std::string>{"approved 0", "approved 1", "approved 2"}));
  EXPECT_EQ(trend["approved"]["images"]["test"].get<std::string>().rfind("approved/", 0), 0u);

  compare::Approvals approvals;
  compare::Approval& entry = approvals.entries.emplace_back();
  entry.scene = "scene 000", entry.view = "view 0", entry.material = "material 0";
  entry.metric = "flip.mean", entry.value = approved;
  const history::Store store(folder(), history::Store::For::collecting);
  const auto collect = [&](const compare::Approvals& kept) {
    return history::collectPictures(store.index(), folder(), "2027-01-01T00:00:00Z", kept, true);
  };
  EXPECT_EQ(collect(approvals).removed, 0u);
  EXPECT_EQ(collect({}).removed, 3u) << "nothing else needs them";
}

// Two materials of one name: an approval is of both.
TEST_F(ReportHistoryTest, CollectingKeepsTheApprovedPicturesOfEveryNamesake) {
  row(1).name = row(0).name;
  addNights(1);
  m_nights.plant("asset", 0, 1);
  figureOf(row(1), "flip.mean") = 0.1234;
  row(1).pictures = picturesOf("approved");
  addNights(1);
  m_nights.plant("asset", 0, 1);
  figureOf(row(1), "flip.mean") = 0.2345;
  row(1).pictures = picturesOf("later");
  addNights(2);
  compare::Approvals approvals;
  compare::Approval& entry = approvals.entries.emplace_back();
  entry.scene = "scene 000", entry.view = "view 0", entry.material = row(0).name;
  entry.metric = "flip.mean", entry.value = 0.1234;
  const history::Store store(folder(), history::Store::For::collecting);
  const auto collect = [&](const compare::Approvals& kept) {
    return history::collectPictures(store.index(), folder(), "2027-01-01T00:00:00Z", kept, true).removed;
  };
  EXPECT_EQ(collect({}), 3u);
  EXPECT_EQ(collect(approvals), 0u);
}

} // namespace
} // namespace parity::tests
