#include "job/report_run.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <future>
#include <set>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/glob.h"
#include "base/log.h"
#include "base/parallel.h"
#include "compare/baseline.h"
#include "compare/budget.h"
#include "compare/report_reader.h"
#include "job/report_folder.h"
#include "job/result_cache.h"
#include "job/settings_text.h"
#include "job/version.h"
#include "job/view_comparison.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

void requireMaterials(const scenes::Scene& scene, const std::vector<std::string>& globs) {
  for (const std::string& glob : globs)
    if (std::none_of(scene.materials.begin(), scene.materials.end(),
                     [&](const auto& m) { return base::matchesGlob(glob, m.name); }))
      throw base::Error(base::ExitCode::failed, scene.name, fmt::format("--material '{}'", glob),
                        "no material has such a name");
}

// A message without the folders of the scene's files: a report does not say where on this machine they lie.
std::string withoutFolders(std::string text, const SceneRequest& request) {
  for (const std::string& file : {request.scene, request.environment, request.budgets.value_or("")}) {
    const std::string folder = (std::filesystem::path(file).parent_path() / "").string();
    if (folder.empty()) continue;
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
      if (at == 0 || text[at - 1] == ' ' || text[at - 1] == '\'')
        text.erase(at, folder.size());
      else
        ++at; // the end of another path
  }
  return text;
}

// Budgets that go before a scene's own, and those that stand in where it has none.
struct RunBudgets {
  std::optional<compare::Budgets> first;
  compare::Budgets otherwise;
};

RunBudgets loadRunBudgets(const Settings& settings, const std::optional<std::string>& ofSuite) {
  if (settings.budgets) return {compare::loadBudgets(*settings.budgets), {}};
  return {std::nullopt, ofSuite ? compare::loadBudgets(*ofSuite) : compare::defaultBudgets()};
}

// Rules that judged nothing, a line a budget file. With --material nobody knows what they could have judged.
std::vector<std::string> warningsOfBudgets(const Settings& settings, const ReportRequest& request,
                                           const compare::Report& report) {
  std::vector<std::string> warnings;
  if (!settings.materials.empty()) return warnings;
  std::set<std::string> files;
  for (const SceneRequest& scene : request.scenes)
    for (const std::optional<std::string>& file : {settings.budgets, scene.budgets, request.suiteBudgets}) {
      if (!file) continue;
      files.insert(*file);
      break;
    }
  for (const std::string& file : files) {
    try {
      if (std::string line = compare::describeUnusedRules(compare::loadBudgets(file), report); !line.empty())
        warnings.push_back(std::move(line));
    } catch (const base::Error&) {
      // A scene's own file that cannot be used is that scene's error already.
    }
  }
  return warnings;
}

class Run {
public:
  Run(Context& context, const ReportRequest& request, RunBudgets budgets, const Progress& progress)
      : m_context(context), m_request(request), m_budgets(std::move(budgets)), m_progress(progress) {}

  compare::SceneResult compareScene(std::size_t index) {
    const SceneRequest& request = m_request.scenes[index];
    compare::SceneResult result = startScene(request);
    try {
      const compare::Budgets budgets = budgetsFor(request);
      const ResultWish wish = wishFor(index, budgets);
      const std::optional<std::string> key = resultKey(m_context, request, wish);
      std::optional<SceneRecord> cached = key ? recall(*key, index) : std::nullopt;
      if (cached) {
        result = std::move(cached->result);
        m_cached.push_back(request.name);
      } else {
        measureScene(index, wish, key, result);
      }
      for (compare::ViewResult& view : result.views) {
        for (compare::MaterialResult& material : view.materials)
          compare::judgeMaterial(material, budgets, request.name);
        compare::judgeWhole(view, budgets, request.name);
      }
    } catch (const base::Error& error) {
      // One catch at the boundary of each scene: the others still run.
      setError(result, request, error.what(), error.code());
    } catch (const std::exception& error) {
      setError(result, request, error.what(), base::ExitCode::failed);
    }
    for (std::string& warning : result.warnings) {
      base::logWarning(fmt::format("{}: {}", result.name, warning));
      warning = withoutFolders(std::move(warning), request);
    }
    return result;
  }

  const std::vector<std::string>& cached() const { return m_cached; }

private:
  static compare::SceneResult startScene(const SceneRequest& request) {
    compare::SceneResult result;
    result.name = request.name;
    result.source = scenes::cleanName(std::filesystem::path(request.scene).filename().string());
    result.environment = request.environment.empty()
                             ? "none"
                             : scenes::cleanName(std::filesystem::path(request.environment).filename().string());
    result.sun = "none";
    result.light = scenes::describe(request.lightScales, request.fog);
    return result;
  }

  std::vector<std::string> prefixesOf(std::size_t index) const {
    const SceneRequest& request = m_request.scenes[index];
    std::vector<std::string> prefixes;
    for (std::size_t v = 0; v < request.views.size(); ++v)
      prefixes.push_back(imagePrefix(index, request.name, v, request.views[v].name));
    return prefixes;
  }

  // The scene as an earlier run has left it, its pictures written.
  std::optional<SceneRecord> recall(const std::string& key, std::size_t index) {
    const base::Stopwatch watch(&m_context.timings(), "recall results");
    std::optional<SceneRecord> record = findResult(m_context.cache(), key, m_request.scenes[index]);
    if (record) {
      renamePictures(*record, prefixesOf(index));
      writePictures(record->pictures, m_request.folder);
    }
    return record;
  }

  Paths paths() const { return {.reference = m_context.settings().truth}; }
  PreparedScene prepare(std::size_t index) { return prepareScene(m_context, m_request.scenes[index], paths()); }

  // Loads the next scene while this one is shaded: the driver compiles shaders on one core.
  void prepareAhead(std::size_t index) {
    if (index >= m_request.scenes.size() || base::threadCount() == 1) return;
    try {
      const SceneRequest& request = m_request.scenes[index];
      const auto key = resultKey(m_context, request, wishFor(index, budgetsFor(request)));
      if (key && findResult(m_context.cache(), *key, request)) return;
    } catch (const base::Error&) { // the scene will say so when its turn comes
      return;
    }
    m_aheadIndex = index;
    m_ahead = std::async(std::launch::async, [this, index] { return prepare(index); });
  }

  ResultWish wishFor(std::size_t index, const compare::Budgets& budgets) const {
    const Settings& settings = m_context.settings();
    const std::uint64_t pixels = static_cast<std::uint64_t>(settings.width) * static_cast<std::uint64_t>(settings.height) *
                                 static_cast<std::uint64_t>(settings.samples) * m_request.scenes[index].views.size();
    return {compare::requiredStatistics(budgets), !m_request.folder.empty(),
            gpu::shareOf(index, m_request.scenes.size(), pixels)};
  }

  // Fills the result, view by view: what was done before an error stays. Keeps it for later runs.
  void measureScene(std::size_t index, const ResultWish& wish, const std::optional<std::string>& key,
                    compare::SceneResult& result) {
    const SceneRequest& request = m_request.scenes[index];
    tell(index, 0, 1, "loading");
    const PreparedScene prepared = m_ahead.valid() && m_aheadIndex == index ? m_ahead.get() : prepare(index);
    prepareAhead(index + 1);
    result.environment = prepared.environmentName;
    result.sun = prepared.sunText;
    result.warnings = prepared.scene.warnings;
    requireMaterials(prepared.scene, m_context.settings().materials);
    SceneRenderer renderer(m_context, prepared, paths(), request.views.size(), wish.permutations);
    for (const std::string& note : renderer.notes()) result.warnings.push_back("mobile: " + note);
    for (std::string& excess : mobile::samplerWarnings(prepared.scene, samplerInputs(prepared)))
      result.warnings.push_back(std::move(excess));
    std::vector<EncodedPicture> pictures;
    std::uint64_t comparedPixels = 0;
    for (std::size_t v = 0; v < request.views.size(); ++v) {
      tell(index, static_cast<double>(v), request.views.size(), request.views[v].name);
      ComparedView compared = compareOne(index, v, prepared, renderer, wish);
      writePictures(compared.pictures, m_request.folder);
      comparedPixels += compared.view.whole.all.pixels;
      result.views.push_back(std::move(compared.view));
      if (key)
        pictures.insert(pictures.end(), std::make_move_iterator(compared.pictures.begin()),
                        std::make_move_iterator(compared.pictures.end()));
    }
    result.permutations = renderer.permutations();
    Work work = renderer.work();
    work.comparedPixels = comparedPixels;
    if (m_context.settings().truth) work.comparedWithTruth = comparedPixels;
    if (m_context.settings().costs) work.countedShaders = result.permutations.size();
    result.passes = describePasses(work, renderer.reasons());
    // The same key again: the environment is still what it was when the scene was lit by it.
    if (!key || resultKey(m_context, request, wish) != key) return;
    const base::Stopwatch watch(&m_context.timings(), "keep results");
    storeResult(m_context.cache(), *key, request, prepared.scene.sources,
                {result, prefixesOf(index), std::move(pictures)});
  }

  static void setError(compare::SceneResult& result, const SceneRequest& request, const char* message,
                       base::ExitCode code) {
    base::logError(fmt::format("{}: {}", result.name, message));
    result.error = withoutFolders(message, request);
    result.errorExitCode = static_cast<int>(code);
  }

  mobile::SamplerInputs samplerInputs(const PreparedScene& prepared) const {
    return {.environment = prepared.mobileEnvironment != nullptr,
            .normalVariance = m_context.settings().specularAa == gpu::SpecularAa::toksvig};
  }

  compare::Budgets budgetsFor(const SceneRequest& request) const {
    if (m_budgets.first) return *m_budgets.first;
    return request.budgets ? compare::loadBudgets(*request.budgets) : m_budgets.otherwise;
  }

  ComparedView compareOne(std::size_t sceneIndex, std::size_t viewIndex, const PreparedScene& prepared,
                          SceneRenderer& renderer, const ResultWish& wish) {
    const SceneRequest& request = m_request.scenes[sceneIndex];
    const Settings& settings = m_context.settings();
    const scenes::ViewRequest& view = request.views[viewIndex];
    const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
    const Progress tellReference = [&](const std::string& what, double done) {
      tell(sceneIndex, static_cast<double>(viewIndex) + done, request.views.size(), view.name + ", " + what);
    };
    const ViewFrames frames = renderer.render(scenes::makeCamera(prepared.scene, view, aspect), tellReference);
    // A picture of nothing but background compares as equal: that is no answer.
    if (std::all_of(frames.coverage.begin(), frames.coverage.end(),
                    [](const auto& list) { return list.pixels.empty(); }))
      throw base::fileError(request.scene, fmt::format("view '{}'", view.name), "shows no part of the scene");
    ViewComparisonRequest comparison;
    comparison.viewName = view.name;
    comparison.exposureEv = prepared.exposureEv;
    comparison.samplers = samplerInputs(prepared);
    comparison.statistics = wish.statistics;
    comparison.pictures = wish.pictures;
    comparison.imagePrefix = imagePrefix(sceneIndex, request.name, viewIndex, view.name);
    ComparedView compared = compareView(m_context, prepared.scene, frames, comparison);
    return compared;
  }

  // view: how many are done.
  void tell(std::size_t scene, double view, std::size_t views, const std::string& what) const {
    if (!m_progress) return;
    const double share = views == 0 ? 0 : view / static_cast<double>(views);
    m_progress(fmt::format("{}: {}", m_request.scenes[scene].name, what),
               (static_cast<double>(scene) + share) / static_cast<double>(m_request.scenes.size()));
  }

  Context& m_context;
  const ReportRequest& m_request;
  const RunBudgets m_budgets;
  const Progress& m_progress;
  std::vector<std::string> m_cached;
  std::future<PreparedScene> m_ahead; // its exceptions are its scene's
  std::size_t m_aheadIndex = 0;
};

} // namespace

ReportResult runReport(Context& context, const ReportRequest& request, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  ReportResult result;
  result.run.startedAt = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  result.run.commandLine = request.commandLine;
  result.report.version = kVersion;

  // What concerns the whole run comes first: without it nothing is rendered, and an older report stays.
  RunBudgets budgets = loadRunBudgets(context.settings(), request.suiteBudgets);
  std::optional<compare::Report> baseline;
  if (!request.baseline.empty()) baseline = compare::readReport(request.baseline);
  result.report.device = context.deviceReport().description();
  result.report.settings = describeSettings(context.settings(), context.display(), context.deviceReport());
  if (!request.folder.empty()) prepareReportFolder(request.folder);
  Run run(context, request, std::move(budgets), progress);
  for (std::size_t i = 0; i < request.scenes.size(); ++i) result.report.scenes.push_back(run.compareScene(i));
  result.run.cachedScenes = run.cached();
  result.run.compiledShaders = context.pipelines().size();
  if (!run.cached().empty())
    base::logInfo(
        fmt::format("{} of {} scenes are unchanged: taken from the cache", run.cached().size(), request.scenes.size()));
  result.report.warnings = warningsOfBudgets(context.settings(), request, result.report);
  compare::settleVerdicts(result.report);
  if (baseline)
    compare::compareWithBaseline(
        result.report, *baseline,
        {compare::reportFileOf(request.baseline).string(), context.settings().materials, request.oneOfMany});
  for (const std::string& warning : result.report.warnings) base::logWarning(warning);
  if (result.report.baseline && !result.report.baseline->error.empty())
    base::logError(fmt::format("{}: {}", request.baseline.string(), result.report.baseline->error));
  if (progress) progress("writing", 1);

  result.run.timings = context.timings().stages();
  const std::chrono::duration<double, std::milli> total = std::chrono::steady_clock::now() - start;
  result.run.timings.emplace_back("total", total.count());
  if (!request.folder.empty()) writeReport(request.folder, result.report, result.run);
  return result;
}

} // namespace parity::job
