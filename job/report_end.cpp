#include "job/report_end.h"

#include <algorithm>
#include <ctime>
#include <iterator>
#include <map>
#include <set>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/machine.h"
#include "base/text/glob.h"
#include "base/text/nearest.h"
#include "base/version.h"
#include "job/conditions.h"
#include "job/context.h"
#include "job/report_folder.h"
#include "job/scene/passes.h"
#include "job/scene/scene_inputs.h"
#include "job/view/display_table.h"
#include "report/approvals.h"
#include "report/baseline.h"
#include "report/judge.h"
#include "report/reader.h"
#include "report/trim.h"
#include "report/wording.h"

namespace parity::job {

namespace {

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

void logScene(const ComparedScene& scene) {
  if (!scene.error.empty()) base::logError(scene.error);
  for (const std::string& warning : scene.warnings) base::logWarning(warning);
  if (scene.isCached) base::logDetail(fmt::format("{}: taken from the cache", scene.result.name));
  for (const report::PassResult& pass : scene.result.passes)
    base::logDetail(fmt::format("{}: {}", scene.result.name, lineOf(pass)));
}

} // namespace

RunFacts factsOf(Context& context) {
  const gpu::DeviceReport& device = context.deviceReport();
  return {device.description(), device.driver + (device.build.empty() ? "" : ", " + device.build),
          describeSettings(context.settings(), device), reported(runConditions(context.settings(), device))};
}

ReportEnd::ReportEnd(const ReportRequest& request, RunBudgets& budgets, RunFacts facts,
                     const std::filesystem::path& baselineFile)
    : m_request(request), m_budgets(budgets), m_facts(std::move(facts)),
      m_baselineFile(baselineFile.empty() ? request.baseline : baselineFile),
      m_asOf(request.asOf.empty() ? base::today() : base::dayFrom(request.asOf).value()),
      m_startedAt(fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))),
      m_scenes(request.scenes.size()), m_isAdded(request.scenes.size()) {
  if (!request.approvals.empty()) m_approvals = budgets.approvalsOf(request.approvals);
  if (!m_baselineFile.empty()) m_baseline = report::readReport(m_baselineFile);
  if (m_baseline) m_budgets.setBaseline(&*m_baseline);
  if (request.folder.empty()) return;
  if (m_baseline && isBaselineInPlace())
    m_baselinePictures.emplace(*m_baseline, report::reportFileOf(request.baseline), request.folder);
  prepareReportFolder(request.folder, request.singleFile);
}

// Of a frozen one the pictures may be gone, or of a later run.
bool ReportEnd::isBaselineInPlace() const {
  const std::filesystem::path original = report::reportFileOf(m_request.baseline);
  if (m_baselineFile == m_request.baseline) return true;
  std::error_code none;
  return std::filesystem::is_regular_file(original, none) &&
         base::hashOfFile(original) == base::hashOfFile(m_baselineFile);
}

void ReportEnd::add(std::size_t index, ComparedScene scene) {
  if (!m_request.singleFile && !m_request.folder.empty()) {
    try {
      writePictures(scene.pictures, m_request.folder);
    } catch (const base::Error& error) {
      scene.error += (scene.error.empty() ? "" : "\n") + fmt::format("{}: {}", scene.result.name, error.what());
      scene.result.error = error.what();
      scene.result.errorExitCode = static_cast<int>(error.code());
    }
    scene.pictures.clear();
  }
  report::trim(scene.result);
  const std::lock_guard lock(m_mutex);
  m_scenes[index] = std::move(scene);
  m_isAdded[index] = true;
  for (; m_logged < m_scenes.size() && m_isAdded[m_logged]; ++m_logged) logScene(m_scenes[m_logged]);
}

// Sets what budgets require and no scene has, and warns of rules that judged nothing, a line a budget file. With
// --material and --only nobody knows what they could have judged.
void ReportEnd::holdBudgets(const Settings& settings, report::Report& report) const {
  if (!settings.materials.empty() || !m_request.only.empty()) return;
  std::map<std::string, std::vector<const report::SceneResult*>> files; // and whom each judges
  for (std::size_t i = 0; i < m_request.scenes.size(); ++i)
    if (const std::optional<std::string> file = m_budgets.fileOf(m_request.scenes[i]))
      files[*file].push_back(&report.scenes[i]);
  for (const auto& [file, scenes] : files) {
    try {
      const compare::Budgets& budgets = m_budgets.ofFile(file);
      if (std::string line = report::describeUnusedRules(budgets, report); !line.empty())
        report.warnings.push_back(std::move(line));
      std::ranges::move(report::findLost(budgets, scenes), std::back_inserter(report.lost));
    } catch (const base::Error&) {
      // A scene's own file that cannot be used is that scene's error already.
    }
  }
}

// Which rows there are is known only where the run is whole, and `diff` shows a scene of many.
void ReportEnd::holdApprovals(const Settings& settings, report::Report& report) const {
  const bool isPart = !settings.materials.empty() || !m_request.only.empty();
  report::applyApprovals(report, m_approvals, m_asOf,
                         isPart                ? report::EntriesFor::none
                         : m_request.oneOfMany ? report::EntriesFor::scenes
                                               : report::EntriesFor::all);
}

// The pictures of the baseline that this run's report shows, too: written, or put with those of a single file.
void ReportEnd::keepBaselinePictures(report::Report& report, std::vector<EncodedPicture>& pictures) const {
  const auto own = [&](const std::string& file) {
    if (!m_request.singleFile && std::filesystem::exists(m_request.folder / file))
      return base::readFile(m_request.folder / file);
    const auto found = std::ranges::find(pictures, file, &EncodedPicture::file);
    return found == pictures.end() ? std::vector<std::byte>() : found->bytes;
  };
  std::vector<EncodedPicture> kept; // of one file
  m_baselinePictures->keepChanged(report, own, [&](EncodedPicture picture) {
    if (m_request.singleFile)
      kept.push_back(std::move(picture));
    else
      writePictures({std::move(picture)}, m_request.folder);
  });
  std::ranges::move(kept, std::back_inserter(pictures));
}

// The pictures of approved states that the history has: written, or put with those of a single file.
void ReportEnd::keepApprovedPictures(const report::EarlierRuns& earlier, std::vector<EncodedPicture>& pictures) const {
  if (m_request.pictures == Pictures::none) return;
  std::vector<EncodedPicture> kept;
  for (const report::ApprovedPicture& each : earlier.approvedPictures()) try {
      kept.push_back({each.file, base::readFile(each.source)});
    } catch (const base::Error& error) {
      base::logWarning(fmt::format("the picture of an approved state is not shown: {}", error.what()));
    }
  if (m_request.singleFile)
    std::ranges::move(kept, std::back_inserter(pictures));
  else
    writePictures(kept, m_request.folder);
}

void ReportEnd::explain(Context& context, report::Report& report, std::vector<EncodedPicture>& pictures,
                        const Progress& progress) const {
  if (!m_request.explain) return;
  const base::Stopwatch watch(&context.timings(), "explain");
  KeepPicture keep;
  if (!m_request.folder.empty() && m_request.pictures != Pictures::none)
    keep = [&](EncodedPicture picture) {
      if (m_request.singleFile)
        pictures.push_back(std::move(picture));
      else
        writePictures({std::move(picture)}, m_request.folder);
    };
  m_request.explain(context, m_request, m_budgets, report, keep, progress);
}

// A machine whose device is gone by now has its report all the same.
void ReportEnd::setOrigin(Context& context, report::RunOrigin& origin) const {
  origin.build = m_facts.build.empty() ? hashOfThisBuild() : m_facts.build;
  origin.driver = m_facts.driver;
  origin.numerics = m_facts.numerics;
  try {
    if (origin.numerics.empty()) origin.numerics = context.numerics();
  } catch (const base::Error& error) {
    base::logDetail(fmt::format("the numerics id is not known: {}", error.what()));
  }
  origin.machine = base::processorName();
  origin.isWhole = m_request.only.empty() && context.settings().materials.empty();
  origin.cpuSeconds += base::cpuSeconds();
}

ReportResult ReportEnd::finish(Context& context, report::RunInfo run, const Progress& progress) {
  ReportResult result{.report = {}, .run = std::move(run)};
  report::Report& report = result.report;
  result.run.startedAt = m_startedAt;
  result.run.commandLine = m_request.commandLine;
  result.run.again = m_request.again;
  result.run.warningsFail = m_request.warningsFail;
  for (; m_logged < m_scenes.size(); ++m_logged) // behind one that was not run
    if (m_isAdded[m_logged]) logScene(m_scenes[m_logged]);
  for (std::size_t i = 0; i < m_scenes.size(); ++i)
    if (!m_isAdded[i]) m_scenes[i] = notRunScene(m_request.scenes[i], context.stoppedBy());
  report.version = base::kVersion;
  report.suite = m_request.suite;
  report.only = m_request.only;
  report.device = m_facts.device;
  report.settings = m_facts.settings;
  report.conditions = m_facts.conditions;
  report.digests = {digestOf(m_facts.conditions), m_budgets.digestOf(m_request.scenes)};
  if (!m_request.folder.empty()) setOrigin(context, result.run.origin);
  report.warnings = m_warnings;
  if (m_scenes.size() > 1) leaveOut(m_scenes, context.settings().materials, report);
  std::vector<EncodedPicture> pictures; // not written yet
  std::set<std::string> names;          // of the pictures
  for (ComparedScene& scene : m_scenes) {
    for (EncodedPicture& picture : scene.pictures) // scenes may share textures
      if (names.insert(picture.file).second) pictures.push_back(std::move(picture));
    if (scene.isMissing || report::isNotRun(scene.result)) result.run.origin.isComplete = false;
    if (scene.isCached) result.run.cachedScenes.push_back(scene.result.name);
    if (scene.seconds > 0)
      result.run.sceneTimes.push_back({scene.result.name, scene.seconds, scene.cpuSeconds,
                                       scene.machine == result.run.origin.machine ? "" : scene.machine});
    report.scenes.push_back(std::move(scene.result));
  }
  m_scenes.clear();
  if (const std::size_t cached = result.run.cachedScenes.size(); cached > 0)
    base::logInfo(
        fmt::format("{} of {} scenes are unchanged and come from the cache", cached, m_request.scenes.size()));
  holdBudgets(context.settings(), report);
  holdApprovals(context.settings(), report);
  report::settleVerdicts(report);
  if (m_baseline)
    report::compareWithBaseline(report, *m_baseline,
                                {report::reportFileOf(m_request.baseline).string(), context.settings().materials,
                                 m_request.oneOfMany, m_request.only});
  if (m_baselinePictures) keepBaselinePictures(report, pictures);
  const double cpuSeconds = base::cpuSeconds();
  explain(context, report, pictures, progress);
  result.run.origin.cpuSeconds += base::cpuSeconds() - cpuSeconds;
  result.run.compiledShaders += context.compiledShaders().size();
  base::logDetail(fmt::format("{} shaders were compiled", result.run.compiledShaders));
  logAccepted(report);
  for (const std::string& incident : result.run.incidents) base::logWarning(incident);
  base::logRunWarnings(report.warnings);
  if (const std::string line = report::describeNotRun(report); !line.empty()) base::logError(line);
  for (const report::RunProblem& problem : report::problemsOf(report)) base::logError(problem.reason);
  if (report.baseline && !report.baseline->error.empty())
    base::logError(fmt::format("{}: {}", m_request.baseline.string(), report.baseline->error));
  if (progress) progress("writing", 1);

  if (!m_request.folder.empty() && m_request.pixelData && m_request.pictures != Pictures::none &&
      needsDisplayTable(context.display())) {
    const base::Stopwatch watch(&context.timings(), "display table");
    report.displayTable = kDisplayTableFile;
    pictures.push_back({kDisplayTableFile, encodeDisplayTable(context.display())});
    if (!m_request.singleFile) writePictures({pictures.back()}, m_request.folder);
  }
  for (const auto& stage : context.timings().stages()) result.run.timings.push_back(stage);
  const std::chrono::duration<double, std::milli> total = std::chrono::steady_clock::now() - m_start;
  result.run.timings.emplace_back("total", total.count());
  if (m_request.findEarlier) result.earlier = m_request.findEarlier(report, result.run);
  if (m_request.folder.empty()) return result;
  if (result.earlier) keepApprovedPictures(*result.earlier, pictures);
  writeReport(m_request.folder, report, result.run,
              {m_request.bench, m_request.singleFile, pictures, result.earlier.get()});
  return result;
}

} // namespace parity::job
