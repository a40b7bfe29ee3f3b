#include "report/csv.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/text/shown_text.h"
#include "report/wording.h"

namespace parity::report {
namespace {

// Figures that any line has, in the order in which they are met: columns.
class Columns {
public:
  void note(const compare::Figures& figures) {
    for (const compare::Figure& figure : figures.values)
      if (std::ranges::count(m_names, figure.name) == 0) m_names.push_back(figure.name);
  }
  std::string titles(const std::string& prefix) const {
    std::string text;
    for (const std::string& name : m_names) text += ',' + base::csvCell(prefix + name);
    return text;
  }
  std::string cells(const compare::Figures* figures) const {
    std::string text;
    for (const std::string& name : m_names) {
      const auto value = figures && figures->pixels > 0 ? figures->find(name) : std::nullopt;
      text += value ? fmt::format(",{}", *value) : ",";
    }
    return text;
  }
  std::size_t count() const { return m_names.size(); }

private:
  std::vector<std::string> m_names;
};

// What a line is about.
struct Line {
  std::string kind, material; // "whole" or "material"
  compare::Verdict verdict;
  const compare::Figures& figures;
  const std::optional<compare::Truth>& truth;
  std::string cause, reason;
};

class CsvTable {
public:
  explicit CsvTable(const Report& report) {
    for (const SceneResult& scene : report.scenes)
      for (const ViewResult& view : scene.views)
        for (const Line& line : linesOf(view)) {
          m_figures.note(line.figures);
          if (!line.truth) continue;
          m_referenceTruth.note(line.truth->figures.reference);
          m_testTruth.note(line.truth->figures.test);
        }
  }

  std::string text(const Report& report) const {
    std::string out = "scene,view,environment,reference,test,kind,material,verdict,pixels,non_finite" +
                      m_figures.titles("") + m_referenceTruth.titles("reference_to_truth.") +
                      m_testTruth.titles("test_to_truth.") + ",cause,reason\r\n";
    for (const SceneResult& scene : report.scenes) {
      for (const ViewResult& view : scene.views)
        for (const Line& line : linesOf(view)) out += row(scene, view, line);
      if (!scene.error.empty()) out += failedRow(scene);
    }
    return out;
  }

private:
  static std::string whyOf(const std::string& reason, const std::string& accepted) {
    if (accepted.empty()) return reason;
    return (reason.empty() ? "accepted: " : reason + "; accepted: ") + accepted;
  }

  static std::vector<Line> linesOf(const ViewResult& view) {
    std::vector<Line> lines = {{.kind = "whole",
                                .material = "",
                                .verdict = view.wholeVerdict,
                                .figures = view.whole,
                                .truth = view.truth,
                                .cause = "",
                                .reason = whyOf(view.reason, view.accepted)}};
    for (const MaterialResult& each : view.materials)
      lines.push_back({.kind = "material",
                       .material = each.name,
                       .verdict = each.verdict,
                       .figures = each.figures,
                       .truth = each.truth,
                       .cause = describeCauses(each, view.reference),
                       .reason = whyOf(each.reason, each.accepted)});
    return lines;
  }

  std::string row(const SceneResult& scene, const ViewResult& view, const Line& line) const {
    const compare::TruthFigures* truth = line.truth ? &line.truth->figures : nullptr;
    return fmt::format(
        "{},{},{},{},{},{},{},{},{},{}{}{}{},{},{}\r\n", base::csvCell(scene.name), base::csvCell(view.name),
        base::csvCell(scene.environment), base::csvCell(view.reference), base::csvCell(view.test), line.kind,
        base::csvCell(line.material), nameOf(line.verdict), line.figures.pixels, line.figures.nonFinite,
        m_figures.cells(&line.figures), m_referenceTruth.cells(truth ? &truth->reference : nullptr),
        m_testTruth.cells(truth ? &truth->test : nullptr), base::csvCell(line.cause), base::csvCell(line.reason));
  }

  // A scene that failed, behind what was compared before it did.
  std::string failedRow(const SceneResult& scene) const {
    const std::size_t figures = m_figures.count() + m_referenceTruth.count() + m_testTruth.count();
    return fmt::format("{},,{},,,scene,,{},,{},,{}\r\n", base::csvCell(scene.name), base::csvCell(scene.environment),
                       nameOf(scene.verdict), std::string(figures, ','), base::csvCell(scene.error));
  }

  Columns m_figures, m_referenceTruth, m_testTruth;
};

} // namespace

std::string toCsv(const Report& report) { return CsvTable(report).text(report); }

} // namespace parity::report
