// parity bake: scenes in, folders of baked light out.
#include <algorithm>

#include <fmt/format.h>

#include "bake/baked_folder.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/text/error_words.h"
#include "cli/input_list.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/requests.h"
#include "job/context.h"

namespace parity::cli {

namespace {

// A scene and its folder.
struct Task {
  job::SceneRequest request;
  std::filesystem::path folder;
};

std::vector<Task> tasksOf(const BakeCommand& command) {
  std::vector<Task> tasks;
  if (!command.suite.empty()) {
    const scenes::Suite suite = scenes::loadSuite(command.suite, job::suiteKnobs());
    std::vector<job::SceneRequest> all = job::requestsOf(suite, command.common.plain, command.common.given);
    const std::vector<std::string> only = withoutTags(command.common.only, all);
    for (job::SceneRequest& entry : chooseViews(std::move(all), only)) {
      const std::string& folder = entry.settings.scene.baked;
      if (folder.empty()) continue;
      for (const Task& task : tasks)
        if (task.folder.lexically_normal() == std::filesystem::path(folder).lexically_normal())
          throw base::fileError(command.suite, "baked",
                                fmt::format("scenes '{}' and '{}' have the same folder; give each its own",
                                            task.request.name, entry.name));
      tasks.push_back({entry, folder});
    }
    if (tasks.empty())
      throw base::fileError(command.suite, "baked",
                            "no scene has this key; it names the scene's folder of baked light");
    return tasks;
  }
  const std::vector<std::string> scenes = withListed(command.scenes, "scene");
  std::vector<job::SceneRequest> requests;
  for (const std::string& scene : scenes) requests.push_back(sceneRequest(command.common, scene));
  // The folder is that of the whole bake, whatever --only leaves of it.
  const std::filesystem::path folder = command.folder;
  const std::vector<std::string> only = withoutTags(command.common.only, requests);
  for (const job::SceneRequest& request : chooseViews(std::move(requests), only))
    tasks.push_back({request, scenes.size() > 1 ? folder / folderName(request.name) : folder});
  for (std::size_t i = 0; i < tasks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (tasks[i].folder == tasks[j].folder)
        throw base::Error(base::ExitCode::usage, "bake", tasks[i].request.name, "two scenes have this name");
  return tasks;
}

std::string astcDb(const bake::BakeFigures& f) {
  if (f.colorDb >= bake::kNoLossDb) return {};
  return fmt::format(" ({:.1f} dB of colour, {:.1f} dB of direction)", f.colorDb, f.directionDb);
}

void printSummary(const Task& task, const job::BakeResult& result, double seconds) {
  const bake::BakeFigures& f = result.light.figures;
  print("{}: {} texels on {} {} of {} x {}, {:.0f} samples a texel, {:.1f} s", task.request.name, f.texels,
        result.light.halfPages.size(), result.light.halfPages.size() == 1 ? "page" : "pages", result.light.pageSide,
        result.light.pageSide, f.samplesPerTexel, seconds);
  if (result.rays > 0) print(", {:.1f} million rays", static_cast<double>(result.rays) * 1e-6);
  print("\n  error: median {:.2g} %, worst {:.2g} %; {:.1f} % of the texels are within --error{}\n",
        100 * f.errorMedian, 100 * f.errorWorst, 100 * f.shareWithinError,
        f.shareWithinError < 0.95 ? "; a larger --max-samples helps" : "");
  print("  encoded lightmap: rms error {:.2g} % in 8 bits, {:.2g} % after ASTC {}{}\n", 100 * f.quantizedError,
        100 * f.storedError, result.light.astc, astcDb(f));
  print("  {} environment {}; {}\n", result.light.captures.size(),
        result.light.captures.size() == 1 ? "capture" : "captures", task.folder.string());
}

// Of a scene of thousands of meshes only the first.
void printNotes(const std::string& scene, const std::vector<std::string>& notes) {
  constexpr std::size_t kMostNotes = 20;
  const std::size_t shown = base::logLevel() == base::LogLevel::verbose ? notes.size() : kMostNotes;
  for (std::size_t i = 0; i < std::min(shown, notes.size()); ++i) base::logInfo(fmt::format("{}: {}", scene, notes[i]));
  if (notes.size() > shown)
    base::logInfo(fmt::format("{}: and {} more notes (-v shows all)", scene, notes.size() - shown));
}

} // namespace

int runBakeCommand(const BakeCommand& command) {
  const base::ThreadLimit threads(command.common.threads);
  const std::vector<Task> tasks = tasksOf(command);
  for (const Task& task : tasks) { // before the minutes that follow
    bake::requireBakeFolder(task.folder);
    for (const NamedFile& input : inputFiles(command.common, {task.request}))
      if (!input.file.empty() && liesIn(input.file, task.folder))
        throw base::Error(
            base::ExitCode::usage, "-o", task.folder.string(),
            fmt::format("{} lies in this folder, which the bake replaces; give another folder", input.name));
  }
  const base::StopSignal stop; // it ends, and leaves nothing behind but its cache
  const auto isCancelled = [] { return base::StopSignal::received() != 0; };
  job::Context context(command.common.settings);
  const auto hasCaptures = [&](const Task& task) {
    return command.options.captures != 0 || !task.request.captures.empty();
  };
  if (!command.common.settings.device.name.empty() || std::ranges::any_of(tasks, hasCaptures))
    context.deviceReport(); // captures need a device: refuse a wrong one before the minutes that follow
  int exitCode = 0;
  const job::Progress progress = makeProgress(command.common.quiet);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Task& task = tasks[i];
    try {
      const base::Stopwatch watch(nullptr, "bake");
      const job::BakeResult result = job::bakeScene(context, task.request, command.options,
                                                    progressOfScene(progress, i, tasks.size()), isCancelled);
      printNotes(task.request.name, result.notes);
      bake::writeBaked(task.folder, result.light);
      if (!command.common.quiet) printSummary(task, result, watch.elapsedMs() * 1e-3);
    } catch (const base::Error& error) {
      // The others are still baked, unless all is cancelled.
      if (isCancelled() || tasks.size() == 1) throw;
      base::logError(error.what());
      exitCode = std::max(exitCode, static_cast<int>(error.code()));
    } catch (const std::exception& error) {
      if (tasks.size() == 1) throw;
      base::logError(fmt::format("{}: {}", task.request.name, base::wordsOf(error)));
      exitCode = std::max(exitCode, static_cast<int>(base::ExitCode::failed));
    }
  }
  if (command.common.timings) printTimings(context.timings().stages());
  return exitCode;
}

} // namespace parity::cli
