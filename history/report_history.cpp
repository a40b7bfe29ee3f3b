#include "history/report_history.h"

#include <algorithm>
#include <set>

#include "history/index.h"
#include "history/pictures.h"

namespace parity::history {

namespace {

std::string fileOf(const std::string& hash) { return hash.empty() ? "" : "approved/" + hash + ".png"; }

// A figure that is approved, whether or not it still is.
const compare::CheckResult* approvedCheck(const std::vector<compare::CheckResult>& checks) {
  const auto found = std::ranges::find_if(checks, [](const auto& check) { return check.approval.has_value(); });
  return found == checks.end() ? nullptr : &*found;
}

std::string lineOf(base::JsonWriter& json) {
  std::string text = json.finish();
  text.pop_back(); // the line feed
  return text;
}

} // namespace

ReportHistory::ReportHistory(const std::filesystem::path& folder, const report::Report& report,
                             const std::string& started)
    : m_store(folder, Store::For::reading), m_before(runsBefore(m_store.index(), report.suite, started)),
      m_rows(m_store.index(), m_before), m_trends(m_store.index(), m_before.lanes),
      m_subject(m_store.index().prepare(
          "SELECT id FROM subject WHERE suite=? AND scene=? AND view=? AND material=? AND ordinal=?")) {
  findApproved(report);
}

void ReportHistory::findApproved(const report::Report& report) {
  ApprovedStates states(m_store.index(), m_store.folder());
  const auto add = [&](const RowName& row, const std::vector<compare::CheckResult>& checks) {
    const compare::CheckResult* check = approvedCheck(checks);
    if (!check) return;
    for (ApprovedState& state : states.find(row, check->metric, check->approval->value))
      if (std::ranges::binary_search(m_before.runs, state.run)) {
        m_approved.emplace(row, std::move(state));
        return;
      }
  };
  for (const report::SceneResult& scene : report.scenes)
    for (const report::ViewResult& view : scene.views) {
      add(nameOf(scene, view, nullptr), view.checks);
      for (const report::MaterialResult& material : view.materials)
        add(nameOf(scene, view, &material), material.checks);
    }
}

std::string ReportHistory::runsJson() const {
  base::JsonWriter json(base::JsonLayout::compact);
  json.beginObject();
  json.key("format").integer(kPageFormat);
  json.key("suite").text(m_before.suite);
  json.key("branch").text(m_before.branch);
  json.key("runs").beginArray();
  for (const std::int64_t id : m_before.runs) {
    const RunRef run = findRun(m_store.index(), id);
    json.beginObject();
    json.key("name").text(run.name);
    json.key("started").text(run.started);
    json.key("commit").text(run.commit);
    json.key("verdict").text(run.verdict);
    json.endObject();
  }
  json.endArray();
  json.endObject();
  return lineOf(json);
}

void ReportHistory::writeRow(base::JsonWriter& json, const RowName& row, std::int64_t sceneId) const {
  m_subject.bind(m_before.suite, row.scene, row.view, row.material, row.ordinal);
  if (!m_subject.step()) return json.null();
  const Trend trend = m_trends.read(m_subject.integer(0), sceneId);
  if (trend.states.empty()) return json.null();
  json.beginObject();
  writeTrend(json, trend, m_before.runs);
  if (const auto approved = m_approved.find(row); approved != m_approved.end()) {
    const auto run = std::ranges::lower_bound(m_before.runs, approved->second.run);
    json.key("approved").beginObject();
    json.key("run").integer(run - m_before.runs.begin());
    json.key("images").beginObject();
    json.key("reference").text(fileOf(approved->second.pictures.reference));
    json.key("test").text(fileOf(approved->second.pictures.test));
    json.key("flip").text(fileOf(approved->second.pictures.flip));
    json.endObject();
    json.endObject();
  }
  json.endObject();
}

std::string ReportHistory::trendsJson(const report::SceneResult& scene) const {
  const std::lock_guard lock(m_mutex);
  m_subject.bind(m_before.suite, scene.name, "", "", kScene);
  const std::int64_t sceneId = m_subject.step() ? m_subject.integer(0) : 0;
  base::JsonWriter json(base::JsonLayout::compact);
  json.beginObject();
  json.key("views").beginArray();
  for (const report::ViewResult& view : scene.views) {
    json.beginArray();
    for (const report::MaterialResult& material : view.materials)
      writeRow(json, nameOf(scene, view, &material), sceneId);
    writeRow(json, nameOf(scene, view, nullptr), sceneId);
    json.endArray();
  }
  json.endArray();
  json.endObject();
  return lineOf(json);
}

std::vector<report::ApprovedPicture> ReportHistory::approvedPictures() const {
  std::set<std::string> hashes;
  for (const auto& [row, state] : m_approved)
    for (const std::string* hash : {&state.pictures.reference, &state.pictures.test, &state.pictures.flip})
      if (!hash->empty()) hashes.insert(*hash);
  std::vector<report::ApprovedPicture> pictures;
  for (const std::string& hash : hashes) pictures.push_back({fileOf(hash), pictureFile(m_store.folder(), hash)});
  return pictures;
}

} // namespace parity::history
