// The terminal's table: columns that line up, names that cannot steer the terminal.
#include <algorithm>
#include <csignal>

#include <gtest/gtest.h>

#include "base/lines_of.h"
#include "base/text/text.h"
#include "compare/verdict/budget.h"
#include "report/judge.h"
#include "report/report.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

using tests::linesOf;

// The columns up to where `word` ends in a line.
std::size_t endOf(const std::string& line, const std::string& word) {
  const std::size_t at = line.find(word);
  EXPECT_NE(at, std::string::npos) << word << " in: " << line;
  return base::displayWidth(line.substr(0, at + word.size()));
}

TEST(ReportTable, EachMaterialAndViewIsARow) {
  const auto lines = linesOf(toTable(makeSampleReport(), {}, {.all = true}));
  const auto rows = [&](const std::string& name) {
    return std::ranges::count_if(
        lines, [&](const std::string& line) { return line.find("  " + name + " ") != std::string::npos; });
  };
  for (const char* name :
       {"Glass", "Rough metal", "Shade, cloth", "Screw", "Bulb", "Rivet", "Lit panel", "whole image"})
    EXPECT_EQ(rows(name), 2) << name;
  EXPECT_EQ(lines[0], "Lamp, view front (1024x1024)");
  EXPECT_EQ(lines[3].find("  fail        Rough metal"), 0u) << lines[3];
  EXPECT_NE(lines[3].find(" 120000  0.270  0.675  1.000  -0.49 EV"), std::string::npos) << lines[3];
  EXPECT_NE(lines[3].find("mobile is 0.5 EV darker; mean FLIP 0.270 is above 0.200; 95th "), std::string::npos)
      << lines[3];
  EXPECT_TRUE(
      lines[3].ends_with("; skySpecular (reflections of the environment): FLIP 0.270 -> 0.061 with the high-end term"))
      << lines[3];
  EXPECT_EQ(lines[7].find("  too small   Rivet"), 0u) << lines[7];
  EXPECT_EQ(lines[8].find("  not judged  Lit panel"), 0u) << lines[8];
  EXPECT_EQ(lines.back(), "verdict: error (materials: 3 pass, 2 not seen, 2 too small, 2 not judged, 2 warn, 2 fail; "
                          "whole images: 2 pass; scenes not compared: 1)");
}

TEST(ReportTable, DroppedLightsAreALineBelowTheirViewThatCannotSteerTheTerminal) {
  Report report = makeSampleReport();
  report.scenes[0].views[1].droppedLights = makeDroppedLights("\x1b[31mlamp");
  const auto lines = linesOf(toTable(report, {}, {.all = true}));
  const auto isTold = [](const std::string& line) {
    return line.starts_with("  mobile drops 4 of 5 lights; without '");
  };
  const auto line = std::ranges::find_if(lines, isTold);
  ASSERT_NE(line, lines.end());
  EXPECT_NE((line - 1)->find("whole image"), std::string::npos);
  EXPECT_EQ(std::ranges::count_if(lines, isTold), 1);
  EXPECT_EQ(line->find('\x1b'), std::string::npos);
}

TEST(ReportTable, TheBiasOfLightIsAColumnWhereItWasMeasured) {
  const auto lines = linesOf(toTable(makeSampleReport(), {}, {.all = true}));
  EXPECT_EQ(endOf(lines[3], "-0.49 EV"), endOf(lines[1], "EV")) << lines[3];
  EXPECT_EQ(endOf(lines[4], "+0.11 EV"), endOf(lines[1], "EV")) << lines[4];
  Report without = makeSampleReport();
  for (ViewResult& view : without.scenes[0].views) {
    const auto drop = [](compare::Figures& figures) {
      std::erase_if(figures.values, [](const compare::Figure& figure) { return figure.name == "bias.ev"; });
    };
    drop(view.whole);
    for (MaterialResult& material : view.materials) drop(material.figures);
  }
  EXPECT_EQ(linesOf(toTable(without, {}, {.all = true}))[1].find("EV"), std::string::npos);
}

TEST(ReportTable, ABaselineAddsAColumn) {
  const auto lines = linesOf(toTable(makeSampleReportSince(), {}, {.all = true}));
  for (const std::size_t row : {3, 6}) // Rough metal, Bulb
    EXPECT_EQ(endOf(lines[row], row == 3 ? "+0.070" : "   new"), endOf(lines[1], "since")) << lines[row];
  EXPECT_NE(lines.back().find("gone since the baseline: 1"), std::string::npos) << lines.back();
  EXPECT_NE(lines.back().find("not comparable to the baseline: 6"), std::string::npos) << lines.back();
  const auto isBack = [](const std::string& line) { return line.find("view back") != std::string::npos; };
  const auto back = std::ranges::find_if(lines, isBack);
  ASSERT_GT(lines.end() - back, 2);
  EXPECT_NE((back + 2)->find("warn"), std::string::npos) << *(back + 2);
  EXPECT_NE((back + 2)->find("not comparable to the baseline: field of view was 44, is 45"), std::string::npos)
      << *(back + 2);
}

TEST(ReportTable, ATruthAddsTwoColumnsAndMarksWhatItsNoiseHides) {
  const auto lines = linesOf(toTable(makeSampleReportWithTruth(), {}, {.all = true}));
  EXPECT_EQ(endOf(lines[3], "0.090      0.270"), endOf(lines[1], "mo/truth")) << lines[3]; // Rough metal
  EXPECT_NE(lines[2].find("0.010~"), std::string::npos) << lines[2];
  EXPECT_EQ(lines[2].find("0.030~"), std::string::npos) << "mobile is further away: " << lines[2];
  EXPECT_EQ(lines[3].find('~'), std::string::npos) << lines[3];
  EXPECT_NE(
      toTable(makeSampleReportWithTruth(), {}, {.all = true}).find("~ marks a difference within 2 standard errors"),
      std::string::npos);
  EXPECT_EQ(toTable(makeSampleReport(), {}, {.all = true}).find("truth"), std::string::npos);
}

TEST(ReportTable, ColumnsOfTheTruthTellPathsApartWhoseNamesBeginAlike) {
  Report report = makeSampleReportWithTruth();
  for (SceneResult& scene : report.scenes)
    for (ViewResult& view : scene.views) view.reference = "mono";
  const std::string table = toTable(report, {}, {.all = true});
  const auto lines = linesOf(table);
  EXPECT_EQ(endOf(lines[3], "0.090       0.270"), endOf(lines[1], "mob/truth")) << table;
  EXPECT_NE(lines[1].find("mon/truth"), std::string::npos) << table;
  EXPECT_NE(table.find("mon/truth, mob/truth: "), std::string::npos) << table;
}

TEST(ReportTable, AWholeImageThatDecidesIsCounted) {
  Report report = makeSampleReport();
  report.scenes.pop_back();
  report.scenes[0].views.pop_back();
  ViewResult& view = report.scenes[0].views[0];
  view.materials.resize(1);
  view.whole = makeFigures(0.3, 4000);
  judgeWhole(view, compare::defaultBudgets(), "Lamp");
  settleVerdicts(report);
  EXPECT_EQ(linesOf(toTable(report, {}, {.all = true})).back(),
            "verdict: fail (materials: 1 pass; whole images: 1 fail)");
}

TEST(ReportTable, ShowsTheFiguresThatWereMeasured) {
  Report report = makeSampleReport();
  for (ViewResult& view : report.scenes[0].views) setFigure(view.whole, "ssim.mean", 0.987);
  const auto lines = linesOf(toTable(report, {}, {.all = true}));
  EXPECT_EQ(endOf(lines[9], "0.9870"), endOf(lines[1], "ssim")) << lines[9];
  EXPECT_EQ(lines[2].find("0.987"), std::string::npos) << "of that material it was not measured: " << lines[2];
}

TEST(ReportTable, ColumnsLineUpWhateverTheNamesAre) {
  const auto lines =
      linesOf(toTable(makeSampleReport({"scene", "日本語", "é́ combining", std::string(300, 'x')}), {}, {.all = true}));
  for (std::size_t i = 2; i <= 4; ++i) { // 日本語 (fail), combining (warn), long (pass), in the scene's order
    const std::string pixels = i == 2 ? "90000" : i == 3 ? "120000" : "60000";
    EXPECT_EQ(endOf(lines[i], pixels), endOf(lines[1], "pixels")) << lines[i];
  }
}

TEST(ReportTable, NamesCannotSteerTheTerminal) {
  const std::string table = toTable(makeSampleReport(hostileNames()), {}, {.all = true});
  for (const char c : table) EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20 && c != '\n') << static_cast<int>(c);
  EXPECT_EQ(table.find("\xE2\x80\xAE"), std::string::npos); // right-to-left override
  EXPECT_EQ(linesOf(table).size(), linesOf(toTable(makeSampleReport(), {}, {.all = true})).size());
}

TEST(ReportTable, ColourChangesNothingElse) {
  const std::string plain = toTable(makeSampleReport(), {}, {.all = true});
  EXPECT_EQ(plain.find('\x1b'), std::string::npos);
  std::string stripped = toTable(makeSampleReport(), {}, {.color = true, .all = true});
  EXPECT_NE(stripped.find("\x1b[1;31mfail"), std::string::npos);
  for (std::size_t at; (at = stripped.find('\x1b')) != std::string::npos;)
    stripped.erase(at, stripped.find('m', at) + 1 - at);
  EXPECT_EQ(stripped, plain);
}

// The report's first scene, whose materials all have this mean FLIP.
Report reportOf(double mean) {
  Report report = makeSampleReport();
  report.scenes.pop_back();
  report.scenes[0].permutations.clear();
  for (ViewResult& view : report.scenes[0].views) {
    view.materials = {makeMaterial("Gold", mean, 5000), makeMaterial("Tin", mean, 5000)};
    for (MaterialResult& material : view.materials) judgeMaterial(material, compare::defaultBudgets(), "Lamp");
  }
  settleVerdicts(report);
  return report;
}

TEST(ReportTable, WithoutAllOnlyWhatFailedWarnedOrCouldNotBeJudgedIsARowAndTheRestIsCounted) {
  const std::string table = toTable(makeSampleReport(), {}, {});
  const auto lines = linesOf(table);
  EXPECT_EQ(lines[0], "Lamp, view front (1024x1024)");
  EXPECT_EQ(lines[2].find("  fail        Rough metal"), 0u) << table;
  EXPECT_EQ(lines[3].find("  warn        Shade, cloth"), 0u) << table;
  EXPECT_EQ(lines[4].find("  not judged  Lit panel"), 0u) << "--warn-exit ends with 1 because of it: " << table;
  EXPECT_EQ(lines[5].find("  4 more materials ("), 0u) << table;
  EXPECT_TRUE(lines[5].ends_with("): --all shows them")) << lines[5];
  EXPECT_EQ(lines[6], "");
  for (const char* name : {"  Glass ", "  Bulb ", "  whole image "}) EXPECT_EQ(table.find(name), std::string::npos);
  EXPECT_EQ(lines.back(), linesOf(toTable(makeSampleReport(), {}, {.all = true})).back());
}

TEST(ReportTable, ARunWhereAllPassesSaysSoInFewLines) {
  const auto lines = linesOf(toTable(reportOf(0.01), {}, {}));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "2 views have nothing that failed, warned or could not be judged: --all shows them");
  EXPECT_EQ(lines[1], "verdict: pass (materials: 4 pass; whole images: 2 pass)");
  EXPECT_NE(toTable(reportOf(0.01), {}, {.all = true}).find("  Gold "), std::string::npos);
}

TEST(ReportTable, NoLineIsWiderThanTheTerminal) {
  RunInfo run = makeSampleRun();
  run.again = {{"Lamp", "front", "parity diff --suite nightly.toml --mobile-preset ue4-2020 --only Lamp/front"}};
  for (const Report& report : {makeSampleReport(), makeSampleReportSince(), makeSampleReportWithTruth(),
                               makeSampleReport({"scene", "日本語", "combining", std::string(300, 'x')})})
    for (const std::size_t columns : {60u, 80u, 100u, 160u})
      for (const bool all : {false, true}) {
        const std::string table = toTable(report, run, {.columns = columns, .all = all});
        for (const std::string& line : linesOf(table)) EXPECT_LE(base::displayWidth(line), columns) << line;
        EXPECT_NE(table.find("\n              "), std::string::npos) << "the reason is below the name: " << table;
      }
}

TEST(ReportTable, FiguresWithoutRoomForAColumnAreInTheText) {
  Report report = makeSampleReportWithTruth();
  for (ViewResult& view : report.scenes[0].views)
    for (MaterialResult& material : view.materials)
      if (material.figures.pixels > 0) setFigure(material.figures, "ssim.mean", 0.987);
  for (ViewResult& view : report.scenes[0].views) setFigure(view.whole, "ssim.mean", 0.987);
  const std::string narrow = toTable(report, {}, {.columns = 80}), wide = toTable(report, {}, {.columns = 160});
  EXPECT_NE(narrow.find("ssim 0.9870, psnr"), std::string::npos) << narrow;
  EXPECT_EQ(wide.find("ssim 0.9870"), std::string::npos) << wide;
  EXPECT_NE(wide.find("0.9870"), std::string::npos) << wide;
}

TEST(ReportTable, SaysTheTotalsByCauseWhereSeveralMaterialsHaveOne) {
  const std::string table = toTable(makeSampleReport(), {}, {});
  EXPECT_NE(
      table.find("causes:\n  skySpecular (reflections of the environment): 1 material, worst Rough metal in scene "
                 "Lamp, view front: mean FLIP 0.270\n"),
      std::string::npos)
      << table;
  EXPECT_EQ(toTable(reportOf(0.01), {}, {}).find("causes"), std::string::npos);
}

TEST(ReportTable, ShowsTheWorstRowsAgainByTheirCommands) {
  RunInfo run = makeSampleRun();
  const Report report = makeSampleReport();
  EXPECT_EQ(toTable(report, run, {}).find("to see it again"), std::string::npos);
  run.again = {{"Lamp", "front", "parity diff Lamp.glb"}, {"Lamp", "back", "parity diff back.glb"}};
  const std::string table = toTable(report, run, {});
  EXPECT_NE(table.find("to see it again:\n  parity diff Lamp.glb --material 'Rough metal'\n  parity diff back.glb "
                       "--material 'Rough metal'\n  parity diff Lamp.glb --material 'Shade, cloth'\n  3 more: "),
            std::string::npos)
      << table;
  EXPECT_NE(toTable(report, run, {.all = true}).find("  parity diff back.glb --material 'Shade, cloth'\n"),
            std::string::npos);
}

TEST(ReportTable, WhatWasNotRunIsOneLine) {
  Report report = makeSampleReport();
  for (const char* name : {"Desk", "Sofa"}) {
    report.scenes.emplace_back().name = name;
    setNotRun(report.scenes.back(), SIGINT);
  }
  settleVerdicts(report);
  const std::string table = toTable(report, {}, {});
  EXPECT_NE(table.find("\nnot run: 2 of 4 scenes (SIGINT interrupted the run): Desk, Sofa\n"), std::string::npos)
      << table;
  EXPECT_EQ(table.find("Desk: "), std::string::npos);
  EXPECT_NE(table.find("; scenes not compared: 1; scenes not run: 2)"), std::string::npos) << table;
}

TEST(ReportTable, OfWhatIsGoneOnlyTheFirstAreLines) {
  Report report = makeSampleReportSince();
  report.baseline->gone.assign(25, {"Lamp", "front", "Old lamp"});
  settleVerdicts(report);
  const auto count = [](const std::string& table) {
    const auto lines = linesOf(table);
    return std::ranges::count_if(lines, [](const std::string& line) { return line.starts_with("warning: gone: "); });
  };
  EXPECT_EQ(count(toTable(report, {}, {})), 11);
  EXPECT_NE(toTable(report, {}, {}).find("warning: gone: 15 more: --all shows them\n"), std::string::npos);
  EXPECT_EQ(count(toTable(report, {}, {.all = true})), 25);
}

TEST(ReportTable, ErrorsAndEmptyReportsAreSaid) {
  EXPECT_NE(toTable(makeSampleReport(), {}, {.all = true}).find("Broken: error: assets/Broken.glb: chunk 0"),
            std::string::npos);
  Report empty;
  settleVerdicts(empty);
  EXPECT_NE(toTable(empty, {}, {.all = true}).find("verdict: error (nothing was compared)"), std::string::npos);
}

} // namespace
} // namespace parity::report
