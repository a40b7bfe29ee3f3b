#include "history/approved_states.h"

#include <algorithm>

#include "history/index.h"
#include "history/run_file.h"

namespace parity::history {

ApprovedStates::ApprovedStates(const Database& index, const std::filesystem::path& history)
    : m_index(index), m_history(history),
      // Both have four significant digits, by different ways.
      m_runs(index.prepare("SELECT DISTINCT first_run FROM value JOIN subject ON subject.id=value.subject JOIN metric "
                           "ON metric.id=value.metric WHERE scene=?1 AND view=?2 AND material=?3 AND ordinal=?4 AND "
                           "name=?5 AND abs(v-?6)<=1e-9*abs(?6) ORDER BY first_run DESC")) {}

std::vector<ApprovedState> ApprovedStates::find(const RowName& row, const std::string& metric, double value) {
  std::vector<std::int64_t> runs;
  m_runs.bind(row.scene, row.view, row.material, row.ordinal, metric, value);
  while (m_runs.step()) runs.push_back(m_runs.integer(0));
  std::vector<ApprovedState> states;
  for (const std::int64_t run : runs)
    if (const PictureHashes* pictures = picturesOf(run, row)) states.push_back({run, *pictures});
  return states;
}

// Null: the run has none of the row.
const PictureHashes* ApprovedStates::picturesOf(std::int64_t run, const RowName& row) {
  auto record = m_records.find(run);
  if (record == m_records.end()) {
    Statement name = m_index.prepare("SELECT name FROM run WHERE id=?");
    if (!name.bind(run).step()) return nullptr;
    record = m_records.emplace(run, readRunFile(runFile(m_history, name.text(0)))).first;
  }
  const auto scene = std::ranges::find(record->second.scenes, row.scene, &SceneRecord::name);
  if (scene == record->second.scenes.end()) return nullptr;
  const auto view = std::ranges::find(scene->views, row.view, &ViewRecord::name);
  if (view == scene->views.end()) return nullptr;
  int ordinal = 0;
  const RowRecord* found = row.ordinal == kWhole ? &view->whole : nullptr;
  for (const RowRecord& each : view->materials)
    if (row.ordinal != kWhole && each.name == row.material && ordinal++ == row.ordinal) found = &each;
  return found && !found->pictures.test.empty() ? &found->pictures : nullptr;
}

} // namespace parity::history
