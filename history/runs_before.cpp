#include "history/runs_before.h"

#include "history/index.h"

namespace parity::history {

RunsBefore runsBefore(const Database& index, const std::string& suite, const std::string& started) {
  RunsBefore before{suite, settled(index, {suite, std::nullopt}).branch.value_or(""), {}, {}};
  Statement all = index.prepare("SELECT id FROM run WHERE suite=? AND branch=? AND lane IS NOT NULL AND started<? "
                                "ORDER BY id");
  all.bind(suite, before.branch, started);
  while (all.step()) before.runs.push_back(all.integer(0));
  if (!before.runs.empty()) before.lanes = lanesUpTo(index, before.runs.back());
  return before;
}

RowName nameOf(const report::SceneResult& scene, const report::ViewResult& view,
               const report::MaterialResult* material) {
  if (!material) return {scene.name, view.name, "", kWhole};
  int ordinal = 0;
  for (const report::MaterialResult& each : view.materials) {
    if (&each == material) break;
    ordinal += each.name == material->name ? 1 : 0;
  }
  return {scene.name, view.name, material->name, ordinal};
}

} // namespace parity::history
