// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/plan_options.h"

#include "base/log.h"
#include "cli/options/budget_options.h"
#include "cli/options/option_parts.h"
#include "job/plan/plan.h"

namespace parity::cli {

namespace {

constexpr const char* kPlanFolder = "Folder of the plan";

} // namespace

void addWorkerOptions(CLI::App& app, WorkerOptions& workers, RawWorkers& raw, const std::string& jobsHelp) {
  app.add_option("--jobs", workers.jobs, jobsHelp)->group(kMachineGroup)->check(wholeWithin(1, 1024));
  app.add_option("--timeout", raw.timeout, "Time that a scene may take in a worker process, such as 300s, 5m or 2h")
      ->type_name("TIME")
      ->group(kMachineGroup)
      ->capture_default_str();
  app.add_option("--memory", raw.memory, "Memory that a worker process may hold, such as 3G. Default: no limit")
      ->type_name("BYTES")
      ->group(kMachineGroup);
}

void settleWorkers(WorkerOptions& workers, const RawWorkers& raw) {
  workers.timeoutS = readOption("--timeout", base::readSeconds, raw.timeout);
  if (!raw.memory.empty()) workers.memoryBytes = readOption("--memory", base::readBytes, raw.memory);
}

void addSceneList(CLI::App& app, std::vector<std::string>& scenes, std::string& suite, CommonOptions& common) {
  app.add_option("scenes", scenes, "Scene files or builtin:NAME; -: one a line from standard input")
      ->type_name(kSceneFile);
  app.add_option("--suite", suite, "Suite file (TOML): many scenes, with their views, light and budgets")
      ->type_name(kFile)
      ->group(kInputGroup)
      ->excludes(app.get_option("scenes"));
  addOnlyOption(app, common.only);
}

void addPlanOptions(CLI::App& app, PlanCommand& plan) {
  app.add_option("-o,--output", plan.report.folder, kPlanFolder)->type_name(kFolder)->group(kOutputGroup)->required();
  app.add_option("--shards", plan.shards, "Number of shards, one for each machine or job of a scheduler")
      ->group(kOutputGroup)
      ->check(wholeWithin(1, job::kMostShards))
      ->capture_default_str();
  app.add_option("--baseline", plan.report.verdict.baseline,
                 "Earlier report.json or its folder: show what changed, and judge regressions")
      ->type_name(kFile)
      ->group("Verdict");
  addApprovalOptions(app, plan.report.verdict);
}

void addWorkOptions(CLI::App& app, RawWork& raw) {
  WorkCommand& command = raw.command;
  app.add_option("plan", command.folder, kPlanFolder)->type_name(kFolder)->required();
  CLI::Option* shard =
      app.add_option("--shard", command.shard,
                     "Number of the shard, from 0; auto: from the scheduler's environment. Default: all shards");
  shard->type_name("NUMBER|auto")->group(kInputGroup);
  CLI::Option* unit = repeat(app.add_option("--unit", command.units,
                                            "Do this scene of the plan again, by its number from 0, in this process; "
                                            "repeatable"));
  unit->type_name("NUMBER")->group(kInputGroup)->excludes(shard);
  app.add_flag("--missing", command.missing, "Only print the shards that are not done, as 3,7,12")
      ->group(kInputGroup)
      ->excludes(shard)
      ->excludes(unit);
  addWorkerOptions(app, command.workers, raw.workers, "Number of worker processes at a time. Default: 1");
  app.add_option("--threads", command.threads, "CPU threads of each worker; 0: the cores, shared among the workers")
      ->group(kMachineGroup)
      ->check(wholeWithin(0, 1024))
      ->capture_default_str();
  app.add_option("--worker", command.supervisor)->group(""); // of the workers that it starts itself
  app.add_option("--cache", raw.cache, "Cache folder. Default: that of the plan")
      ->type_name(kFolder)
      ->group(kCacheGroup);
  app.add_option("--cache-size", raw.cacheSize, "Largest size of the cache. Default: that of the plan")
      ->type_name("BYTES")
      ->group(kCacheGroup);
  app.add_flag("--no-cache", raw.noCache, "Do not use the cache")->group(kCacheGroup);
  app.add_flag("-q,--quiet", command.quiet, "Print errors only")->group(kGeneralGroup);
}

WorkCommand settleWork(const RawWork& raw) {
  WorkCommand command = raw.command;
  if (command.quiet) base::setLogLevel(base::LogLevel::quiet);
  settleWorkers(command.workers, raw.workers);
  if (raw.noCache)
    command.cacheFolder = "";
  else if (!raw.cache.empty())
    command.cacheFolder = raw.cache;
  if (!raw.cacheSize.empty()) command.cacheBytes = readOption("--cache-size", base::readBytes, raw.cacheSize);
  return command;
}

void addMergeOptions(CLI::App& app, RawMerge& raw) {
  MergeCommand& command = raw.command;
  app.add_option("plan", command.plan, kPlanFolder)->type_name(kFolder)->required();
  command.folder = kDefaultReportFolder;
  app.add_option("-o,--output", command.folder, "Folder for the report")
      ->type_name(kFolder)
      ->group(kOutputGroup)
      ->capture_default_str();
  choose(app.add_option("--incomplete", raw.incomplete,
                        "Scenes without a result: error: write no report; report: they are errors of the report"),
         {"error", "report"})
      ->group(kInputGroup)
      ->capture_default_str();
  app.add_option("--json", command.json, "Also write report.json to this file; - for stdout")
      ->type_name(kFile)
      ->group(kOutputGroup);
  addCsvOption(app, command.csv);
  addBenchOption(app, command.bench);
  app.add_flag("--warn-exit", command.verdict.warnExit, "Exit with 1 if there are only warnings")->group("Verdict");
  choose(app.add_option("--annotate", command.verdict.annotate,
                        "github: also print failures and warnings as annotations of GitHub Actions"),
         {"github"})
      ->group("Verdict");
  app.add_flag("--all", command.verdict.allRows,
               "Show all rows of the table. Default: those that failed, warned or could not be judged")
      ->group("Verdict");
  addApprovalOptions(app, command.verdict);
  addOutcomeOptions(app, command.verdict, raw.outcome);
  app.add_flag("--timings", command.timings, "Print the time of each stage to stderr")->group(kGeneralGroup);
  app.add_flag("-q,--quiet", command.quiet, "Print errors only, no table; the exit code is the verdict")
      ->group(kGeneralGroup);
}

MergeCommand settleMerge(const RawMerge& raw) {
  MergeCommand command = raw.command;
  if (command.quiet) base::setLogLevel(base::LogLevel::quiet);
  requireOneOnStdout(command.json, command.csv);
  settleOutcome(command.verdict, raw.outcome);
  command.reportsIncomplete = raw.incomplete == "report";
  return command;
}

} // namespace parity::cli
