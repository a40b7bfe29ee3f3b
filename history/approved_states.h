// The runs that showed what an approval approves, and the pictures that the history has of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "compare/verdict/approval.h"
#include "history/database.h"
#include "history/run.h"
#include "history/runs_before.h"

namespace parity::history {

struct ApprovedState {
  std::int64_t run = 0;
  PictureHashes pictures;
};

class ApprovedStates {
public:
  // history: its folder. Both must outlive it.
  ApprovedStates(const Database& index, const std::filesystem::path& history);

  // All first runs of an interval in which the figure had this value and whose pictures are kept, the newest first.
  // Throws Error for a run file that cannot be read.
  std::vector<ApprovedState> find(const RowName& row, const std::string& metric, double value);

private:
  const PictureHashes* picturesOf(std::int64_t run, const RowName& row);

  const Database& m_index;
  const std::filesystem::path& m_history;
  Statement m_runs;
  std::map<std::int64_t, RunRecord> m_records; // that were needed
};

} // namespace parity::history
