// The options of parity plan, work and merge, and those of worker processes.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "cli/invocation.h"
#include "cli/options/budget_options.h"
#include "cli/options/common_options.h"

namespace parity::cli {

// What CLI11 fills in.
struct RawWorkers {
  std::string timeout = "300s", memory; // empty: no limit
};
struct RawWork {
  WorkCommand command;
  RawWorkers workers;
  std::string cache, cacheSize;
  bool noCache = false;
};
struct RawMerge {
  MergeCommand command;
  std::string incomplete = "error";
  RawOutcome outcome;
};

// --jobs, --timeout, --memory. jobsHelp: of --jobs.
void addWorkerOptions(CLI::App& app, WorkerOptions& workers, RawWorkers& raw, const std::string& jobsHelp);
// Throws CLI::ValidationError.
void settleWorkers(WorkerOptions& workers, const RawWorkers& raw);

// Scenes, --suite and --only.
void addSceneList(CLI::App& app, std::vector<std::string>& scenes, std::string& suite, CommonOptions& common);

// parity plan's own, besides the scenes and what compares them; parity work; parity merge.
void addPlanOptions(CLI::App& app, PlanCommand& plan);
void addWorkOptions(CLI::App& app, RawWork& raw);
WorkCommand settleWork(const RawWork& raw);
void addMergeOptions(CLI::App& app, RawMerge& raw);
MergeCommand settleMerge(const RawMerge& raw);

} // namespace parity::cli
