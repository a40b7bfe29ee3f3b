// Approvals in a report: each rule of their verdicts has a case that passes and one that does not.
#include "report/approvals.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "report/judge.h"
#include "report/sample_report.h"
#include "report/standing.h"

namespace parity::report {
namespace {

using compare::ApprovalState;
using compare::Verdict;

const base::Day kDay = *base::dayFrom("2027-01-01");
base::Day later(int days) { return kDay + std::chrono::days(days); }

// A failing material, one that is well and a whole image that is.
Report makeChromeReport(double mean = 0.25) {
  Report report;
  SceneResult& scene = report.scenes.emplace_back();
  scene.name = "Hero";
  scene.inputs = SceneInputs{"aa", "bb", "cc", "dd"};
  ViewResult& view = scene.views.emplace_back();
  view.name = "front";
  view.whole = makeFigures(0.01, 9000);
  view.materials = {makeMaterial("Chrome", mean, 4000), makeMaterial("Cloth", 0.01, 4000)};
  for (compare::Figure& figure : view.materials[0].figures.values)
    if (figure.name == "flip.p95") figure.value = 0.2; // flip.mean alone is over
  return report;
}

compare::Approvals makeApprovals() {
  compare::Approval entry;
  entry.scene = "Hero", entry.view = "front", entry.material = "Chrome", entry.metric = "flip.mean";
  entry.value = 0.25, entry.slack = 0.01, entry.until = later(100);
  entry.owner = "characters", entry.reason = "refit in sprint 12", entry.line = 4;
  entry.inputs = approvedInputs(makeChromeReport().scenes[0].inputs);
  return {.file = "ci/approvals.toml", .head = {}, .numerics = {}, .entries = {entry}};
}

Report withApprovals(Report report, const compare::Approvals& approvals, base::Day asOf = kDay,
                     EntriesFor entriesFor = EntriesFor::all) {
  for (SceneResult& scene : report.scenes) judgeScene(scene, compare::defaultBudgets());
  applyApprovals(report, approvals, asOf, entriesFor);
  settleVerdicts(report);
  return report;
}
const MaterialResult& chrome(const Report& report) { return report.scenes[0].views[0].materials[0]; }

TEST(Approvals, WhatIsApprovedPassesAndIsShownWithOwnerDateAndReason) {
  EXPECT_EQ(exitCode(withApprovals(makeChromeReport(), {}), true), 2);
  const Report report = withApprovals(makeChromeReport(), makeApprovals());
  EXPECT_EQ(chrome(report).verdict, Verdict::pass);
  EXPECT_EQ(exitCode(report, true), 0);
  EXPECT_EQ(chrome(report).accepted,
            "mean FLIP 0.250 is above 0.200, approved until 2027-04-11 by characters: refit in "
            "sprint 12 (approvals.toml, line 4)");
  EXPECT_EQ(countAccepted(report).materials, 1u);
  EXPECT_NE(toTable(report, {}, {.all = true}).find("accepted: mean FLIP 0.250"), std::string::npos);
  EXPECT_NE(toJunit(report, {}).find("accepted: mean FLIP 0.250"), std::string::npos);
  EXPECT_NE(toJson(report).find("\"asOf\": \"2027-01-01\""), std::string::npos);
  EXPECT_EQ(standingOf(report.scenes[0].views[0], &chrome(report)).standing, Standing::accepted);
  EXPECT_EQ(standingOf(report.scenes[0].views[0], &chrome(report)).owner, "characters");
}

// A little worse each night than the night before, which no comparison with that night would call worse.
TEST(Approvals, CreepIsHeldAgainstTheApprovedValueAndNotAgainstLastNight) {
  std::vector<Verdict> verdicts;
  for (const double mean : {0.25, 0.254, 0.258, 0.262, 0.266})
    verdicts.push_back(chrome(withApprovals(makeChromeReport(mean), makeApprovals())).verdict);
  EXPECT_EQ(verdicts, (std::vector{Verdict::pass, Verdict::pass, Verdict::pass, Verdict::fail, Verdict::fail}))
      << "0.25 and a slack of 0.01";
}

TEST(Approvals, DateIsRecordedOnlyWhereSomethingHasOne) {
  compare::Approvals none = makeApprovals();
  none.entries.clear();
  EXPECT_EQ(toJson(withApprovals(makeChromeReport(), none)), toJson(withApprovals(makeChromeReport(), {})));
  EXPECT_EQ(toJson(withApprovals(makeChromeReport(), makeApprovals())),
            toJson(withApprovals(makeChromeReport(), makeApprovals())));
}

// A change of the entry, the figure or the day, and the verdict that the row then has.
struct Rule {
  const char* name;
  std::function<void(compare::Approval& entry, Report& report, base::Day& day)> change;
  Verdict verdict;
  const char* words; // in reason or accepted
};
#define RULE(statement)                                                                                                \
  [](compare::Approval& e, Report& r, base::Day& d) {                                                                  \
    static_cast<void>(e), static_cast<void>(r), static_cast<void>(d), statement;                                       \
  }
void setMean(Report& report, double mean) {
  setFigure(report.scenes[0].views[0].materials[0].figures, "flip.mean", mean);
}

const std::vector<Rule> kRules = {
    {"up to value and slack", RULE(setMean(r, 0.26)), Verdict::pass, "mean FLIP 0.260"},
    {"beyond", RULE(setMean(r, 0.2601)), Verdict::fail,
     "its approval (approvals.toml, line 4) does not hold: mean FLIP 0.2601 is above 0.2600"},
    {"a little better", RULE(setMean(r, 0.23)), Verdict::pass, "approved"},
    {"far better", RULE(setMean(r, 0.22)), Verdict::warn,
     "tighten its approval: mean FLIP 0.220 is far better than the approved 0.250"},
    {"far better, and within the limits", RULE(setMean(r, 0.05)), Verdict::warn, "tighten its approval"},
    {"15 days left", RULE(d = e.until - std::chrono::days(15)), Verdict::pass, "approved until 2027-04-11 by"},
    {"14 days left", RULE(d = e.until - std::chrono::days(14)), Verdict::pass, "(14 days left)"},
    {"the last day", RULE(d = e.until), Verdict::pass, "(today is the last day)"},
    {"expired yesterday", RULE(d = e.until + std::chrono::days(1)), Verdict::warn,
     "its approval expired on 2027-04-11 and no longer covers it from 2027-04-19 on"},
    {"expired for 7 days", RULE(d = e.until + std::chrono::days(7)), Verdict::warn, "expired on 2027-04-11"},
    {"expired for 8 days", RULE(d = e.until + std::chrono::days(8)), Verdict::fail,
     "does not hold: it expired on 2027-04-11"},
    {"another asset", RULE(r.scenes[0].inputs->asset = "xx"), Verdict::fail, "it is for another asset or environment"},
    {"another environment", RULE(r.scenes[0].inputs->environment = "xx"), Verdict::fail,
     "it is for another asset or environment"},
    {"another camera or bake", RULE(r.scenes[0].inputs->request = r.scenes[0].inputs->bake = "xx"), Verdict::pass,
     "approved"},
    {"inputs that are not known", RULE(r.scenes[0].inputs.reset()), Verdict::fail, "now not known"},
    {"another figure is over, too", RULE(setFigure(r.scenes[0].views[0].materials[0].figures, "flip.p95", 0.6)),
     Verdict::fail, "95th"},
    {"another view", RULE(e.view = "back"), Verdict::fail, "mean FLIP"},
    {"NaN pixels", RULE(r.scenes[0].views[0].materials[0].figures.nonFinite = 3), Verdict::fail, "NaN or infinite"},
    {"a figure that is no number", RULE(setMean(r, NAN)), Verdict::error, "not a number"},
    {"not seen", RULE(r.scenes[0].views[0].materials[0].figures = {}), Verdict::notSeen, "no view shows it"},
    {"too small", RULE(r.scenes[0].views[0].materials[0].figures.pixels = 12), Verdict::tooSmall, "12 pixels"},
};

TEST(Approvals, EachRuleOfTheVerdictHolds) {
  for (const Rule& rule : kRules) {
    compare::Approvals approvals = makeApprovals();
    Report report = makeChromeReport();
    base::Day day = kDay;
    rule.change(approvals.entries[0], report, day);
    const Report result = withApprovals(report, approvals, day);
    const MaterialResult& row = chrome(result);
    EXPECT_EQ(row.verdict, rule.verdict) << rule.name << ": " << row.reason;
    EXPECT_NE((row.reason + "|" + row.accepted).find(rule.words), std::string::npos)
        << rule.name << ": " << row.reason << "|" << row.accepted;
  }
}

TEST(Approvals, ACheckThatCouldNotBeJudgedIsNotCovered) {
  MaterialResult row;
  row.figures = makeFigures(0.25, 4000);
  compare::CheckResult& check = row.checks.emplace_back();
  check.metric = "flip.mean", check.regress = true, check.verdict = Verdict::warn;
  check.approval.emplace().words = "";
  settleMaterial(row, false);
  EXPECT_EQ(row.verdict, Verdict::pass) << "it was judged: " << row.reason;
  check.unjudged = "new: the baseline does not have it";
  settleMaterial(row, false);
  EXPECT_EQ(row.verdict, Verdict::warn);
  EXPECT_NE(row.reason.find("no check of its budget could be judged"), std::string::npos) << row.reason;
}

TEST(Approvals, WholeImagesHaveEntriesOfTheirOwn) {
  Report report = makeChromeReport(0.01);
  report.scenes[0].views[0].whole = makeFigures(0.25, 9000);
  setFigure(report.scenes[0].views[0].whole, "flip.p95", 0.2);
  compare::Approvals approvals = makeApprovals();
  EXPECT_EQ(withApprovals(report, approvals).scenes[0].views[0].wholeVerdict, Verdict::fail);
  approvals.entries[0].material.clear();
  EXPECT_EQ(withApprovals(report, approvals).scenes[0].views[0].wholeVerdict, Verdict::pass);
}

TEST(Approvals, SignedFigureOfTheOtherSignIsNotCovered) {
  compare::Approval entry = makeApprovals().entries[0];
  entry.metric = "bias.ev", entry.value = -0.6, entry.slack = 0.01;
  const auto state = [&](double figure) {
    return compare::applyApproval(entry, "a.toml, line 1", figure, entry.inputs, kDay).state;
  };
  EXPECT_EQ(state(-0.61), ApprovalState::holds);
  EXPECT_EQ(state(-0.62), ApprovalState::lapsed);
  EXPECT_EQ(state(0.6), ApprovalState::lapsed);
}

TEST(Approvals, MoreIsBetterTurnsTheRuleRound) {
  compare::Approval entry = makeApprovals().entries[0];
  entry.metric = "psnr", entry.value = 28, entry.slack = 0.3;
  const auto state = [&](double figure) {
    return compare::applyApproval(entry, "a.toml, line 1", figure, entry.inputs, kDay).state;
  };
  EXPECT_EQ(state(27.7), ApprovalState::holds);
  EXPECT_EQ(state(27.6), ApprovalState::lapsed);
  EXPECT_EQ(state(31), ApprovalState::loose);
  EXPECT_EQ(state(INFINITY), ApprovalState::loose);
}

TEST(Approvals, EntriesThatAcceptNothingAreOneWarning) {
  compare::Approvals approvals = makeApprovals();
  approvals.entries.push_back(approvals.entries[0]);
  approvals.entries[1].material = "Crome", approvals.entries[1].line = 16;
  Report report = withApprovals(makeChromeReport(), approvals);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0],
            "approvals.toml: an entry accepts nothing: line 16 (flip.mean of 'Crome', Hero, view front: no such row)");
  EXPECT_EQ(report.verdict, Verdict::warn);
  EXPECT_TRUE(withApprovals(makeChromeReport(), approvals, kDay, EntriesFor::none).warnings.empty());
  approvals.entries[1].scene = "Other";
  EXPECT_EQ(withApprovals(makeChromeReport(), approvals).warnings.size(), 1u);
  EXPECT_TRUE(withApprovals(makeChromeReport(), approvals, kDay, EntriesFor::scenes).warnings.empty())
      << "diff shows one scene";
  approvals.entries.pop_back();
  EXPECT_TRUE(withApprovals(makeChromeReport(0.24), approvals).warnings.empty());
  setMean(report = makeChromeReport(), 0.05);
  EXPECT_EQ(withApprovals(report, approvals, later(120)).warnings.size(), 1u) << "it expired, and the row passes";
}

TEST(Approvals, ThoseThatEndAreListedTheFirstFirst) {
  compare::Approvals approvals = makeApprovals();
  EXPECT_TRUE(expiringApprovals(withApprovals(makeChromeReport(), approvals)).empty());
  const Report report = withApprovals(makeChromeReport(), approvals, later(90));
  ASSERT_EQ(expiringApprovals(report).size(), 1u);
  EXPECT_EQ(expiringApprovals(report)[0].approval->daysLeft, 10);
  EXPECT_EQ(expiringApprovals(report)[0].material, "Chrome");
}

} // namespace
} // namespace parity::report
