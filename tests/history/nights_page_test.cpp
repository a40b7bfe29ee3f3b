// The data of the page of nights.
#include <nlohmann/json.hpp>

#include "history/history_folder.h"
#include "history/nights_page.h"
#include "history/synthetic_nights.h"
#include "history/worst_rows.h"

namespace parity::tests {
namespace {

using compare::Verdict;
using nlohmann::json;

class NightsPageTest : public HistoryTest {
protected:
  void addNights(int count) {
    history::Store store = writer();
    for (int i = 0; i < count; ++i) m_records.push_back(m_nights.next()), store.add(m_records.back());
  }
  json page(std::size_t last = 0) const { return json::parse(history::nightsPageJson(reader().index(), {}, last)); }
  Nights m_nights{{}};
  std::vector<history::RunRecord> m_records;
};

// Of the record itself.
history::WorstRow worstOf(const history::RunRecord& record) {
  history::WorstRow worst;
  double sum = 0;
  std::size_t count = 0;
  for (const history::SceneRecord& scene : record.scenes)
    for (const history::ViewRecord& view : scene.views)
      for (history::RowRecord row : view.materials) {
        const double value = figureOf(row, "flip.mean");
        sum += value, ++count;
        if (value > worst.value) worst = {scene.name + "/" + view.name + "/" + row.name, value, 0};
      }
  worst.mean = sum / static_cast<double>(count);
  return worst;
}

TEST_F(NightsPageTest, WorstAndMeanAreThoseOfEachRun) {
  for (const char* cause : {"asset", "settings", "build", "request", "numerics"}) { // two begin lanes of their own
    addNights(1);
    m_nights.plant(cause, m_records.size() % 3, 4);
  }
  addNights(2);
  const json all = page();
  ASSERT_EQ(all["runs"].size(), m_records.size());
  for (std::size_t i = 0; i < m_records.size(); ++i) {
    const history::WorstRow expected = worstOf(m_records[i]);
    EXPECT_EQ(all["runs"][i]["worst"]["row"], expected.row) << i;
    EXPECT_EQ(all["runs"][i]["worst"]["flip"], expected.value) << i;
    EXPECT_NEAR(all["runs"][i]["meanFlip"].get<double>(), expected.mean, 1e-12) << i;
  }
}

TEST_F(NightsPageTest, ARunHasItsChangesAndARowItsTrend) {
  addNights(2);
  const Planted planted = m_nights.plant("asset", 1, 1).at(0);
  m_nights.state().scenes[1].views[0].materials[0].verdict = Verdict::fail;
  addNights(1);
  const json all = page();
  EXPECT_EQ(all["suite"], "nightly");
  EXPECT_EQ(all["branch"], "main");
  const json& night = all["runs"][2];
  EXPECT_EQ(night["events"], json::parse(R"({"regressed":1})"));
  EXPECT_EQ(night["failed"], 1);
  ASSERT_EQ(night["changes"].size(), 1u);
  EXPECT_EQ(night["changes"][0]["row"], planted.subject);
  EXPECT_EQ(night["changes"][0]["cause"], "asset");
  EXPECT_EQ(night["changes"][0]["after"], planted.now);
  EXPECT_TRUE(all["runs"][0]["isFirst"].get<bool>());
  EXPECT_EQ(all["runs"][0]["changes"], json::array());
  ASSERT_EQ(all["rows"].size(), 1u) << "one row changed";
  const json& row = all["rows"][planted.subject];
  EXPECT_EQ(row["figures"]["flip.mean"], json({{0, 1, planted.before}, {2, 2, planted.now}}));
  EXPECT_EQ(row["verdicts"], json::parse(R"([[0,1,"pass"],[2,2,"fail"]])"));
  const json newest = page(2); // of the newest two
  EXPECT_EQ(newest["runs"].size(), 2u);
  EXPECT_EQ(newest["rows"][planted.subject]["figures"]["flip.mean"],
            json({{0, 0, planted.before}, {1, 1, planted.now}}));
  EXPECT_EQ(newest["rows"][planted.subject]["changes"][0]["run"], 1);
  const history::RunRecord main = m_nights.state();
  m_nights.state().branch = "feature";
  addNights(1);
  m_nights.plant("asset", 2, 1);
  addNights(1);
  m_nights.state() = main;
  addNights(1);
  const json rows = page()["rows"];
  EXPECT_EQ(rows.size(), 1u) << "what changed on another branch alone is no row: " << rows.dump(1);
}

TEST_F(NightsPageTest, TimesAreThoseOfScenesThatTheCacheDidNotHave) {
  m_nights.state().scenes[0].isCached = true;
  addNights(1);
  double cpu = 0;
  for (const history::SceneRecord& scene : m_records[0].scenes) cpu += scene.isCached ? 0 : scene.cpuS;
  const json night = page()["runs"][0];
  EXPECT_NEAR(night["cpuS"].get<double>(), cpu, 1e-9);
  EXPECT_EQ(night["scenes"], 8);
  EXPECT_EQ(night["cachedScenes"], 1);
  EXPECT_EQ(night["machine"], "a processor");
}

TEST_F(NightsPageTest, AHistoryWithoutRunsHasAPage) {
  { const history::Store store = writer(); }
  EXPECT_EQ(page()["runs"], json::array());
}

} // namespace
} // namespace parity::tests
