#include "job/report_run.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <set>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/glob.h"
#include "base/log.h"
#include "compare/baseline.h"
#include "compare/report_reader.h"
#include "job/report_folder.h"
#include "job/truth_comparison.h"
#include "job/version.h"
#include "job/view_comparison.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

std::string describePrecision(const mobile::Options& options, const gpu::Device& device) {
  const mobile::Precision precision = mobile::precisionOn(device, options);
  const std::string name = mobile::precisionNames()[static_cast<std::size_t>(precision)];
  return precision == options.precision ? name : name + ", as the device has no shaderFloat16";
}

std::vector<std::pair<std::string, std::string>> describe(const Settings& s, const base::DisplayTransform& display,
                                                          const gpu::Device& device) {
  const auto nameOf = [](const std::vector<std::string>& names, auto value) {
    return names[static_cast<std::size_t>(value)];
  };
  std::vector<std::pair<std::string, std::string>> settings = {
      {"size", fmt::format("{}x{}", s.width, s.height)},
      {"samples", std::to_string(s.samples)},
      {"display", display.name()},
      {"exposure", fmt::format("{} EV", s.exposureEv)},
      {"background", fmt::format("{},{},{}", s.background.x, s.background.y, s.background.z)},
      {"sun extraction", s.extractSun ? "on" : "off"},
      {"specular anti-aliasing", s.specularAa == gpu::SpecularAa::toksvig ? "Toksvig" : "off"},
      {"highend geometry term", nameOf(highend::geometryTermNames(), s.highend.geometryTerm)},
      {"highend fresnel", nameOf(highend::fresnelNames(), s.highend.fresnel)},
      {"highend diffuse", nameOf(highend::diffuseNames(), s.highend.diffuse)},
      {"highend compensation", nameOf(highend::compensationNames(), s.highend.compensation)},
      {"highend off-specular", nameOf(highend::offSpecularNames(), s.highend.offSpecular)},
      {"mobile preset", s.mobile.preset},
      {"mobile precision", describePrecision(s.mobile, device)},
      {"mobile sky", fmt::format("{} SH coefficients", s.mobile.skyCoefficients)},
      {"mobile capture", fmt::format("{}, scaled: {}", nameOf(mobile::captureEncodingNames(), s.mobile.capture),
                                     nameOf(mobile::captureScaleNames(), s.mobile.captureScale))},
      {"mobile target", nameOf(gpu::outputTargetNames(), s.mobileTarget) +
                            (gpu::isDisplayed(s.mobileTarget) ? ", as displayed: light above white is cut off" : "")},
      {"materials", s.materials.empty() ? "all" : fmt::format("{}", fmt::join(s.materials, ", "))},
      {"fully rough", s.fullyRough.empty() ? "none" : fmt::format("{}", fmt::join(s.fullyRough, ", "))}};
  if (s.truth) settings.emplace_back("truth", describeTruth(s));
  return settings;
}

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
    compare::SceneResult result;
    result.name = request.name;
    result.source = scenes::cleanName(std::filesystem::path(request.scene).filename().string());
    result.environment = request.environment.empty()
                             ? "none"
                             : scenes::cleanName(std::filesystem::path(request.environment).filename().string());
    result.sun = "none";
    result.light = scenes::describe(request.lightScales, request.fog);
    try {
      tell(index, 0, request.views.size(), "loading");
      const Paths paths{.reference = m_context.settings().truth};
      const PreparedScene prepared = prepareScene(m_context, request, paths);
      result.environment = prepared.environmentName;
      result.sun = prepared.sunText;
      result.warnings = prepared.scene.warnings;
      requireMaterials(prepared.scene, m_context.settings().materials);
      const compare::Budgets budgets = budgetsFor(request);
      SceneRenderer renderer(m_context, prepared, paths, request.views.size());
      for (const std::string& note : renderer.notes()) result.warnings.push_back("mobile: " + note);
      for (std::string& excess : mobile::samplerWarnings(prepared.scene, samplerInputs(prepared)))
        result.warnings.push_back(std::move(excess));
      for (std::size_t v = 0; v < request.views.size(); ++v) {
        tell(index, static_cast<double>(v), request.views.size(), request.views[v].name);
        result.views.push_back(compareOne(index, v, prepared, renderer, budgets));
      }
      result.permutations = renderer.permutations();
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

private:
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

  compare::ViewResult compareOne(std::size_t sceneIndex, std::size_t viewIndex, const PreparedScene& prepared,
                                 SceneRenderer& renderer, const compare::Budgets& budgets) {
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
    comparison.sceneName = request.name;
    comparison.viewName = view.name;
    comparison.exposureEv = prepared.exposureEv;
    comparison.samplers = samplerInputs(prepared);
    comparison.reportFolder = m_request.folder;
    comparison.imagePrefix = imagePrefix(sceneIndex, request.name, viewIndex, view.name);
    compare::ViewResult result = compareView(m_context, prepared.scene, frames, budgets, comparison);
    result.skipped = renderer.skipped();
    return result;
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
  result.report.device = context.device().description();
  result.report.settings = describe(context.settings(), context.display(), context.device());
  if (!request.folder.empty()) prepareReportFolder(request.folder);
  Run run(context, request, std::move(budgets), progress);
  for (std::size_t i = 0; i < request.scenes.size(); ++i) result.report.scenes.push_back(run.compareScene(i));
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
