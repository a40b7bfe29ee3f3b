#include "history/store.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/temporary_name.h"
#include "history/index.h"
#include "history/run_file.h"
#include "history/schema.h"

namespace parity::history {

namespace fs = std::filesystem;

namespace {

constexpr const char *kLockFile = "lock", *kNewIndex = "index.sqlite.new",
                     *kIsWritten = "another process writes this history; try again when it is done";

std::vector<std::string> namesIn(const Database& index) {
  std::vector<std::string> names;
  Statement all = index.prepare("SELECT name FROM run ORDER BY id");
  while (all.step()) names.push_back(all.text(0));
  return names;
}

// What an index has of these runs: all of the first ones, in their order, and nothing else; else nothing of use.
std::optional<std::size_t> countIndexed(const Database& index, const std::vector<std::string>& runs) {
  if (schemaOf(index) != kIndexSchema) return std::nullopt;
  const std::vector<std::string> names = namesIn(index);
  const bool isBegin = names.size() <= runs.size() && std::equal(names.begin(), names.end(), runs.begin());
  return isBegin ? std::optional(names.size()) : std::nullopt;
}

void requireKnownSchema(const Database& index) {
  if (const int schema = schemaOf(index); schema > kIndexSchema)
    throw base::fileError(index.file().string(), "",
                          fmt::format("is of schema {}, from a newer version of parity; this one knows {}; use that "
                                      "version, or 'parity history rebuild'",
                                      schema, kIndexSchema));
}

void addRuns(const Database& database, const fs::path& folder, const std::vector<std::string>& runs, std::size_t from) {
  Index index(database);
  constexpr std::size_t kAtOnce = 50; // runs a transaction
  for (std::size_t i = from; i < runs.size();) {
    Transaction transaction(database);
    for (const std::size_t end = std::min(runs.size(), i + kAtOnce); i < end; ++i)
      index.add(readRunFile(runFile(folder, runs[i])), runs[i]);
    transaction.commit();
  }
}

// Of a process that was killed, or that writes just now.
bool hasJournal(const fs::path& index) {
  std::error_code none;
  const std::uintmax_t bytes = fs::file_size(index.string() + "-journal", none);
  return !none && bytes > 0;
}

// A reader waits for a writer: it takes a second at most.
void lockPatiently(std::optional<base::FileLock>& lock, const fs::path& folder) {
  constexpr int kTries = 200;
  constexpr std::chrono::milliseconds kPause(50);
  for (int i = 1;; ++i) {
    try {
      lock.emplace(folder / kLockFile, folder.string(), kIsWritten);
      return;
    } catch (const base::Error&) {
      if (i == kTries) throw;
      std::this_thread::sleep_for(kPause);
    }
  }
}

void removeIndex(const fs::path& file) {
  std::error_code none;
  for (const char* end : {"", "-journal", "-wal", "-shm"}) fs::remove(file.string() + end, none);
}

// What a killed process has not given its name yet; nobody else writes.
void removeLeftovers(const fs::path& folder) {
  std::error_code none;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / kRunFolder, none))
    if (base::ownNameOf(entry.path().filename().string())) files.push_back(entry.path());
  for (const fs::path& file : files) fs::remove(file, none);
  removeIndex(folder / kNewIndex);
}

} // namespace

namespace {

// What a run says of itself, whatever was told when it was added.
std::string contentOf(RunRecord record) {
  record.report.clear(), record.branch.clear(), record.commit.clear(), record.commitTime.clear();
  for (SceneRecord& scene : record.scenes)
    for (ViewRecord& view : scene.views) {
      view.whole.pictures = {};
      for (RowRecord& row : view.materials) row.pictures = {};
    }
  return encodeRun(record).id;
}

// A run of the same second with the same content: it was added by another command, or from another folder.
std::optional<std::string> findSame(const fs::path& folder, const std::vector<std::string>& runs,
                                    const RunRecord& record, const std::string& id) {
  const std::string second = id.substr(0, id.find('-') + 1);
  for (const std::string& each : runs)
    if (each.starts_with(second) && each != id && contentOf(readRunFile(runFile(folder, each))) == contentOf(record))
      return each;
  return std::nullopt;
}

} // namespace

Store::Store(const fs::path& folder, For purpose) : m_folder(folder) {
  std::error_code error;
  if (purpose == For::writing) {
    fs::create_directories(folder / kRunFolder, error);
    if (error) throw base::fileError(folder.string(), "cannot be created as a folder", error.message());
  } else if (!fs::is_directory(folder / kRunFolder, error)) {
    throw base::fileError(folder.string(), "",
                          "is no history: it has no folder 'runs'; 'parity history add' makes one");
  }
  if (purpose != For::reading) m_lock.emplace(folder / kLockFile, folder.string(), kIsWritten);
  if (m_lock) removeLeftovers(folder);
  if (purpose != For::rebuilding) update();
}

// A reader of an index that is up to date takes no lock, and writes nothing.
void Store::update() {
  std::vector<std::string> runs = listRuns(m_folder);
  const fs::path file = m_folder / kIndexFile;
  std::error_code none;
  if (fs::exists(file, none) && !hasJournal(file)) {
    const Database index(file, Access::read);
    requireKnownSchema(index);
    if (const auto count = countIndexed(index, runs); count == runs.size()) {
      m_index.emplace(file, m_lock ? Access::write : Access::read);
      return;
    }
  }
  std::optional<base::FileLock> lock;
  if (!m_lock) {
    lockPatiently(lock, m_folder);
    runs = listRuns(m_folder); // another process may have added one meanwhile
  }
  const bool isThere = fs::exists(file, none);
  std::optional<std::size_t> known;
  if (isThere) {
    const Database index(file, Access::write); // rolls back what a killed process has left
    requireKnownSchema(index);
    known = countIndexed(index, runs);
    if (known && *known < runs.size()) {
      base::logInfo(fmt::format("{}: {} run{} added to the index", m_folder.string(), runs.size() - *known,
                                runs.size() - *known == 1 ? " is" : "s are"));
      addRuns(index, m_folder, runs, *known);
    }
  }
  if (!known) {
    if (isThere || !runs.empty())
      base::logInfo(fmt::format("{}: the index is made anew from {} runs", m_folder.string(), runs.size()));
    makeIndex(runs);
  }
  m_index.emplace(file, m_lock ? Access::write : Access::read);
}

// Beside the old one, which others may be reading; a killed process leaves nothing that is taken for an index.
void Store::makeIndex(const std::vector<std::string>& runs) {
  const fs::path file = m_folder / kIndexFile, made = m_folder / kNewIndex;
  removeIndex(made);
  try {
    const Database database(made, Access::write);
    database.execute("PRAGMA synchronous=OFF"); // until it has its name, nobody misses it
    createTables(database);
    addRuns(database, m_folder, runs, 0);
    database.execute("PRAGMA optimize; PRAGMA synchronous=FULL; BEGIN IMMEDIATE; PRAGMA user_version=" +
                     std::to_string(kIndexSchema) + "; COMMIT");
  } catch (...) {
    removeIndex(made);
    throw;
  }
  m_index.reset();
  removeIndex(file);
  std::error_code error;
  fs::rename(made, file, error);
  if (error) throw base::fileError(file.string(), "cannot be written", error.message());
  removeIndex(made); // its journal
}

Added Store::add(const RunRecord& record) {
  const EncodedRun run = encodeRun(record);
  const std::vector<std::string> runs = listRuns(m_folder);
  if (const std::optional<std::string> known = findSame(m_folder, runs, record, run.id)) return {*known, true};
  if (!base::writeOnce(runFile(m_folder, run.id), run.bytes)) return {run.id, true};
  try {
    if (runs.empty() || runs.back() < run.id) {
      Transaction transaction(*m_index);
      Index(*m_index).add(record, run.id);
      transaction.commit();
    } else {
      base::logInfo(fmt::format("{}: the run is older than the newest one: the index is made anew", m_folder.string()));
      rebuild();
    }
  } catch (const base::Error& error) {
    throw base::Error(error.code(), error.subject(), error.place(),
                      fmt::format("{} (the run is kept as {})", error.reason(), runFile(m_folder, run.id).string()));
  }
  return {run.id, false};
}

std::size_t Store::rebuild() {
  const std::vector<std::string> runs = listRuns(m_folder);
  makeIndex(runs);
  m_index.emplace(m_folder / kIndexFile, Access::write);
  return runs.size();
}

} // namespace parity::history
