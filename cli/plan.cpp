// parity plan: what a run over many machines does, frozen in a folder.
#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/input_list.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/report_parts.h"
#include "cli/requests.h"
#include "job/context.h"
#include "job/plan/plan_folder.h"
#include "job/scene_work.h"
#include "scenes/builtin/builtin.h"
#include "scenes/names.h"

namespace parity::cli {

namespace {

constexpr double kGibibyte = 1 << 30;

// A typing error should not cost a night: what is not there is told now. At the time of the work it is an error of its
// scene, unless it has come by then.
void warnOfMissing(const job::ReportRequest& request) {
  std::set<std::string> missing;
  const auto look = [&](const std::string& name, const std::vector<std::string>& builtins) {
    std::error_code none;
    const bool isThere = scenes::isBuiltin(name)
                             ? std::ranges::count(builtins, name.substr(std::string_view("builtin:").size())) > 0
                             : name.empty() || std::filesystem::exists(name, none);
    if (!isThere) missing.insert(name);
  };
  for (const job::SceneRequest& scene : request.scenes) {
    look(scene.scene, scenes::builtinSceneNames());
    look(scene.settings.scene.environment, scenes::builtinEnvironmentNames());
    look(scene.settings.scene.baked, {});
  }
  for (const std::string& name : missing)
    base::logWarning(name + ": is not there; the scenes that need it will be errors of the report");
}

} // namespace

int runPlanCommand(const PlanCommand& command, const std::string& commandLine) {
  const ReportCommand& report = command.report;
  const base::ThreadLimit threads(report.common.threads);
  const RunRequest run = runRequest(report.common, withListed(report.scenes, "scene"), report.suite);
  job::chooseCompilerEffort(run.scenes); // as `work` will: it holds its numerics against the plan's
  job::Context context(run.settings);
  job::Plan plan =
      job::makePlan(context, reportRequest(report, run, commandLine), report.common.plain, run.given, command.shards);
  warnOfMissing(plan.request);
  job::writePlan(plan, report.folder);
  if (const std::uintmax_t bytes = job::expectedCacheBytes(plan.request);
      context.cache().enabled() && bytes > run.settings.cacheBytes)
    base::logWarning(
        fmt::format("the results of this run will take some {:.1f} GiB of the cache, which may hold {:.1f} "
                    "(--cache-size): the next run will find few of them",
                    static_cast<double>(bytes) / kGibibyte, static_cast<double>(run.settings.cacheBytes) / kGibibyte));
  if (!report.common.quiet)
    print("{}: {} scene{} in {} shard{} (0 to {}); next: parity work {} --shard N, then parity merge {} -o FOLDER\n",
          report.folder, plan.request.scenes.size(), plan.request.scenes.size() == 1 ? "" : "s", plan.shards.size(),
          plan.shards.size() == 1 ? "" : "s", plan.shards.size() - 1, report.folder, report.folder);
  return 0;
}

} // namespace parity::cli
