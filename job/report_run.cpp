#include "job/report_run.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <future>
#include <iterator>
#include <map>
#include <mutex>
#include <numeric>
#include <set>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/text/glob.h"
#include "base/text/nearest.h"
#include "base/version.h"
#include "compare/verdict/budget.h"
#include "job/baseline_pictures.h"
#include "job/conditions.h"
#include "job/context.h"
#include "job/report_folder.h"
#include "job/scene/passes.h"
#include "job/scene/scene_comparison.h"
#include "job/scene_times.h"
#include "job/view/display_table.h"
#include "report/baseline.h"
#include "report/judge.h"
#include "report/reader.h"
#include "report/wording.h"

namespace parity::job {

namespace {

RunBudgets loadRunBudgets(const Settings& settings, const std::optional<std::string>& ofSuite) {
  if (settings.budgets) return {.first = compare::loadBudgets(*settings.budgets), .otherwise = {}};
  return {.first = std::nullopt, .otherwise = ofSuite ? compare::loadBudgets(*ofSuite) : compare::defaultBudgets()};
}

// Sets what budgets require and no scene has, and warns of rules that judged nothing, a line a budget file. With
// --material and --only nobody knows what they could have judged.
void holdBudgets(const Settings& settings, const ReportRequest& request, report::Report& report) {
  if (!settings.materials.empty() || !request.only.empty()) return;
  std::map<std::string, std::vector<const report::SceneResult*>> files; // and whom each judges
  for (std::size_t i = 0; i < request.scenes.size(); ++i)
    for (const std::optional<std::string>& file : {settings.budgets, request.scenes[i].budgets, request.suiteBudgets}) {
      if (!file) continue;
      files[*file].push_back(&report.scenes[i]);
      break;
    }
  for (const auto& [file, scenes] : files) {
    try {
      const compare::Budgets budgets = compare::loadBudgets(file);
      if (std::string line = report::describeUnusedRules(budgets, report); !line.empty())
        report.warnings.push_back(std::move(line));
      std::ranges::move(report::findLost(budgets, scenes), std::back_inserter(report.lost));
    } catch (const base::Error&) {
      // A scene's own file that cannot be used is that scene's error already.
    }
  }
}

// The pictures of the baseline that this run's report shows, too: written, or put with those of a single file.
void keepBaselinePictures(const BaselinePictures& baseline, const ReportRequest& request, report::Report& report,
                          std::vector<EncodedPicture>& pictures) {
  std::vector<EncodedPicture> kept = baseline.keepChanged(report, [&](const std::string& file) {
    if (!request.singleFile && std::filesystem::exists(request.folder / file))
      return base::readFile(request.folder / file);
    const auto found = std::ranges::find(pictures, file, &EncodedPicture::file);
    return found == pictures.end() ? std::vector<std::byte>() : found->bytes;
  });
  if (request.singleFile)
    std::ranges::move(kept, std::back_inserter(pictures));
  else
    writePictures(kept, request.folder);
}

// NaN that a budget accepts are a fault all the same: nobody should have to look for them.
void logAccepted(const report::Report& report) {
  for (const report::SceneResult& scene : report.scenes)
    for (const report::ViewResult& view : scene.views) {
      const auto tell = [&](const std::string& name, const compare::Figures& figures, const std::string& accepted) {
        if (figures.nonFinite > 0 && !accepted.empty())
          base::logWarning(fmt::format("{}, view {}, {}: accepted: {}", scene.name, view.name, name, accepted));
      };
      tell("whole image", view.whole, view.accepted);
      for (const report::MaterialResult& material : view.materials)
        tell("material " + material.name, material.figures, material.accepted);
    }
}

// Takes the scenes out that show nothing that --material asks for, and says which. A glob that matches in no scene is a
// mistake: nothing would tell it from a material that passes.
void leaveOut(std::vector<ComparedScene>& scenes, const std::vector<std::string>& globs, report::Report& report) {
  std::vector<std::string_view> known, without;
  bool isAllKnown = true;
  for (const ComparedScene& scene : scenes) {
    isAllKnown = isAllKnown && scene.result.error.empty();
    known.insert(known.end(), scene.materials.begin(), scene.materials.end());
    if (scene.isLeftOut) without.push_back(scene.result.name);
    for (const report::ViewResult& view : scene.result.views)
      for (const report::MaterialResult& material : view.materials) known.push_back(material.name);
  }
  std::ranges::sort(known);
  known.erase(std::unique(known.begin(), known.end()), known.end());
  for (const std::string& glob : globs)
    if (isAllKnown && std::ranges::none_of(known, [&](auto name) { return base::matchesGlob(glob, name); }))
      report.lost.push_back({compare::Verdict::error,
                             fmt::format("--material '{}': no scene has a material of this name; {}", glob,
                                         base::describeNearestToGlob(glob, known)),
                             "", 0});
  if (!without.empty())
    base::logInfo(fmt::format("--material: {} of {} scenes {} skipped, because they have no such material: {}",
                              without.size(), scenes.size(), without.size() == 1 ? "is" : "are",
                              fmt::join(without, ", ")));
  std::erase_if(scenes, &ComparedScene::isLeftOut);
}

// The scenes of a run, two at a time where there are threads: the driver compiles shaders on one core, and each has its
// own device. What comes out depends neither on who takes which scene nor on when.
class Run {
public:
  Run(Context& context, const ReportRequest& request, RunBudgets budgets, const Progress& progress)
      : m_context(context), m_request(request), m_budgets(std::move(budgets)), m_progress(progress),
        m_scenes(request.scenes.size()), m_done(request.scenes.size()) {}

  // Once. In the order of the request; those that an interrupted run did not begin are not run.
  std::vector<ComparedScene> compareScenes() {
    if (m_scenes.size() > 1 && base::threadCount() > 1) {
      Context second(m_context, Context::ForAnotherThread{});
      std::future<void> other = std::async(std::launch::async, [&] { takeScenes(second); });
      takeScenes(m_context);
      other.get();
      m_context.take(second);
    } else {
      takeScenes(m_context);
    }
    for (std::size_t i = 0; i < m_scenes.size(); ++i)
      if (m_done[i] != 1) m_scenes[i] = notRunScene(m_request.scenes[i], m_context.stoppedBy());
    return std::move(m_scenes);
  }

private:
  void takeScenes(Context& context) {
    for (std::size_t i = take(); i < m_scenes.size(); i = take()) {
      const Tell tellOne = [&](double done, const std::string& what) { tell(i, done, what); };
      const auto start = std::chrono::steady_clock::now();
      ComparedScene scene = compareScene(context, m_request, i, m_budgets, tellOne);
      if (!scene.isCached && scene.result.error.empty())
        keepSceneTime(context.cache(), m_request.scenes[i],
                      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      const std::lock_guard lock(m_mutex);
      m_scenes[i] = std::move(scene);
      m_done[i] = 1;
      for (; m_logged < m_scenes.size() && m_done[m_logged] == 1; ++m_logged) log(m_scenes[m_logged]);
    }
  }

  std::size_t take() {
    const std::lock_guard lock(m_mutex);
    return m_context.stoppedBy() == 0 ? m_next++ : m_scenes.size();
  }

  void tell(std::size_t scene, double done, const std::string& what) {
    if (!m_progress) return;
    const std::lock_guard lock(m_mutex);
    m_done[scene] = std::min(done, 0.999);
    const auto finished = std::ranges::count(m_done, 1.0);
    const std::string count = m_done.size() > 1 ? fmt::format("{} of {} done, ", finished, m_done.size()) : "";
    m_progress(fmt::format("{}{}: {}", count, m_request.scenes[scene].name, what),
               std::accumulate(m_done.begin(), m_done.end(), 0.0) / static_cast<double>(m_done.size()));
  }

  static void log(const ComparedScene& scene) {
    if (!scene.error.empty()) base::logError(scene.error);
    for (const std::string& warning : scene.warnings) base::logWarning(warning);
    if (scene.isCached) base::logDetail(fmt::format("{}: taken from the cache", scene.result.name));
    for (const report::PassResult& pass : scene.result.passes)
      base::logDetail(fmt::format("{}: {}", scene.result.name, lineOf(pass)));
  }

  Context& m_context;
  const ReportRequest& m_request;
  const RunBudgets m_budgets;
  const Progress& m_progress;
  std::mutex m_mutex; // of all below
  std::vector<ComparedScene> m_scenes;
  std::vector<double> m_done; // how much of each; 1: all
  std::size_t m_next = 0, m_logged = 0;
};

} // namespace

ReportResult runReport(Context& context, const ReportRequest& request, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  ReportResult result;
  result.run.startedAt = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  result.run.commandLine = request.commandLine;
  result.run.again = request.again;
  result.report.version = base::kVersion;
  result.report.suite = request.suite;

  // What concerns the whole run comes first: without it nothing is rendered, and an older report stays.
  RunBudgets budgets = loadRunBudgets(context.settings(), request.suiteBudgets);
  std::optional<report::Report> baseline;
  if (!request.baseline.empty()) baseline = report::readReport(request.baseline);
  if (baseline) budgets.baseline = &*baseline;
  result.report.device = context.deviceReport().description();
  result.report.settings = describeSettings(context.settings(), context.deviceReport());
  result.report.conditions = reported(runConditions(context.settings(), context.deviceReport()));
  std::optional<BaselinePictures> baselinePictures;
  if (baseline && !request.folder.empty())
    baselinePictures.emplace(*baseline, report::reportFileOf(request.baseline), request.folder);
  if (!request.folder.empty()) prepareReportFolder(request.folder, request.singleFile);
  Run run(context, request, std::move(budgets), progress);
  std::vector<EncodedPicture> pictures; // not written yet
  std::vector<ComparedScene> scenes = run.compareScenes();
  if (scenes.size() > 1) leaveOut(scenes, context.settings().materials, result.report);
  std::set<std::string> names; // of the pictures
  for (ComparedScene& scene : scenes) {
    for (EncodedPicture& picture : scene.pictures) // scenes may share textures
      if (names.insert(picture.file).second) pictures.push_back(std::move(picture));
    if (scene.isCached) result.run.cachedScenes.push_back(scene.result.name);
    result.report.scenes.push_back(std::move(scene.result));
  }
  result.run.compiledShaders = context.compiledShaders().size();
  base::logDetail(fmt::format("{} shaders were compiled", result.run.compiledShaders));
  if (const std::size_t cached = result.run.cachedScenes.size(); cached > 0)
    base::logInfo(fmt::format("{} of {} scenes are unchanged and come from the cache", cached, request.scenes.size()));
  holdBudgets(context.settings(), request, result.report);
  report::settleVerdicts(result.report);
  if (baseline)
    report::compareWithBaseline(result.report, *baseline,
                                {report::reportFileOf(request.baseline).string(), context.settings().materials,
                                 request.oneOfMany, request.only});
  if (baselinePictures) keepBaselinePictures(*baselinePictures, request, result.report, pictures);
  logAccepted(result.report);
  base::logRunWarnings(result.report.warnings);
  if (const std::string line = report::describeNotRun(result.report); !line.empty()) base::logError(line);
  for (const report::RunProblem& problem : report::problemsOf(result.report)) base::logError(problem.reason);
  if (result.report.baseline && !result.report.baseline->error.empty())
    base::logError(fmt::format("{}: {}", request.baseline.string(), result.report.baseline->error));
  if (progress) progress("writing", 1);

  if (!request.folder.empty() && request.pixelData && needsDisplayTable(context.display())) {
    const base::Stopwatch watch(&context.timings(), "display table");
    result.report.displayTable = kDisplayTableFile;
    pictures.push_back({kDisplayTableFile, encodeDisplayTable(context.display())});
    if (!request.singleFile) writePictures({pictures.back()}, request.folder);
  }
  result.run.timings = context.timings().stages();
  const std::chrono::duration<double, std::milli> total = std::chrono::steady_clock::now() - start;
  result.run.timings.emplace_back("total", total.count());
  if (!request.folder.empty())
    writeReport(request.folder, result.report, result.run, {request.bench, request.singleFile, pictures});
  return result;
}

} // namespace parity::job
