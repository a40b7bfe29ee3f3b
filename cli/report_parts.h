// What `parity report`, `plan` and `merge` have in common: the request of a report, and how its result is told.
#pragma once

#include <filesystem>
#include <string>

#include "cli/invocation.h"
#include "cli/requests.h"
#include "job/report_run.h"

namespace parity::cli {

// Opens that folder's history for a report; one that cannot be used is a warning, because it costs nothing that was
// computed. folder empty: nothing.
report::FindEarlierRuns findEarlierRuns(const std::string& folder);

// Of --explain; empty where it is not given.
job::AddToReport explainerOf(const VerdictOptions& verdict);

// All that is asked for but the folder and the bench. run: as runRequest gives it.
job::ReportRequest reportRequest(const ReportCommand& command, const RunRequest& run, const std::string& commandLine);

// bench.json itself, of its file or its folder.
std::filesystem::path benchFile(const std::string& bench);
// The bench that goes with the page: bench.json or its folder; empty: none. What it is is known here, and anything else
// refused, before anything is rendered. Throws Error (exit 4).
report::Bench readBench(const std::string& bench);

// Where a result goes besides its folder.
struct ReportTargets {
  std::filesystem::path folder;
  bool singleFile = false, pixelData = true;
  std::string json, csv; // file, "-" for stdout, "" for none
  bool timings = false, quiet = false;
  const VerdictOptions& verdict;
};

// Table, JSON, CSV, summary, annotations. Returns the exit code.
int tellReport(const job::ReportResult& result, const ReportTargets& targets);

// What the verdict options ask for besides the table, which was shown where isShown: the summary, and which failures
// count. Returns the exit code.
int tellOutcome(const job::ReportResult& result, const VerdictOptions& verdict, bool isShown);

} // namespace parity::cli
