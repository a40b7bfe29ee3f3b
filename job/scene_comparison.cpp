#include "job/scene_comparison.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/glob.h"
#include "base/stopwatch.h"
#include "compare/budget.h"
#include "job/context.h"
#include "job/report_folder.h"
#include "job/result_cache.h"
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

class SceneComparison {
public:
  SceneComparison(Context& context, const ReportRequest& request, const RunBudgets& budgets, const Tell& tell)
      : m_context(context), m_request(request), m_budgets(budgets), m_tell(tell) {}

  ComparedScene run(std::size_t index) {
    const SceneRequest& request = m_request.scenes[index];
    ComparedScene scene;
    compare::SceneResult& result = scene.result = startScene(request);
    const auto setError = [&](const char* message, base::ExitCode code) {
      scene.error = fmt::format("{}: {}", result.name, message);
      result.error = withoutFolders(message, request);
      result.errorExitCode = static_cast<int>(code);
    };
    try {
      const compare::Budgets budgets = budgetsFor(request);
      const ResultWish wish = wishFor(index, budgets);
      const std::optional<std::string> key = resultKey(m_context, request, wish);
      if (std::optional<SceneRecord> cached = key ? recall(*key, index) : std::nullopt) {
        result = std::move(cached->result);
        if (m_request.singleFile) scene.pictures = std::move(cached->pictures);
        scene.isCached = true;
      } else {
        measureScene(index, wish, key, scene);
      }
      for (compare::ViewResult& view : result.views) {
        for (compare::MaterialResult& material : view.materials)
          compare::judgeMaterial(material, budgets, request.name);
        compare::judgeWhole(view, budgets, request.name);
      }
    } catch (const base::Error& error) {
      // One catch at the boundary of each scene: the others still run.
      setError(error.what(), error.code());
    } catch (const std::exception& error) {
      setError(error.what(), base::ExitCode::failed);
    }
    if (!m_request.singleFile) scene.pictures = {};
    for (std::string& warning : result.warnings) {
      scene.warnings.push_back(fmt::format("{}: {}", result.name, warning));
      warning = withoutFolders(std::move(warning), request);
    }
    return scene;
  }

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
      if (!m_request.singleFile) writePictures(record->pictures, m_request.folder);
    }
    return record;
  }

  Paths paths() const { return {.reference = m_context.settings().truth}; }

  ResultWish wishFor(std::size_t index, const compare::Budgets& budgets) const {
    return {compare::requiredStatistics(budgets), !m_request.folder.empty(), m_request.pixelData,
            gpu::shareOf(index, m_request.scenes.size())};
  }

  // Fills the result, view by view: what was done before an error stays. Keeps it for later runs.
  void measureScene(std::size_t index, const ResultWish& wish, const std::optional<std::string>& key,
                    ComparedScene& scene) {
    const SceneRequest& request = m_request.scenes[index];
    compare::SceneResult& result = scene.result;
    m_tell(0, "loading");
    const PreparedScene prepared = prepareScene(m_context, request, paths());
    result.environment = prepared.environmentName;
    result.sun = prepared.sunText;
    result.warnings = prepared.scene.warnings;
    requireMaterials(prepared.scene, m_context.settings().materials);
    SceneRenderer renderer(m_context, prepared, paths(), request.views.size(), wish.permutations);
    for (const std::string& note : renderer.notes()) result.warnings.push_back("mobile: " + note);
    for (std::string& excess : mobile::samplerWarnings(prepared.scene, samplerInputs(prepared)))
      result.warnings.push_back(std::move(excess));
    std::vector<EncodedPicture>& pictures = scene.pictures;
    std::uint64_t comparedPixels = 0;
    for (std::size_t v = 0; v < request.views.size(); ++v) {
      m_tell(static_cast<double>(v) / static_cast<double>(request.views.size()), request.views[v].name);
      ComparedView compared = compareOne(index, v, prepared, renderer, wish);
      if (!m_request.singleFile) {
        const base::Stopwatch watch(&m_context.timings(), "write images");
        writePictures(compared.pictures, m_request.folder);
      }
      comparedPixels += compared.view.whole.all.pixels;
      result.views.push_back(std::move(compared.view));
      if (key || m_request.singleFile)
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
    SceneRecord record{result, prefixesOf(index), std::move(pictures)};
    storeResult(m_context.cache(), *key, request, prepared.scene.sources, record);
    pictures = std::move(record.pictures);
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
      m_tell((static_cast<double>(viewIndex) + done) / static_cast<double>(request.views.size()),
             view.name + ", " + what);
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
    comparison.pixelData = wish.pixelData;
    comparison.imagePrefix = imagePrefix(sceneIndex, request.name, viewIndex, view.name);
    ComparedView compared = compareView(m_context, prepared.scene, frames, comparison);
    return compared;
  }

  Context& m_context;
  const ReportRequest& m_request;
  const RunBudgets& m_budgets;
  const Tell& m_tell;
};

} // namespace

ComparedScene compareScene(Context& context, const ReportRequest& request, std::size_t index, const RunBudgets& budgets,
                           const Tell& tell) {
  return SceneComparison(context, request, budgets, tell).run(index);
}

} // namespace parity::job
