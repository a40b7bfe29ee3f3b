// Summaries: what is in which section, that any number of failures fits, and that names do nothing.
#include "report/summary/summary.h"

#include <algorithm>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/lines_of.h"
#include "report/baseline.h"
#include "report/judge.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

const SummarySection* sectionOf(const Summary& summary, const std::string& title) {
  const auto found = std::ranges::find(summary.sections, title, &SummarySection::title);
  return found == summary.sections.end() ? nullptr : &*found;
}
std::string namesOf(const Summary& summary, const std::string& title) {
  std::string names;
  if (const SummarySection* section = sectionOf(summary, title))
    for (const SummaryLine& line : section->lines) names += (names.empty() ? "" : ",") + line.name;
  return names;
}

MaterialResult makeRow(const std::string& name, double mean) {
  MaterialResult material = makeMaterial(name, mean, 4000);
  setFigure(material.figures, "flip.p95", 0.1);
  return material;
}

Report makeRun(const std::vector<MaterialResult>& materials) {
  Report report;
  report.suite = "nightly";
  SceneResult& scene = report.scenes.emplace_back();
  scene.name = "Hero";
  ViewResult& view = scene.views.emplace_back();
  view.name = "front";
  view.whole = makeFigures(0.01, 9000);
  view.materials = materials;
  for (MaterialResult& material : view.materials) material.crops.flip = "images/" + material.name + "_flip.png";
  judgeScene(scene, compare::defaultBudgets());
  settleVerdicts(report);
  return report;
}

Report makeNight() {
  Report now = makeRun({makeRow("new", 0.3), makeRow("worse", 0.5), makeRow("still", 0.4), makeRow("well", 0.01),
                        makeRow("fixed", 0.02), makeRow("added", 0.01)});
  Report before = makeRun({makeRow("new", 0.01), makeRow("worse", 0.02), makeRow("still", 0.4), makeRow("well", 0.01),
                           makeRow("fixed", 0.3), makeRow("gone", 0.01)});
  compareWithBaseline(now, before, {"old/report.json", {}, false});
  return now;
}

TEST(Summary, SaysWhatIsNewStillFailingFixedAndGone) {
  const Summary summary = summarize(makeNight(), {});
  EXPECT_EQ(summary.title, "parity: nightly");
  EXPECT_EQ(summary.changes, "2 new failures, 1 still failing, 1 fixed");
  EXPECT_EQ(namesOf(summary, "New failures"), "worse,new") << "the gravest first";
  EXPECT_EQ(namesOf(summary, "Still failing"), "still");
  EXPECT_EQ(namesOf(summary, "Fixed"), "fixed");
  EXPECT_EQ(namesOf(summary, "Gone since the baseline"), "gone");
  EXPECT_EQ(namesOf(summary, "New since the baseline"), "added");
  EXPECT_FALSE(sectionOf(summary, "Failures"));
  EXPECT_NE(sectionOf(summary, "New failures")->lines[0].why.find("mean FLIP 0.500 is above 0.200"), std::string::npos);
}

TEST(Summary, WithoutABaselineNothingIsCalledNew) {
  const Summary summary = summarize(makeRun({makeRow("a", 0.4), makeRow("b", 0.01)}), {});
  EXPECT_EQ(summary.changes, "");
  EXPECT_EQ(namesOf(summary, "Failures"), "a");
  EXPECT_FALSE(sectionOf(summary, "New failures"));
}

TEST(Summary, ErrorsAndFlakyCrashesAreSaid) {
  Report report = makeNight();
  report.scenes.emplace_back().name = "Broken";
  report.scenes[1].error = "no such file";
  report.scenes[1].errorExitCode = 4;
  settleVerdicts(report);
  RunInfo run;
  run.incidents = {"Hero: flaky crash: a worker crashed with SIGSEGV; the second try succeeded"};
  const Summary summary = summarize(report, run);
  ASSERT_TRUE(sectionOf(summary, "Errors"));
  EXPECT_EQ(sectionOf(summary, "Errors")->lines[0].why, "no such file");
  EXPECT_EQ(&summary.sections.front(), sectionOf(summary, "Errors"));
  ASSERT_TRUE(sectionOf(summary, "Flaky"));
}

TEST(Summary, HistoryMayKnowMoreThanABaseline) {
  const Summary summary =
      summarize(makeNight(), {}, [](const SceneResult&, const ViewResult&, const MaterialResult* material) {
        return material && material->name == "still"  ? RowStanding{Standing::still, 7, "characters"}
               : material && material->name == "well" ? RowStanding{Standing::flaky, 0, ""}
                                                      : RowStanding{};
      });
  ASSERT_TRUE(sectionOf(summary, "Still failing"));
  EXPECT_EQ(sectionOf(summary, "Still failing")->lines[0].note, "7 nights, owner: characters");
  EXPECT_EQ(namesOf(summary, "Flaky"), "well");
}

TEST(Summary, PicturesComeFromTheAddressThatIsGiven) {
  const Summary summary = summarize(makeNight(), {});
  EXPECT_EQ(toSummary(summary, SummaryFormat::github, {}).find("<img"), std::string::npos);
  const std::string with = toSummary(summary, SummaryFormat::github, {kMostCommentBytes, "https://ci.example/night"});
  EXPECT_NE(with.find("<img src=\"https://ci.example/night/images/worse_flip.png\""), std::string::npos) << with;
  EXPECT_EQ(pictureUrl("https://ci.example/n/", "images/a b\"<.png"), "https://ci.example/n/images/a%20b%22%3C.png");
  EXPECT_EQ(pictureUrl("", "images/a.png"), "");
  const nlohmann::json slack =
      nlohmann::json::parse(toSummary(summary, SummaryFormat::slack, {kMostCommentBytes, "https://ci.example/night"}));
  EXPECT_EQ(std::ranges::count_if(slack["blocks"], [](const auto& block) { return block["type"] == "image"; }), 1);
}

// A row for each failure, of names that are as long as names may be.
Summary makeLargeSummary(std::size_t failures) {
  constexpr std::size_t kOfAScene = 100;
  Report report;
  for (std::size_t from = 0; from < failures; from += kOfAScene) {
    std::vector<MaterialResult> materials;
    for (std::size_t i = from; i < from + kOfAScene; ++i)
      materials.push_back(makeRow(std::to_string(i) + std::string(i % 120, '|'),
                                  0.21 + 0.7 * static_cast<double>(i) / static_cast<double>(failures)));
    report.scenes.push_back(std::move(makeRun(materials).scenes[0]));
    if (from > 0) report.scenes.back().name = "Scene " + std::to_string(from);
  }
  const Report before = makeRun({makeRow("0", 0.01), makeRow("gone", 0.1)});
  settleVerdicts(report);
  compareWithBaseline(report, before, {"old/report.json", {}, false});
  return summarize(report, {});
}

TEST(Summary, HundredThousandFailuresFit) {
  constexpr std::size_t kFailures = 100000;
  const Summary summary = makeLargeSummary(kFailures);
  for (const std::size_t most : {kMostCommentBytes, kMostStepSummaryBytes})
    for (const SummaryFormat format : {SummaryFormat::github, SummaryFormat::gitlab}) {
      const std::string text = toSummary(summary, format, {most, ""});
      EXPECT_LE(text.size(), most);
      EXPECT_GE(text.size(), most * 9 / 10) << "what there is room for is shown";
      EXPECT_NE(text.find("### New failures (100000)"), std::string::npos);
      EXPECT_NE(text.find("| 99999"), std::string::npos) << "the gravest";
      EXPECT_NE(text.find("### Gone since the baseline"), std::string::npos) << "the other sections, too";
      std::smatch more;
      ASSERT_TRUE(std::regex_search(text, more, std::regex("and (\\d+) more that are milder")));
      std::size_t rows = 0;
      const std::size_t from = text.find("### New failures"), to = text.find("\nand ", from);
      for (const std::string& line : tests::linesOf(text.substr(from, to - from))) rows += line.starts_with("| ");
      EXPECT_EQ(rows - 1 + std::stoul(more[1]), kFailures) << "with the head of the table";
    }
}

TEST(Summary, SlackHasItsOwnLimits) {
  const nlohmann::json message = nlohmann::json::parse(toSummary(makeLargeSummary(100000), SummaryFormat::slack, {}));
  EXPECT_LE(message["blocks"].size(), 50u);
  for (const nlohmann::json& block : message["blocks"]) {
    const std::string text = block["text"]["text"];
    EXPECT_LE(text.size(), block["type"] == "header" ? 150u : 3000u);
    EXPECT_FALSE(text.empty());
    EXPECT_TRUE(block["text"]["type"] != "mrkdwn" || block["text"]["verbatim"].get<bool>());
  }
  EXPECT_NE(message.dump().find("more that are milder"), std::string::npos);
}

TEST(Summary, FewLinesOfEachSectionComeBeforeTheRest) {
  std::vector<SummarySection> sections(2);
  sections[0].lines.resize(100);
  sections[1].lines.resize(100);
  const auto one = [](const SummaryLine&) { return std::size_t{1}; };
  EXPECT_EQ(fitLines(sections, 1000, one), (std::vector<std::size_t>{100, 100}));
  EXPECT_EQ(fitLines(sections, 50, one), (std::vector<std::size_t>{45, 5}));
  EXPECT_EQ(fitLines(sections, 3, one), (std::vector<std::size_t>{3, 0}));
  EXPECT_EQ(fitLines(sections, 0, one), (std::vector<std::size_t>{0, 0}));
}

// With any names the table has the same cells, nobody is called, and no markup comes from a name.
TEST(Summary, HostileNamesAreText) {
  std::vector<std::string> names = hostileNames();
  for (const char* more :
       {"@everyone", "<!channel> <@U1>", "a|b|c", "`*_~#1", "![x](http://e.example/x.png)", "</td></table>"})
    names.push_back(more);
  for (const std::string& name : names) {
    Report report = makeRun({makeRow(name, 0.5)});
    report.suite = report.scenes[0].name = report.scenes[0].views[0].name = name;
    report.scenes[0].error = name;
    settleVerdicts(report);
    for (const SummaryFormat format : {SummaryFormat::github, SummaryFormat::gitlab}) {
      const std::string text = toSummary(summarize(report, {}), format, {});
      EXPECT_EQ(text.find_first_of("<>`@[]"), std::string::npos) << text;
      for (const std::string& line : tests::linesOf(text)) {
        EXPECT_TRUE(!line.starts_with("|") || std::ranges::count(line, '|') == 5) << line;
      }
    }
    const std::string slack = toSummary(summarize(report, {}), SummaryFormat::slack, {});
    EXPECT_TRUE(nlohmann::json::accept(slack)) << slack;
    for (const nlohmann::json& block : nlohmann::json::parse(slack)["blocks"]) {
      const std::string shown = block["text"]["text"];
      EXPECT_TRUE(block["type"] == "header" || shown.find_first_of("<>") == std::string::npos) << shown;
    }
  }
}

} // namespace
} // namespace parity::report
