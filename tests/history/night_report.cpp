#include "history/night_report.h"

namespace parity::tests {

report::Report reportOf(const history::RunRecord& record) {
  report::Report report;
  report.suite = record.suite;
  for (const history::SceneRecord& each : record.scenes) {
    report::SceneResult& scene = report.scenes.emplace_back();
    scene.name = each.name;
    for (const history::ViewRecord& kept : each.views) {
      report::ViewResult& view = scene.views.emplace_back();
      view.name = kept.name, view.wholeVerdict = kept.whole.verdict;
      for (const history::RowRecord& row : kept.materials) {
        report::MaterialResult& material = view.materials.emplace_back();
        material.name = row.name, material.verdict = row.verdict, material.rule.owner = "lighting";
      }
    }
  }
  return report;
}

} // namespace parity::tests
