// parity plan: what a run over many machines does, frozen in a folder.
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
#include "job/plan/plan.h"

namespace parity::cli {

namespace {

constexpr double kGibibyte = 1 << 30;

} // namespace

int runPlanCommand(const PlanCommand& command, const std::string& commandLine) {
  const ReportCommand& report = command.report;
  const base::ThreadLimit threads(report.common.threads);
  const RunRequest run = runRequest(report.common, withListed(report.scenes, "scene"), report.suite);
  job::Context context(run.settings);
  job::Plan plan =
      job::makePlan(context, reportRequest(report, run, commandLine), report.common.plain, run.given, command.shards);
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
