// parity work: the units of a plan, by worker processes.
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/process.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/shard_index.h"
#include "cli/workers.h"
#include "job/context.h"
#include "job/plan/plan_folder.h"
#include "job/plan/unit_store.h"
#include "job/plan/worker.h"
#include "job/scene_work.h"
#include "scenes/names.h"

namespace parity::cli {

namespace {

job::Settings settingsOf(const WorkCommand& command, const job::Plan& plan) {
  job::Settings settings = plan.settings();
  if (command.cacheFolder) {
    settings.cacheFolder.reset();
    if (!command.cacheFolder->empty()) settings.cacheFolder = *command.cacheFolder;
  }
  if (command.cacheBytes) settings.cacheBytes = *command.cacheBytes;
  return settings;
}

std::vector<std::string> cacheWords(const WorkCommand& command) {
  std::vector<std::string> words;
  if (command.cacheFolder && command.cacheFolder->empty()) words.emplace_back("--no-cache");
  if (command.cacheFolder && !command.cacheFolder->empty()) words = {"--cache", *command.cacheFolder};
  if (command.cacheBytes)
    for (const std::string& word : {std::string("--cache-size"), std::to_string(*command.cacheBytes)})
      words.push_back(word);
  return words;
}

int printMissing(const job::Plan& plan, const std::filesystem::path& folder) {
  const job::UnitStore store(folder, plan);
  std::vector<std::size_t> shards;
  for (std::size_t i = 0; i < plan.shards.size(); ++i)
    if (!store.missing(i).empty()) shards.push_back(i);
  printText(fmt::format("{}\n", fmt::join(shards, ",")));
  return 0;
}

int runAsWorker(const WorkCommand& command, const job::Plan& plan) {
  const base::ThreadLimit threads(command.threads);
  if (!base::dieWithParent(command.supervisor)) return 0;
  const base::StopSignal stop(""); // the supervisor says it
  job::chooseCompilerEffort(plan.request.scenes);
  job::Context context(settingsOf(command, plan));
  context.stopWhen(base::StopSignal::received);
  constexpr int kStageDescriptor = 3; // as base::ChildProcess gives it
  job::StagePage page(kStageDescriptor);
  return job::runWorker(context, plan, command.folder, page);
}

int runHere(const WorkCommand& command, const job::Plan& plan) {
  const base::ThreadLimit threads(command.threads);
  for (const std::size_t unit : command.units)
    if (unit >= plan.request.scenes.size())
      throw base::Error(base::ExitCode::usage, "--unit", "",
                        fmt::format("there is no unit {}: the plan has {} (0 to {})", unit, plan.request.scenes.size(),
                                    plan.request.scenes.size() - 1));
  job::chooseCompilerEffort(plan.request.scenes);
  job::Context context(settingsOf(command, plan));
  job::doUnits(context, plan, command.folder, command.units, makeProgress(command.quiet));
  if (!command.quiet)
    for (const std::size_t unit : command.units) print("unit {} ({}): done\n", unit, plan.request.scenes[unit].name);
  return 0;
}

// A folder where no scene is to be found is the wrong place, not a suite whose every scene is lost.
void requireScenes(const job::Plan& plan) {
  std::error_code none;
  for (const job::SceneRequest& scene : plan.request.scenes)
    if (scenes::isBuiltin(scene.scene) || std::filesystem::exists(scene.scene, none)) return;
  throw base::Error(base::ExitCode::otherPlan, plan.request.scenes.front().scene, "",
                    "is not here, nor is any other scene of the plan; start in the folder where the plan was made");
}

// Units that are errors of their scenes, among those that are there.
std::size_t countErrors(const std::vector<std::size_t>& units, const job::UnitStore& store) {
  return static_cast<std::size_t>(std::ranges::count_if(units, [&](std::size_t unit) {
    try {
      return !store.read(unit).scene.result.error.empty();
    } catch (const base::Error&) { // it is missing
      return false;
    }
  }));
}

// Those that are there and of no use: a disk that damages files should not go unseen.
void warnOfFaults(const std::vector<std::size_t>& units, const job::UnitStore& store) {
  for (const std::size_t unit : units)
    if (store.has(unit)) base::logWarning(store.findFault(unit) + "; the scene is done again");
}

} // namespace

int runWorkCommand(const WorkCommand& command) {
  if (command.supervisor > 0) base::setInterruptNote("the worker was ended before it could begin");
  const job::Plan plan = job::readPlan(command.folder);
  if (command.missing) return printMissing(plan, command.folder);
  if (command.supervisor > 0) return runAsWorker(command, plan);
  if (!command.units.empty()) return runHere(command, plan);
  const base::StopSignal stop("interrupted: what is done stays; the same command goes on from there");
  requireScenes(plan);
  const job::UnitStore store(command.folder, plan);
  std::vector<std::size_t> units;
  std::vector<std::size_t> whole(plan.request.scenes.size());
  std::iota(whole.begin(), whole.end(), std::size_t{0});
  std::string which = "the plan";
  if (command.shard.empty()) {
    units = store.missing();
  } else {
    const std::size_t shard = shardIndex(command.shard, plan.shards.size());
    tellSharded();
    units = store.missing(shard);
    whole = plan.shards[shard];
    which = fmt::format("shard {}", shard);
  }
  warnOfFaults(units, store);
  const std::size_t all = whole.size();
  const job::SuperviseResult result = runWorkers(
      plan, command.folder, units,
      {.workers = command.workers, .threads = command.threads, .showErrors = true, .words = cacheWords(command)},
      makeProgress(command.quiet));
  if (result.crashed > 0)
    base::logWarning(fmt::format("the workers of {} scene{} failed twice, so {} of the report; the last one is {}",
                                 result.crashed, result.crashed == 1 ? "" : "s",
                                 result.crashed == 1 ? "it is an error" : "they are errors", result.lastCrash));
  if (!command.quiet) {
    const std::size_t errors = countErrors(whole, store);
    print("{}: {} of {} scene{} done here, {} before{}\n", which, result.done, all, all == 1 ? "" : "s",
          all - units.size(),
          errors == 0
              ? ""
              : fmt::format("; {} of them {} of the report", errors, errors == 1 ? "is an error" : "are errors"));
    std::fflush(stdout); // before what is wrong
  }
  if (result.missing == 0) return 0;
  base::logError(fmt::format("{}: {} scene{} not done: {}", command.folder, result.missing,
                             result.missing == 1 ? " is" : "s are", result.why));
  return static_cast<int>(result.otherPlan ? base::ExitCode::otherPlan : base::ExitCode::incomplete);
}

} // namespace parity::cli
