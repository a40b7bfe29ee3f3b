// parity report: scenes or a suite in, a folder with the report out.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/input_list.h"
#include "cli/invocation.h"
#include "cli/progress.h"
#include "cli/report_parts.h"
#include "cli/requests.h"
#include "cli/workers.h"
#include "job/context.h"
#include "job/plan/merge.h"
#include "job/plan/plan_folder.h"
#include "job/plan/unit_store.h"
#include "job/report_folder.h"
#include "job/scene_work.h"
#include "scenes/names.h"

namespace parity::cli {

namespace {

// The baseline may lie in the report's own folder, as it is read first; all else that is read must stay.
void requireSeparateFiles(const ReportCommand& command, const job::ReportRequest& request) {
  std::vector<NamedFile> inputs = inputFiles(command.common, request.scenes);
  inputs.push_back({"the suite", command.suite});
  inputs.push_back({"the suite's budgets", request.suiteBudgets.value_or("")});
  inputs.push_back({"--bench", benchFile(command.bench)});
  std::vector<NamedFile> outputs;
  for (const char* file : job::kReportFiles) outputs.push_back({"-o", request.folder / file});
  const std::vector<NamedFile> single = {
      {"--json", command.common.json}, {"--csv", command.csv}, {"--summary", command.verdict.summary.file}};
  outputs.insert(outputs.end(), single.begin(), single.end());
  requireSeparate(outputs, inputs);
  requireSeparate(single, inputFiles(command.common, command.verdict, {}));
}

// Names that nobody meant should not cost the report that the default folder has.
void requireAnyScene(const ReportCommand& command, const job::ReportRequest& request) {
  std::error_code none;
  const auto isMissing = [&](const job::SceneRequest& each) {
    return !each.scene.starts_with(scenes::kBuiltinPrefix) && !std::filesystem::exists(each.scene, none);
  };
  if (!command.suite.empty() || command.folder != kDefaultReportFolder || request.scenes.empty() ||
      !std::filesystem::exists(request.folder / "report.json", none) || !std::ranges::all_of(request.scenes, isMissing))
    return;
  throw base::fileError(request.scenes.front().scene, "",
                        fmt::format("does not exist; the report in {} stays as it is", command.folder));
}

// By worker processes: plan, work and merge on this machine. The plan lies in the report's folder until the report is
// whole, so that the same command goes on with what an earlier one has left.
job::ReportResult reportByWorkers(const ReportCommand& command, job::Context& context, const RunRequest& run,
                                  const job::ReportRequest& request) {
  const std::filesystem::path folder = request.folder / job::kWorkFolder;
  job::requireReportFolder(request.folder);
  job::Plan plan = job::makePlan(context, request, command.common.plain, run.given, 1);
  std::error_code none;
  std::filesystem::create_directories(folder, none); // what fails is said by the plan
  const job::PlanLock lock(folder);
  job::writePlanAnew(plan, folder);
  const job::Progress progress = makeProgress(command.common.quiet);
  const job::SuperviseResult work =
      runWorkers(plan, folder, job::UnitStore(folder, plan).missing(),
                 {.workers = command.workers, .threads = command.common.threads, .showErrors = false}, progress);
  if (work.missing > 0)
    base::logError(fmt::format("{} scene{} not done: {}", work.missing, work.missing == 1 ? " is" : "s are", work.why));
  const job::ReportResult result = job::mergePlan(plan, folder,
                                                  {.folder = request.folder,
                                                   .incomplete = job::Incomplete::report,
                                                   .stoppedBy = base::StopSignal::received(),
                                                   .whyMissing = work.why,
                                                   .bench = request.bench,
                                                   .warningsFail = request.warningsFail,
                                                   .findEarlier = request.findEarlier,
                                                   .explain = request.explain,
                                                   .isStopped = base::StopSignal::received},
                                                  progress);
  if (work.missing == 0) std::filesystem::remove_all(folder, none);
  return result;
}

} // namespace

int runReportCommand(const ReportCommand& command, const std::string& commandLine) {
  const base::ThreadLimit threads(command.common.threads);
  const RunRequest run = runRequest(command.common, withListed(command.scenes, "scene"), command.suite);
  job::ReportRequest request = reportRequest(command, run, commandLine);
  request.folder = command.folder;
  requireSeparateFiles(command, request);
  requireAnyScene(command, request);
  request.bench = readBench(command.bench);
  const base::StopSignal stop("interrupted: the report is written with what is finished; another signal ends the "
                              "program at once");
  job::chooseCompilerEffort(request.scenes);
  job::Context context(run.settings);
  context.stopWhen(base::StopSignal::received);
  const job::ReportResult result = command.workers.jobs > 0
                                       ? reportByWorkers(command, context, run, request)
                                       : job::runReport(context, request, makeProgress(command.common.quiet));
  return tellReport(result, {.folder = request.folder,
                             .singleFile = command.singleFile,
                             .pixelData = request.pixelData,
                             .json = command.common.json,
                             .csv = command.csv,
                             .timings = command.common.timings,
                             .quiet = command.common.quiet,
                             .verdict = command.verdict});
}

} // namespace parity::cli
