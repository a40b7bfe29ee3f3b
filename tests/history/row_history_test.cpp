// What a history says of the rows of the next report.
#include "history/history_folder.h"
#include "history/night_report.h"
#include "history/row_history.h"

namespace parity::tests {
namespace {

using compare::Verdict, report::Standing;

class RowHistoryTest : public HistoryTest {
protected:
  history::RowRecord& row(std::size_t material) { return m_nights.state().scenes[0].views[0].materials[material]; }
  report::RowStanding standing(std::size_t material, const std::string& started = "2027-01-01T00:00:00Z") {
    const report::Report report = reportOf(m_nights.state());
    const history::Store store = reader();
    const report::ViewResult& view = report.scenes[0].views[0];
    return history::RowHistory(store.index(), history::runsBefore(store.index(), report.suite, started))
        .of(report.scenes[0], view, &view.materials[material]);
  }
  void addNights(int count) {
    history::Store store = writer();
    for (int i = 0; i < count; ++i) store.add(m_nights.next());
  }
  Nights m_nights{{}};
};

TEST_F(RowHistoryTest, CountsTheNightsForWhichARowFails) {
  row(1).verdict = Verdict::fail; // before the gap
  addNights(2);
  row(1).verdict = Verdict::pass;
  addNights(1);
  row(0).verdict = row(1).verdict = Verdict::fail;
  addNights(3);
  row(0).reason = "another", row(0).rule = "another rule"; // of the same failure
  m_nights.state().settings = std::string(12, 'e');        // another lane
  addNights(2);
  row(2).verdict = Verdict::fail; // tonight
  EXPECT_EQ(standing(0).standing, Standing::still);
  EXPECT_EQ(standing(0).nights, 6u) << "five, and this one";
  EXPECT_EQ(standing(0).owner, "lighting");
  EXPECT_EQ(standing(1).nights, 6u) << "not those before it passed";
  EXPECT_EQ(standing(2).standing, Standing::isNew);
  EXPECT_EQ(standing(2).nights, 1u);
  row(0).verdict = Verdict::pass;
  EXPECT_EQ(standing(0).standing, Standing::fixed);
  row(0).verdict = Verdict::notSeen;
  EXPECT_EQ(standing(0).standing, Standing::none) << "what is not seen is not fixed";
  EXPECT_EQ(standing(1, "2026-01-05T03:00:00Z").nights, 2u) << "runs since that one do not count";
}

TEST_F(RowHistoryTest, ARowWithAnAlarmIsFlakyWhileItFails) {
  addNights(2);
  const std::vector<Planted> planted = m_nights.plant("", 0, 1); // a figure changes, and nothing that decides it
  addNights(1);
  for (std::size_t m = 0; m < 3; ++m) row(m).verdict = Verdict::fail;
  for (std::size_t m = 0; m < 3; ++m)
    EXPECT_EQ(standing(m).standing == Standing::flaky,
              planted.at(0).subject == "scene 000/view 0/material " + std::to_string(m))
        << planted.at(0).subject << ", " << m;
  history::RunRecord& state = m_nights.state();
  state.incidents = {state.scenes[0].name + ": flaky crash: a worker crashed"};
  addNights(1);
  state.incidents.clear();
  EXPECT_EQ(standing(0).standing, Standing::flaky) << "its scene crashed";
  row(0).verdict = Verdict::pass;
  EXPECT_EQ(standing(0).standing, Standing::fixed);
  addNights(14);
  row(0).verdict = Verdict::fail;
  EXPECT_EQ(standing(0).standing, Standing::isNew) << "that was too long ago";
}

TEST_F(RowHistoryTest, AnAlarmOfAnotherBranchIsNone) {
  history::RunRecord& state = m_nights.state();
  const std::string branch = state.branch;
  addNights(1);
  state.branch = "feature", state.incidents = {state.scenes[0].name + ": flaky crash: a worker crashed"};
  addNights(1);
  state.branch = branch, state.incidents.clear();
  addNights(1);
  row(0).verdict = Verdict::fail;
  EXPECT_EQ(standing(0).standing, Standing::isNew);
}

TEST_F(RowHistoryTest, WithoutARunOfTheSuiteTheBaselineDecides) {
  addNights(1);
  row(0).verdict = Verdict::fail;
  m_nights.state().suite = "another";
  EXPECT_EQ(standing(0).standing, Standing::unknown);
}

} // namespace
} // namespace parity::tests
