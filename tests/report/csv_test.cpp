// The report as a table for spreadsheets.
#include <algorithm>

#include <gtest/gtest.h>

#include "base/lines_of.h"
#include "report/csv.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

using Row = std::vector<std::string>;

// RFC 4180, a row a line; the quotes are gone.
std::vector<Row> readCsv(const std::string& text) {
  std::vector<Row> rows;
  for (const std::string& line : tests::linesOf(text)) {
    EXPECT_TRUE(line.ends_with('\r')) << line;
    Row& row = rows.emplace_back(1);
    bool isQuoted = false;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      if (line[i] == '"' && isQuoted && line[i + 1] == '"')
        row.back() += line[++i];
      else if (line[i] == '"')
        isQuoted = !isQuoted;
      else if (line[i] == ',' && !isQuoted)
        row.emplace_back();
      else
        row.back() += line[i];
    }
  }
  return rows;
}

std::string cellOf(const std::vector<Row>& rows, const Row& row, const std::string& title) {
  const auto column = std::ranges::find(rows.front(), title);
  return column == rows.front().end() ? "no column " + title
                                      : row.at(static_cast<std::size_t>(column - rows.front().begin()));
}

TEST(ReportCsv, HasARowForEachWholeImageMaterialAndFailedScene) {
  const Report report = makeSampleReportWithTruth();
  const std::vector<Row> rows = readCsv(toCsv(report));
  std::size_t expected = 1;
  for (const SceneResult& scene : report.scenes) {
    expected += scene.error.empty() ? 0 : 1;
    for (const ViewResult& view : scene.views) expected += 1 + view.materials.size();
  }
  ASSERT_EQ(rows.size(), expected);
  for (const Row& row : rows) EXPECT_EQ(row.size(), rows.front().size()) << row.front();

  const MaterialResult& metal = report.scenes[0].views[0].materials[1];
  const auto found =
      std::ranges::find_if(rows, [&](const Row& row) { return cellOf(rows, row, "material") == metal.name; });
  ASSERT_NE(found, rows.end());
  EXPECT_EQ(cellOf(rows, *found, "scene"), "Lamp");
  EXPECT_EQ(cellOf(rows, *found, "view"), "front");
  EXPECT_EQ(cellOf(rows, *found, "kind"), "material");
  EXPECT_EQ(cellOf(rows, *found, "environment"), "studio_small_05_1k.hdr");
  EXPECT_EQ(cellOf(rows, *found, "verdict"), "fail");
  EXPECT_EQ(cellOf(rows, *found, "pixels"), "120000");
  EXPECT_EQ(std::stod(cellOf(rows, *found, "flip.mean")), *metal.figures.find("flip.mean"));
  EXPECT_EQ(std::stod(cellOf(rows, *found, "reference_to_truth.flip.mean")),
            *metal.truth->figures.reference.find("flip.mean"));
  EXPECT_NE(cellOf(rows, *found, "cause").find("skySpecular"), std::string::npos);
  EXPECT_EQ(cellOf(rows, *found, "reason"), metal.reason);
  EXPECT_EQ(cellOf(rows, rows.back(), "kind"), "scene");
  EXPECT_EQ(cellOf(rows, rows.back(), "verdict"), "error");
  EXPECT_NE(cellOf(rows, rows.back(), "reason"), "");
}

TEST(ReportCsv, HoldsNoFormulaAndNoControl) {
  const std::vector<Row> rows =
      readCsv(toCsv(makeSampleReport({"=1+1", "@SUM(A1)", "-cmd|' /C calc'!A0", "a\x1b[31m,\"b\""})));
  std::size_t guarded = 0;
  for (const Row& row : rows)
    for (const std::string& cell : row) {
      EXPECT_EQ(cell.find('\x1b'), std::string::npos);
      EXPECT_FALSE(cell.starts_with('=') || cell.starts_with('@')) << cell;
      guarded += cell == "'=1+1" || cell == "'@SUM(A1)";
    }
  EXPECT_GT(guarded, 1u) << "the names are not there";
}

} // namespace
} // namespace parity::report
