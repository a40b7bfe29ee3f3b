#include "history/row_history.h"

#include <algorithm>
#include <vector>

#include "history/index.h"
#include "history/subject.h"

namespace parity::history {

namespace {

constexpr std::int64_t kFlakyRuns = 14;

bool isFailing(const std::string& verdict) {
  return verdict == nameOf(compare::Verdict::fail) || verdict == nameOf(compare::Verdict::error);
}

// The first run of those, without a gap up to `newest`, in which the row failed; nothing: it does not fail there.
std::optional<std::int64_t> failsSince(std::vector<Interval> states, std::int64_t newest) {
  while (!states.empty() && states.back().firstRun > newest) states.pop_back();
  std::optional<std::int64_t> since;
  for (auto state = states.rbegin(); state != states.rend() && isFailing(state->verdict); ++state)
    since = state->firstRun;
  return since;
}

// Of namesakes in a view the number of this one, from 0; a whole image has a number of its own.
int ordinalOf(const report::ViewResult& view, const report::MaterialResult* material) {
  if (!material) return kWhole;
  int ordinal = 0;
  for (const report::MaterialResult& each : view.materials) {
    if (&each == material) break;
    ordinal += each.name == material->name ? 1 : 0;
  }
  return ordinal;
}

} // namespace

RowHistory::RowHistory(const Database& index, const report::Report& report, const std::string& started) {
  const Where where = settled(index, {report.suite, std::nullopt});
  Statement last = index.prepare("SELECT id, lane FROM run WHERE suite=? AND branch=? AND lane IS NOT NULL AND "
                                 "started<? ORDER BY id DESC LIMIT 1");
  if (!last.bind(report.suite, where.branch.value_or(""), started).step()) return;
  const std::int64_t newest = last.integer(0);
  m_isEmpty = false;
  const std::vector<LaneSpan> lanes = lanesOf(index, report.suite, where.branch);
  Statement failing = index.prepare(
      "SELECT id, scene, view, material, ordinal FROM subject WHERE suite=?1 AND ordinal!=?2 AND id IN (SELECT subject "
      "FROM state WHERE verdict IN ('fail','error') AND first_run<=?3 AND (last_run IS NULL OR last_run>=?3))");
  Statement runs = index.prepare("SELECT count(*) FROM run WHERE suite=? AND branch=? AND lane IS NOT NULL AND id>=? "
                                 "AND id<=?");
  failing.bind(report.suite, kScene, newest);
  while (failing.step()) {
    const auto since = failsSince(statesOf(index, lanes, failing.integer(0)), newest);
    if (!since || !runs.bind(report.suite, where.branch.value_or(""), *since, newest).step()) continue;
    m_rows[{failing.text(1), failing.text(2), failing.text(3), static_cast<int>(failing.integer(4))}].nights =
        static_cast<std::size_t>(runs.integer(0));
  }
  Statement alarms = index.prepare("SELECT DISTINCT scene, view, material, ordinal FROM event JOIN subject ON "
                                   "subject.id=event.subject WHERE suite=?1 "
                                   "AND kind IN ('nondeterministic','crashed') AND run<=?2 AND run>(SELECT "
                                   "coalesce(min(id),0)-1 FROM (SELECT id FROM "
                                   "run WHERE suite=?1 AND branch=?3 AND id<=?2 ORDER BY id DESC LIMIT ?4))");
  alarms.bind(report.suite, newest, where.branch.value_or(""), kFlakyRuns);
  while (alarms.step())
    m_rows[{alarms.text(0), alarms.text(1), alarms.text(2), static_cast<int>(alarms.integer(3))}].isFlaky = true;
}

report::RowStanding RowHistory::of(const report::SceneResult& scene, const report::ViewResult& view,
                                   const report::MaterialResult* material) const {
  report::RowStanding row = report::standingOf(view, material);
  if (m_isEmpty || (material && material->seenElsewhere) || row.standing == report::Standing::accepted) return row;
  const auto find = [&](const Key& key) {
    const auto found = m_rows.find(key);
    return found == m_rows.end() ? Known() : found->second;
  };
  const Known known = find({scene.name, view.name, material ? material->name : "", ordinalOf(view, material)});
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
