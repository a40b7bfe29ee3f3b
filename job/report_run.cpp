#include "job/report_run.h"

#include <algorithm>
#include <chrono>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/glob.h"
#include "base/log.h"
#include "job/version.h"
#include "job/view_comparison.h"

namespace parity::job {

namespace {

// Letters, digits, '-' and '_' stay; the rest becomes '_'. The index in front keeps two alike names apart.
std::string safeFileName(std::size_t index, const std::string& name) {
  std::string out = fmt::format("{}-", index);
  for (const char c : name)
    out += (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ? c : '_';
  return out.substr(0, 64);
}

std::vector<std::pair<std::string, std::string>> describe(const Settings& s, const base::DisplayTransform& display) {
  const bool correlated = s.highend.geometryTerm == highend::GeometryTerm::heightCorrelated;
  return {{"size", fmt::format("{}x{}", s.width, s.height)},
          {"samples", std::to_string(s.samples)},
          {"display", display.name()},
          {"exposure", fmt::format("{} EV", s.exposureEv)},
          {"background", fmt::format("{},{},{}", s.background.x, s.background.y, s.background.z)},
          {"highend geometry term", correlated ? "height-correlated Smith" : "Schlick-Smith"},
          {"highend energy compensation", s.highend.compensate ? "on" : "off"},
          {"mobile preset", s.mobilePresetName},
          {"mobile precision", "fp32"}};
}

void requireMaterials(const scenes::Scene& scene, const std::vector<std::string>& globs) {
  for (const std::string& glob : globs)
    if (std::none_of(scene.materials.begin(), scene.materials.end(),
                     [&](const auto& m) { return base::matchesGlob(glob, m.name); }))
      throw base::Error(base::ExitCode::failed, scene.name, fmt::format("--material '{}'", glob),
                        "no material has such a name");
}

class Run {
public:
  Run(Context& context, const ReportRequest& request, const Progress& progress)
      : m_context(context), m_request(request), m_progress(progress) {}

  compare::SceneResult compareScene(std::size_t index) {
    const SceneRequest& request = m_request.scenes[index];
    compare::SceneResult result;
    result.name = request.name;
    result.source = std::filesystem::path(request.scene).filename().string();
    result.environment =
        request.environment.empty() ? "none" : std::filesystem::path(request.environment).filename().string();
    result.sun = "none";
    try {
      tell(index, 0, request.views.size(), "loading");
      const PreparedScene prepared = prepareScene(m_context, request);
      result.environment = prepared.environmentName;
      result.sun = prepared.sunText;
      result.warnings = prepared.scene.warnings;
      requireMaterials(prepared.scene, m_context.settings().materials);
      const compare::Budgets budgets = budgetsFor(request);
      SceneRenderer renderer(m_context, prepared, Paths{}, request.views.size());
      for (const std::string& note : renderer.notes()) result.warnings.push_back("mobile: " + note);
      for (std::size_t v = 0; v < request.views.size(); ++v) {
        tell(index, v, request.views.size(), request.views[v].name);
        result.views.push_back(compareOne(index, v, prepared, renderer, budgets));
      }
    } catch (const base::Error& error) {
      // One catch at the boundary of each scene: the others still run.
      result.error = error.what();
      result.errorExitCode = static_cast<int>(error.code());
      base::logError(fmt::format("{}: {}", result.name, error.what()));
    } catch (const std::exception& error) {
      result.error = error.what();
      result.errorExitCode = static_cast<int>(base::ExitCode::failed);
      base::logError(fmt::format("{}: {}", result.name, error.what()));
    }
    for (const std::string& warning : result.warnings) base::logWarning(fmt::format("{}: {}", result.name, warning));
    return result;
  }

private:
  compare::Budgets budgetsFor(const SceneRequest& request) const {
    const auto& own = m_context.settings().budgets;
    if (own) return compare::loadBudgets(*own); // the command line goes first
    if (request.budgets) return compare::loadBudgets(*request.budgets);
    if (m_request.suiteBudgets) return compare::loadBudgets(*m_request.suiteBudgets);
    return compare::defaultBudgets();
  }

  compare::ViewResult compareOne(std::size_t sceneIndex, std::size_t viewIndex, const PreparedScene& prepared,
                                 SceneRenderer& renderer, const compare::Budgets& budgets) {
    const SceneRequest& request = m_request.scenes[sceneIndex];
    const Settings& settings = m_context.settings();
    const scenes::ViewRequest& view = request.views[viewIndex];
    const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
    const ViewFrames frames = renderer.render(scenes::makeCamera(prepared.scene, view, aspect));
    ViewComparisonRequest comparison;
    comparison.sceneName = request.name;
    comparison.viewName = view.name;
    comparison.exposureEv = request.exposureEv.value_or(settings.exposureEv);
    comparison.reportFolder = m_request.folder;
    comparison.imagePrefix = safeFileName(sceneIndex, request.name) + "_" + safeFileName(viewIndex, view.name);
    compare::ViewResult result = compareView(m_context, prepared.scene, frames, budgets, comparison);
    result.skipped = renderer.skipped();
    return result;
  }

  void tell(std::size_t scene, std::size_t view, std::size_t views, const std::string& what) const {
    if (!m_progress) return;
    const double share = views == 0 ? 0 : static_cast<double>(view) / static_cast<double>(views);
    m_progress(fmt::format("{}: {}", m_request.scenes[scene].name, what),
               (static_cast<double>(scene) + share) / static_cast<double>(m_request.scenes.size()));
  }

  Context& m_context;
  const ReportRequest& m_request;
  const Progress& m_progress;
};

void writeReport(const std::filesystem::path& folder, const ReportResult& result) {
  base::writeText(folder / "report.json", compare::toJson(result.report));
  base::writeText(folder / "run.json", compare::toJson(result.run));
  base::writeText(folder / "junit.xml", compare::toJunit(result.report, result.run));
  base::writeText(folder / "index.html", compare::toHtml(result.report, result.run));
}

} // namespace

ReportResult runReport(Context& context, const ReportRequest& request, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  ReportResult result;
  result.run.startedAt = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  result.run.commandLine = request.commandLine;
  result.report.version = kVersion;
  result.report.settings = describe(context.settings(), context.display());

  result.report.device = context.device().description(); // first: without a device nothing can be done
  Run run(context, request, progress);
  for (std::size_t i = 0; i < request.scenes.size(); ++i) result.report.scenes.push_back(run.compareScene(i));
  compare::settleVerdicts(result.report);
  if (progress) progress("writing", 1);

  result.run.timings = context.timings().stages();
  const std::chrono::duration<double, std::milli> total = std::chrono::steady_clock::now() - start;
  result.run.timings.emplace_back("total", total.count());
  if (!request.folder.empty()) writeReport(request.folder, result);
  return result;
}

} // namespace parity::job
