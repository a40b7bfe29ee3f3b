// What a budget accepts passes and is shown with its reason; all else is judged as ever, and no error is accepted.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/temp_folder.h"
#include "compare/verdict/budget.h"
#include "report/baseline.h"
#include "report/judge.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

compare::Budgets loadRule(const std::string& rule) {
  const base::TempFolder folder;
  base::writeText(folder / "b.toml", rule);
  return compare::loadBudgets(folder / "b.toml");
}

// One view of one material beside another one that is well.
Report reportOf(const MaterialResult& material) {
  ViewResult view;
  view.name = "v";
  view.whole = makeFigures(0.01, 4000);
  view.materials = {material, makeMaterial("well", 0.01, 4000)};
  Report report;
  report.scenes.emplace_back().name = "s";
  report.scenes[0].views = {view};
  return report;
}

Report judged(Report report, const compare::Budgets& budgets) {
  for (ViewResult& view : report.scenes[0].views) {
    judgeWhole(view, budgets, "s");
    for (MaterialResult& material : view.materials) judgeMaterial(material, budgets, "s");
  }
  settleVerdicts(report);
  return report;
}

std::string ruleOf(const std::string& accept) {
  return "[[material]]\nname = \"m\"\nreason = \"known\"\naccept = " + accept + "\n";
}
const std::string kLimit = "checks = [ { metric = \"flip.mean\", fail = 0.2 } ]\n";

struct Case {
  const char* accept;
  std::function<void(MaterialResult&)> change;
  const char* said;
  compare::Verdict otherwise; // where nothing is accepted
};

const std::vector<Case> kCases = {
    {"not seen", [](MaterialResult& m) { m.figures = {}; }, "no view shows it", compare::Verdict::notSeen},
    {"too small", [](MaterialResult& m) { m.figures.pixels = 12; }, "12 pixels", compare::Verdict::tooSmall},
    {"not judged", [](MaterialResult& m) { m.figures.clippedWhite = 0.8; }, "white", compare::Verdict::notJudged},
    {"clipped", [](MaterialResult& m) { m.figures.clippedWhite = 0.1; }, "white", compare::Verdict::warn},
    {"base layer only", [](MaterialResult& m) { m.notModelled = {"sheen"}; }, "sheen", compare::Verdict::warn},
};

TEST(Accepted, EachConditionPassesWithItsReasonAndNoOtherDoes) {
  for (const Case& row : kCases) {
    MaterialResult material = makeMaterial("m", 0.05, 4000);
    row.change(material);
    for (const Case& accepted : kCases) {
      const std::string list = std::string("[\"") + accepted.accept + "\"]\n";
      const Report report = judged(reportOf(material), loadRule(ruleOf(list) + kLimit));
      const MaterialResult& found = report.scenes[0].views[0].materials[0];
      if (row.accept != accepted.accept) {
        EXPECT_EQ(found.verdict, row.otherwise) << row.accept << " by " << accepted.accept;
        EXPECT_EQ(found.accepted, "") << row.accept;
        EXPECT_EQ(exitCode(report, true), 1);
        continue;
      }
      EXPECT_EQ(found.verdict, compare::Verdict::pass) << row.accept;
      EXPECT_EQ(found.reason, "");
      EXPECT_NE(found.accepted.find(row.said), std::string::npos) << found.accepted;
      EXPECT_TRUE(found.accepted.ends_with("(reason: known)")) << found.accepted;
      EXPECT_EQ(exitCode(report, true), 0);
      EXPECT_EQ(headline(report), "All 2 materials are within budget, with accepted exceptions for 1 material");
      EXPECT_NE(toTable(report, {}, {.all = true}).find("accepted: "), std::string::npos);
      EXPECT_NE(toTable(report, {}, {.all = true}).find("pass by accepted exceptions: 1"), std::string::npos);
      EXPECT_NE(toJunit(report, {}).find("<system-out>accepted: "), std::string::npos);
      EXPECT_NE(toJson(report).find("\"accepted\": \""), std::string::npos);
    }
  }
}

TEST(Accepted, LimitsStillFailWhatIsAccepted) {
  MaterialResult material = makeMaterial("m", 0.3, 4000);
  material.figures.clippedWhite = 0.8;
  material.notModelled = {"sheen"};
  const Report report =
      judged(reportOf(material), loadRule(ruleOf("[\"not judged\", \"base layer only\"]\n") + kLimit));
  EXPECT_EQ(report.scenes[0].views[0].materials[0].verdict, compare::Verdict::fail);
  EXPECT_EQ(exitCode(report, false), 2);
}

TEST(Accepted, NonFinitePixelsUpToTheirNumber) {
  const compare::Budgets budgets = loadRule(ruleOf("[\"non-finite\"]\nmax_non_finite = 5\n") + kLimit);
  MaterialResult material = makeMaterial("m", 1, 4000);
  for (const std::uint64_t count : {std::uint64_t{5}, std::uint64_t{6}}) {
    material.figures.nonFinite = count;
    const Report report = judged(reportOf(material), budgets);
    EXPECT_EQ(exitCode(report, true), count == 5 ? 0 : 2);
    const MaterialResult& found = report.scenes[0].views[0].materials[0];
    EXPECT_EQ(found.reason.find("more than max_non_finite = 5") != std::string::npos, count == 6) << found.reason;
    EXPECT_EQ(found.accepted.find("5 of 4000 pixels are NaN or infinite") != std::string::npos, count == 5);
  }
  material.figures.nonFinite = 5;
  EXPECT_EQ(exitCode(judged(reportOf(material), loadRule(ruleOf("[\"clipped\"]\n") + kLimit)), true), 2);
}

TEST(Accepted, NoCheckFailsByTheFiguresOfAcceptedNonFinitePixels) {
  const std::string limits = kLimit + "regress = [ { metric = \"flip.mean\", fail = 0.1 } ]\n";
  const compare::Budgets budgets = loadRule(ruleOf("[\"non-finite\"]\nmax_non_finite = 5\n") + limits);
  MaterialResult material = makeMaterial("m", 1, 4000); // of which FLIP fails
  const Report baseline = judged(reportOf(makeMaterial("m", 0.01, 4000)), budgets);
  for (const std::uint64_t count : {std::uint64_t{5}, std::uint64_t{6}}) {
    material.figures.nonFinite = count;
    Report report = judged(reportOf(material), budgets);
    compareWithBaseline(report, baseline, {"old", {}, false});
    const MaterialResult& found = report.scenes[0].views[0].materials[0];
    ASSERT_EQ(found.checks.size(), 2u);
    EXPECT_EQ(found.checks[0].judged(), count == 6) << "above the limit the figure is told beside the reason";
    EXPECT_EQ(found.checks[1].unjudged, compare::kNonFinitePixels);
    EXPECT_EQ(found.verdict, count == 5 ? compare::Verdict::pass : compare::Verdict::fail) << found.reason;
  }
}

TEST(Accepted, NonFinitePixelsHideNothingElse) {
  const compare::Budgets budgets = loadRule(ruleOf("[\"non-finite\"]\nmax_non_finite = 5\n") + kLimit);
  MaterialResult material = makeMaterial("m", 0.05, 10);
  material.figures.nonFinite = 1;
  EXPECT_EQ(judged(reportOf(material), budgets).scenes[0].views[0].materials[0].verdict, compare::Verdict::tooSmall);
  material.figures.nonFinite = 6;
  EXPECT_EQ(judged(reportOf(material), budgets).scenes[0].views[0].materials[0].verdict, compare::Verdict::fail);
  material = makeMaterial("m", 0.05, 4000);
  material.figures.nonFinite = 1;
  material.notModelled = {"sheen"};
  EXPECT_EQ(judged(reportOf(material), budgets).scenes[0].views[0].materials[0].verdict, compare::Verdict::warn);
  material.notModelled.clear();
  Report alone = reportOf(material);
  alone.scenes[0].views[0].materials.pop_back();
  EXPECT_EQ(exitCode(judged(alone, budgets), false), 4) << "no limit judged anything";
}

TEST(Accepted, NotJudgedIsNoAcceptanceOfWhatTheBaselineDoesNotShow) {
  MaterialResult material = makeMaterial("m", 0.3, 4000);
  material.rule.reason = "known";
  material.rule.accept = {compare::Accept::notJudged};
  compare::CheckResult check;
  check.metric = "flip.mean";
  check.regress = true;
  check.verdict = compare::Verdict::warn;
  check.unjudged = "new: the baseline does not have it";
  material.checks = {check};
  settleMaterial(material, false);
  EXPECT_EQ(material.verdict, compare::Verdict::warn);
  EXPECT_EQ(material.accepted, "");
  material.checks[0].metric = "bias.ev";
  material.figures.referenceLuminance = material.figures.testLuminance = 1e-4;
  settleMaterial(material, false);
  EXPECT_EQ(material.verdict, compare::Verdict::pass) << "it is too dark for it: " << material.reason;
}

TEST(Accepted, NoLimitJudgesNothingButErrorsStay) {
  const compare::Budgets budgets = loadRule(ruleOf("[\"no limit\"]\n"));
  MaterialResult material = makeMaterial("m", 1, 4000);
  EXPECT_EQ(exitCode(judged(reportOf(material), budgets), true), 0);
  setFigure(material.figures, "rmse", NAN);
  EXPECT_EQ(exitCode(judged(reportOf(material), budgets), false), 4);
  material = makeMaterial("m", 1, 4000);
  material.truth.emplace().figures.nonFinite = 1;
  EXPECT_EQ(exitCode(judged(reportOf(material), budgets), false), 4);
  material = makeMaterial("m", 1, 4000);
  material.figures.nonFinite = 1;
  EXPECT_EQ(exitCode(judged(reportOf(material), budgets), false), 2);
}

TEST(Accepted, ARunThatComparedNothingStaysAnError) {
  Report report = reportOf(makeMaterial("m", 0, 0));
  report.scenes[0].views[0].materials.pop_back();
  const Report unseen = judged(report, loadRule(ruleOf("[\"not seen\"]\n") + kLimit));
  EXPECT_EQ(exitCode(unseen, false), 4);
  EXPECT_EQ(problemsOf(unseen).at(0).reason, "no material was compared: 1 accepted without being judged");
}

TEST(Accepted, OfAWholeImage) {
  Report report = reportOf(makeMaterial("m", 0.05, 4000));
  report.scenes[0].views[0].whole.clippedBlack = 0.3;
  const std::string rule = "[[whole]]\nreason = \"night\"\npreset = \"default\"\n";
  EXPECT_EQ(exitCode(judged(report, loadRule(rule)), true), 1);
  const Report accepted = judged(report, loadRule(rule + "accept = [\"clipped\"]\n"));
  EXPECT_EQ(exitCode(accepted, true), 0);
  EXPECT_EQ(headline(accepted), "All 2 materials are within budget, with accepted exceptions for 1 whole image");
}

} // namespace
} // namespace parity::report
