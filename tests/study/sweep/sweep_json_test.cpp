// A sweep's files: JSON and back, CSV, the page.
#include <filesystem>

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/expect_error.h"
#include "base/file.h"
#include "report/dashboard_files.h"
#include "study/sweep/samples.h"
#include "study/sweep/sweep_json.h"
#include "study/sweep/sweep_page.h"

namespace parity::sweep {
namespace {

SweepReport makeWholeReport() {
  SweepReport report;
  report.version = "1";
  report.commandLine = "parity bench a";
  report.startedAt = "2026-01-01T00:00:00Z";
  report.machine = {"cpu <name>", "device", "driver", "cpu", "AVX2", 2};
  report.rounds = 3;
  VariantResult table = makeVariant("highend", "lut-size 8", 0, 0.5), stored = makeVariant("mobile", "8 bits", 0, 0.9);
  table.stage = Stage::preparation;
  table.prepareMs = {3, 4, 5};
  stored.stage = Stage::storage;
  report.scenes = {
      makeSceneSweep("a", {makeVariant("highend", "default", 10, 0.2), makeVariant("mobile", "default", 5, 0.3),
                           makeVariant("mobile", "x", 6, 0.4), table, stored})};
  SceneSweep broken;
  broken.scene = "<b>";
  broken.failure = "no.gltf: not there";
  report.scenes.push_back(broken);
  return report;
}

class SweepFiles : public testing::Test {
protected:
  ~SweepFiles() override { std::filesystem::remove_all(m_folder); }
  std::filesystem::path m_folder = std::filesystem::path(testing::TempDir()) / "parity-sweep-files";
};

TEST_F(SweepFiles, WhatIsWrittenReadsBack) {
  const SweepReport report = makeWholeReport();
  const std::string text = toJson(report, conclude(report, std::nullopt));
  base::writeText(m_folder / "bench.json", text);
  const SweepReport read = readSweep(m_folder / "bench.json");
  EXPECT_EQ(toJson(read, conclude(read, std::nullopt)), text);
  EXPECT_EQ(read.machine, report.machine);
  EXPECT_EQ(read.scenes[1].failure, report.scenes[1].failure);
}

TEST_F(SweepFiles, ConclusionsAreInTheFile) {
  const SweepReport report = makeWholeReport();
  const auto json = nlohmann::json::parse(toJson(report, conclude(report, ErrorBudget{"flip.mean", 0.25})));
  const auto& c = json.at("conclusions");
  EXPECT_EQ(c.at("against"), "truth");
  EXPECT_EQ(c.at("dominatedEverywhere"), nlohmann::json({"mobile: x"}));
  EXPECT_EQ(c.at("cheapest").at(0).at("setting"), "default");
  EXPECT_TRUE(c.at("cheapest").at(2).at("setting").is_null()) << "mobile has none";
  EXPECT_EQ(json.at("scenes").at(0).at("variants").at(2).at("dominated"), true);
}

TEST_F(SweepFiles, MalformedOnesAreErrorsWithTheFilesName) {
  const auto readText = [&](const std::string& text) {
    base::writeText(m_folder / "bad.json", text);
    return std::string(base::errorOf([&] { readSweep(m_folder / "bad.json"); }).what());
  };
  for (const char* text : {"", "[]", "{}", "{\"tool\":\"parity\"}", "{\"tool\":\"parity bench\",\"schema\":2}"})
    EXPECT_NE(readText(text).find("bad.json"), std::string::npos) << text;
  std::string text = toJson(makeWholeReport(), conclude(makeWholeReport(), std::nullopt));
  text.replace(text.find("\"shading\""), 9, "\"else\"");
  EXPECT_NE(readText(text).find("unknown stage"), std::string::npos);
}

TEST_F(SweepFiles, CsvHasALineForEachRegionAndAsManyFieldsAsItsHead) {
  const std::string csv = toCsv(makeWholeReport());
  std::vector<std::string> lines;
  for (std::size_t at = 0, end; (end = csv.find("\r\n", at)) != std::string::npos; at = end + 2)
    lines.push_back(csv.substr(at, end - at));
  ASSERT_EQ(lines.size(), 1u + 5 * 2);
  const auto fields = [](const std::string& line) {
    bool quoted = false;
    int count = 1;
    for (const char c : line) {
      quoted ^= c == '"';
      count += c == ',' && !quoted;
    }
    return count;
  };
  for (const std::string& line : lines) EXPECT_EQ(fields(line), fields(lines[0])) << line;
  EXPECT_NE(csv.find("\"brass, \"\"old\"\"\""), std::string::npos);
}

TEST_F(SweepFiles, TheFigureOfAnEarlierOneIsKeptAndMustBeKnown) {
  std::string text = toJson(makeWholeReport(), conclude(makeWholeReport(), ErrorBudget{"relmse", 0.1}));
  base::writeText(m_folder / "bench.json", text);
  EXPECT_EQ(readSweep(m_folder / "bench.json").figure, "relmse");
  text.replace(text.find("\"figure\": \"relmse\""), 18, "\"figure\": \"ssim\"");
  base::writeText(m_folder / "bench.json", text);
  EXPECT_THROW(readSweep(m_folder / "bench.json"), base::Error);
}

TEST_F(SweepFiles, ThePageHoldsTheSweepAndAPictureOfEachStageThatHasOne) {
  SweepReport report = makeWholeReport();
  report.scenes[0].variants.push_back(makeVariant("highend", "lut-size 9", 0, 0.4));
  report.scenes[0].variants.back().stage = Stage::preparation;
  report.scenes[0].variants.back().prepareMs = {9};
  const Conclusions conclusions = conclude(report, ErrorBudget{"flip.mean", 0.25});
  const std::string page = toPage(report, conclusions);
  if (!report::hasDashboard()) GTEST_SKIP() << "built without the page";
  const auto block = [&](const std::string& id) {
    const std::string head = "id=\"" + id + "\">";
    const std::size_t from = page.find(head) + head.size();
    return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
  };
  EXPECT_EQ(block("bench"), nlohmann::json::parse(toJson(report, conclusions)));
  const nlohmann::json plots = block("bench-plots");
  ASSERT_EQ(plots.size(), 2u);
  ASSERT_EQ(plots[0].size(), 3u);
  EXPECT_EQ(plots[0][0]["against"], "truth");
  EXPECT_EQ(plots[0][1]["against"], "highend");
  EXPECT_EQ(plots[0][2]["stage"], "preparation");
  EXPECT_TRUE(plots[1].empty()) << "it could not be measured";
}

} // namespace
} // namespace parity::sweep
