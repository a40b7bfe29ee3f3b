#include "history/row_history.h"

#include <algorithm>
#include <vector>

#include "history/index.h"
#include "history/subject.h"

namespace parity::history {

namespace {

constexpr std::size_t kFlakyRuns = 14;

// The first run of those, without a gap up to the newest one, in which the row failed; nothing: it does not fail there.
std::optional<std::int64_t> failsSince(const std::vector<Interval>& states) {
  std::optional<std::int64_t> since;
  for (auto state = states.rbegin(); state != states.rend() && isFailing(state->verdict); ++state)
    since = state->firstRun;
  return since;
}

} // namespace

RowHistory::RowHistory(const Database& index, const RunsBefore& before) : m_isEmpty(before.runs.empty()) {
  if (m_isEmpty) return;
  const std::vector<std::int64_t>& runs = before.runs;
  Statement failing = index.prepare(
      "SELECT id, scene, view, material, ordinal FROM subject WHERE suite=?1 AND ordinal!=?2 AND id IN (SELECT subject "
      "FROM state WHERE verdict IN ('fail','error') AND first_run<=?3 AND (last_run IS NULL OR last_run>=?3))");
  failing.bind(before.suite, kScene, runs.back());
  while (failing.step())
    if (const auto since = failsSince(statesOf(index, before.lanes, failing.integer(0))))
      m_rows[{failing.text(1), failing.text(2), failing.text(3), static_cast<int>(failing.integer(4))}].nights =
          static_cast<std::size_t>(runs.end() - std::ranges::lower_bound(runs, *since));
  Statement alarms = index.prepare(
      "SELECT DISTINCT scene, view, material, ordinal, run FROM event JOIN subject ON subject.id=event.subject WHERE "
      "suite=? AND kind IN ('nondeterministic','crashed') AND run BETWEEN ? AND ?");
  alarms.bind(before.suite, runs[runs.size() - std::min(runs.size(), kFlakyRuns)], runs.back());
  while (alarms.step())
    if (std::ranges::binary_search(runs, alarms.integer(4))) // runs of other branches lie between them
      m_rows[{alarms.text(0), alarms.text(1), alarms.text(2), static_cast<int>(alarms.integer(3))}].isFlaky = true;
}

const RowHistory::Known& RowHistory::find(const RowName& name) const {
  static const Known kNothing;
  const auto found = m_rows.find(name);
  return found == m_rows.end() ? kNothing : found->second;
}

report::RowStanding RowHistory::of(const report::SceneResult& scene, const report::ViewResult& view,
                                   const report::MaterialResult* material) const {
  report::RowStanding row = report::standingOf(view, material);
  if (m_isEmpty || (material && material->seenElsewhere) || row.standing == report::Standing::accepted) return row;
  const Known& known = find(nameOf(scene, view, material));
  const compare::Verdict verdict = material ? material->verdict : view.wholeVerdict;
  row.nights = 0;
  if (report::isFailure(verdict)) {
    row.nights = known.nights + 1;
    const bool isFlaky = known.isFlaky || find({scene.name, "", "", kScene}).isFlaky;
    row.standing = isFlaky            ? report::Standing::flaky
                   : known.nights > 0 ? report::Standing::still
                                      : report::Standing::isNew;
  } else {
    const bool isFine = verdict == compare::Verdict::pass || verdict == compare::Verdict::warn;
    row.standing = isFine && known.nights > 0 ? report::Standing::fixed : report::Standing::none;
  }
  return row;
}

} // namespace parity::history
