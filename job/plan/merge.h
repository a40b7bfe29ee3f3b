// The end of a plan: its units in, the report out.
#pragma once

#include <filesystem>

#include "job/plan/plan.h"

namespace parity::job {

enum class Incomplete { error, report };

struct MergeOptions {
  std::filesystem::path folder;              // of the report
  Incomplete incomplete = Incomplete::error; // what becomes of units that are missing
  int stoppedBy = 0;                         // not 0: they were not run, because of this signal
  std::string whyMissing = {};               // for their errors; empty: their shard did not finish them
  report::Bench bench;                       // for the page
  bool warningsFail = false;                 // as in ReportRequest
  std::string approvals = {};                // instead of the plan's; empty: the plan's
  std::string asOf = {};                     // the same of the day for them
  report::FindEarlierRuns findEarlier = {};  // for the page; empty: no history
  AddToReport explain = {};                  // as in ReportRequest
  std::function<int()> isStopped = {};       // as Context::stopWhen has it, while it explains; empty: nothing stops it
};

// Writes the report that runReport would have written for the plan's request, byte for byte. A unit that is missing is
// an error of its scene, or of the merge. Needs no device unless it explains. Throws Error: (exit 4) naming the units
// that are missing, and what runReport throws; (exit 78) for a unit of another plan, build or machine. The plan's
// folder is only read; its lock is the caller's matter.
ReportResult mergePlan(const Plan& plan, const std::filesystem::path& folder, const MergeOptions& options,
                       const Progress& progress);

} // namespace parity::job
