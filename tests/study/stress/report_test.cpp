// What a run says: JSON, page, terminal.
#include "study/stress/stress_run.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "report/dashboard_files.h"
#include "study/stress/planted.h"

namespace parity::tests {
namespace {

using namespace stress;

Report makeReport() {
  Report report;
  report.version = "1";
  report.halfSkipped = "device <x> has no shaderFloat16";
  report.points = 1000;
  FunctionCase function = makePlanted();
  function.mapped(0, 1);
  function.name = "planted<&>";
  report.functions.push_back(run(
      function, [](double r, double c) { return r < 0.5 ? 0 / 0.0 : r * c; }, 1000));
  Column skipped{
      .precision = Precision::f16, .onDevice = true, .skipped = report.halfSkipped, .tally = Tally(function)};
  report.functions.back().columns.push_back(skipped);
  report.findings = findingsOf(report.functions.back());
  report.scenes.push_back({.name = "scene", .wants = "light", .paths = {"highend"}, .findings = {}});
  return report;
}

TEST(StressReport, JsonHoldsFindingsFiguresAndWhatWasSkipped) {
  const nlohmann::json json = nlohmann::json::parse(formatJson(makeReport()));
  EXPECT_EQ(json["unexpected"], 3);
  EXPECT_EQ(json["expected"], 0);
  EXPECT_EQ(json["fp16Skipped"], "device <x> has no shaderFloat16");
  const nlohmann::json& finding = json["findings"][0];
  for (const char* key : {"subject", "place", "fault", "expected", "count", "example", "reproduce", "region", "reason"})
    EXPECT_TRUE(finding.contains(key)) << key;
  const nlohmann::json& columns = json["functions"][0]["columns"];
  ASSERT_EQ(columns.size(), 4u);
  EXPECT_EQ(columns[2]["side"], "cpu");
  EXPECT_EQ(columns[2]["precision"], "fp16");
  EXPECT_GT(columns[2]["faults"]["not finite"]["unexpected"], 100);
  ASSERT_EQ(columns[2]["map"].size(), static_cast<std::size_t>(kMapSize * kMapSize));
  EXPECT_TRUE(columns[2]["map"][0].is_null()) << "nothing is finite there";
  EXPECT_EQ(columns[2]["map"].back(), 0) << "exact";
  EXPECT_EQ(json["functions"][0]["mapAxes"], nlohmann::json({{"roughness", "r"}, {"cosine", "c"}}));
  EXPECT_EQ(columns[3]["skipped"], "device <x> has no shaderFloat16");
  EXPECT_FALSE(columns[3].contains("maxError")) << "a column that was not run has no figures";
  EXPECT_EQ(json["scenes"][0]["paths"][0], "highend");
}

TEST(StressReport, ThePageHoldsTheReportAndItsTimesAndIsEscaped) {
  Report report = makeReport();
  report.functionsMs = 1500;
  const std::string page = formatPage(report);
  if (!report::hasDashboard()) GTEST_SKIP() << "built without the page";
  const auto block = [&](const std::string& id) {
    const std::string head = "id=\"" + id + "\">";
    const std::size_t from = page.find(head) + head.size();
    return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
  };
  EXPECT_EQ(block("stress"), nlohmann::json::parse(formatJson(report)));
  EXPECT_EQ(block("stress-times")["functionsMs"], 1500);
  EXPECT_EQ(page.find("planted<&>"), std::string::npos);
  EXPECT_NE(page.find("<h1>3 unexpected, 0 expected findings</h1>"), std::string::npos);
}

TEST(StressReport, TheTerminalHearsOfWhatIsUnexpectedAndHowToRepeatIt) {
  const std::string text = formatReport(makeReport());
  EXPECT_EQ(text.find("UNEXPECTED"), 0u);
  EXPECT_NE(text.find("parity stress --at planted<&>:"), std::string::npos) << text;
  EXPECT_NE(text.find("skipped: fp16 on the device"), std::string::npos);
  EXPECT_NE(text.find("3 unexpected, 0 expected"), std::string::npos);
}

TEST(StressReport, UnexpectedFindingsComeFirst) {
  std::vector<Finding> findings(3);
  findings[0].subject = "b", findings[0].expected = true;
  findings[1].subject = "z";
  findings[2].subject = "a", findings[2].expected = true;
  sortFindings(findings);
  EXPECT_EQ(findings[0].subject, "z");
  EXPECT_EQ(findings[1].subject, "a");
}

TEST(StressReport, AGlobThatMatchesNothingIsRefused) {
  Options options;
  options.points = {.points = 0, .devicePoints = 0};
  options.renders = false;
  options.functionGlob = "nothing*";
  EXPECT_THROW(runStress(options, {}), base::Error);
  options.functions = false;
  options.renders = true;
  options.renderGlob = "nothing*";
  EXPECT_THROW(runStress(options, {}), base::Error);
}

} // namespace
} // namespace parity::tests
