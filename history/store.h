// A history's folder: runs/ (the truth), index.sqlite (made from them), a lock. docs/history.md.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "base/file_lock.h"
#include "history/database.h"
#include "history/run.h"

namespace parity::history {

inline constexpr const char* kIndexFile = "index.sqlite";

struct Added {
  std::string id;
  bool isKnown = false; // it was in the history before: nothing was done
};

// Whoever opens a history finds an index that is up to date: one that is missing, older than the runs or of an older
// schema is made, and that is said. One process at a time writes.
class Store {
public:
  enum class For { reading, writing, collecting, rebuilding };
  // `writing` makes the folder; `collecting` takes the lock of a history that is there; `rebuilding` does the same and
  // does not look at the index. Throws Error: (exit 4) where
  // there is no history, or an index is damaged or of a newer version of parity, or it cannot be made; (exit 75) where
  // another process writes.
  Store(const std::filesystem::path& folder, For purpose);

  // Writes the run's file, then brings the index up to date; the same run again changes nothing. What fails after the
  // file is whole loses nothing. An older run is put in its place: the index is made anew. Throws Error.
  Added add(const RunRecord& record);

  // Makes the index anew from the runs; returns their number. Throws Error for a run file that is damaged, and then the
  // old index stays.
  std::size_t rebuild();

  const Database& index() const { return *m_index; }
  const std::filesystem::path& folder() const { return m_folder; }

private:
  void update();
  void makeIndex(const std::vector<std::string>& runs);

  std::filesystem::path m_folder;
  std::optional<base::FileLock> m_lock;
  std::optional<Database> m_index;
};

} // namespace parity::history
