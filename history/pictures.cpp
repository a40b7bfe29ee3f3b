#include "history/pictures.h"

#include <functional>
#include <set>
#include <system_error>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "history/approved_states.h"
#include "history/index.h"
#include "history/run_file.h"

namespace parity::history {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFolder = "pictures";
constexpr std::size_t kDigits = 32;

class Keeper {
public:
  Keeper(const fs::path& history, const fs::path& reportFolder) : m_history(history), m_report(reportFolder) {}

  PictureHashes keep(const report::ImageSet& images) {
    return {keep(images.reference), keep(images.test), keep(images.flip)};
  }

private:
  std::string keep(const std::string& file) {
    std::error_code none;
    if (file.empty() || !fs::is_regular_file(m_report / file, none)) return {};
    const std::vector<std::byte> bytes = base::readFile(m_report / file);
    std::string hash = base::Hasher().add(bytes).hex();
    base::writeOnce(pictureFile(m_history, hash), bytes);
    return hash;
  }

  const fs::path &m_history, &m_report;
};

bool isKept(KeptPictures which, compare::Verdict verdict) {
  using enum compare::Verdict;
  return which == KeptPictures::all ||
         (which == KeptPictures::notPassed && (verdict == warn || verdict == fail || verdict == error));
}

void addHashes(std::set<std::string>& to, const PictureHashes& hashes) {
  for (const std::string* hash : {&hashes.reference, &hashes.test, &hashes.flip})
    if (!hash->empty()) to.insert(*hash);
}

// Calls visit(scene, view, row); a whole image is a row, too.
void forEachRow(const RunRecord& record,
                const std::function<void(const SceneRecord&, const ViewRecord&, const RowRecord&)>& visit) {
  for (const SceneRecord& scene : record.scenes)
    for (const ViewRecord& view : scene.views) {
      visit(scene, view, view.whole);
      for (const RowRecord& row : view.materials) visit(scene, view, row);
    }
}

// Of runs that are recent all, of others those of rows whose interval ends there; of namesakes all.
std::set<std::string> hashesInUse(const Database& index, const fs::path& history, const std::string& since) {
  std::set<std::string> used;
  Statement first = index.prepare("SELECT reference, test, flip FROM state");
  while (first.step()) addHashes(used, {first.text(0), first.text(1), first.text(2)});
  Statement runs = index.prepare("SELECT id, name, started>=?1 FROM run WHERE started>=?1 OR "
                                 "id IN (SELECT last_run FROM state WHERE last_run IS NOT NULL) OR "
                                 "id IN (SELECT max(id) FROM run GROUP BY lane) ORDER BY id");
  Statement ends =
      index.prepare("SELECT scene, view, material FROM state JOIN subject ON subject.id=subject WHERE last_run=?1 "
                    "OR (last_run IS NULL AND lane=(SELECT lane FROM run WHERE id=?1) AND "
                    "?1=(SELECT max(id) FROM run AS r WHERE r.lane=state.lane))");
  runs.bind(since);
  while (runs.step()) {
    const RunRecord record = readRunFile(runFile(history, runs.text(1)));
    if (runs.integer(2) != 0) {
      forEachRow(record,
                 [&](const SceneRecord&, const ViewRecord&, const RowRecord& row) { addHashes(used, row.pictures); });
      continue;
    }
    std::set<std::string> rows;
    ends.bind(runs.integer(0));
    while (ends.step()) rows.insert(ends.text(0) + '\0' + ends.text(1) + '\0' + ends.text(2));
    forEachRow(record, [&](const SceneRecord& scene, const ViewRecord& view, const RowRecord& row) {
      if (rows.contains(scene.name + '\0' + view.name + '\0' + row.name)) addHashes(used, row.pictures);
    });
  }
  return used;
}

} // namespace

fs::path pictureFile(const fs::path& history, const std::string& hash) {
  return history / kFolder / hash.substr(0, 2) / (hash + ".png");
}

void keepPictures(const fs::path& history, const fs::path& reportFolder, const report::Report& report,
                  KeptPictures which, RunRecord& record) {
  if (which == KeptPictures::none) return;
  Keeper keeper(history, reportFolder);
  for (std::size_t s = 0; s < report.scenes.size(); ++s)
    for (std::size_t v = 0; v < report.scenes[s].views.size(); ++v) {
      const report::ViewResult& view = report.scenes[s].views[v];
      ViewRecord& kept = record.scenes[s].views[v];
      if (isKept(which, kept.whole.verdict)) kept.whole.pictures = keeper.keep(view.images);
      for (std::size_t m = 0; m < view.materials.size(); ++m)
        if (isKept(which, kept.materials[m].verdict)) kept.materials[m].pictures = keeper.keep(view.materials[m].crops);
    }
}

Collected collectPictures(const Database& index, const fs::path& history, const std::string& since,
                          const compare::Approvals& approvals, bool isTrial) {
  std::set<std::string> used = hashesInUse(index, history, since);
  ApprovedStates states(index, history);
  Statement namesakes = index.prepare("SELECT DISTINCT ordinal FROM subject WHERE scene=? AND view=? AND material=?");
  for (const compare::Approval& each : approvals.entries) {
    std::vector<int> ordinals; // an approval is of all of a name
    namesakes.bind(each.scene, each.view, each.material);
    while (namesakes.step()) ordinals.push_back(static_cast<int>(namesakes.integer(0)));
    for (const int ordinal : ordinals)
      for (const ApprovedState& state :
           states.find({each.scene, each.view, each.material, ordinal}, each.metric, each.value))
        addHashes(used, state.pictures);
  }
  Collected collected;
  std::error_code error;
  const fs::path folder = history / kFolder;
  if (!fs::is_directory(folder, error)) return collected;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string stem = entry->path().stem().string();
    if (!entry->is_regular_file(error) || stem.size() != kDigits) continue; // what others have put there stays
    const std::uintmax_t bytes = entry->file_size(error);
    const bool isUsed = used.contains(stem);
    ++(isUsed ? collected.kept : collected.removed);
    (isUsed ? collected.keptBytes : collected.removedBytes) += bytes;
    if (!isUsed && !isTrial && !error) fs::remove(entry->path(), error);
  }
  if (error) throw base::fileError(folder.string(), "", error.message());
  return collected;
}

} // namespace parity::history
