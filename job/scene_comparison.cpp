#include "job/scene_comparison.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "base/error.h"
#include "base/error_words.h"
#include "base/stopwatch.h"
#include "compare/budget.h"
#include "job/conditions.h"
#include "job/context.h"
#include "job/dropped_lights.h"
#include "job/material_choice.h"
#include "job/report_folder.h"
#include "job/result_cache.h"
#include "job/settings_text.h"
#include "job/view_attribution.h"
#include "job/view_comparison.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

// A message without the folders of the scene's files: a report does not say where on this machine they lie.
std::string withoutFolders(std::string text, const SceneRequest& request) {
  for (const std::string& file : {request.scene, request.environment, request.budgets.value_or("")}) {
    const std::string folder = (std::filesystem::path(file).parent_path() / "").string();
    if (folder.empty()) continue;
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
      if (at == 0 || text[at - 1] == ' ' || text[at - 1] == '\n' || text[at - 1] == '\'')
        text.erase(at, folder.size());
      else
        ++at; // the end of another path
  }
  return text;
}

// For each view the materials that are attributed.
using MaterialsByView = std::vector<std::vector<std::size_t>>;

bool isEmpty(const MaterialsByView& materials) {
  return std::ranges::all_of(materials, [](const auto& list) { return list.empty(); });
}

class SceneComparison {
public:
  SceneComparison(Context& context, const ReportRequest& request, const RunBudgets& budgets, const Tell& tell)
      : m_context(context), m_request(request), m_budgets(budgets), m_tell(tell) {}

  ComparedScene run(std::size_t index) {
    const SceneRequest& request = m_request.scenes[index];
    ComparedScene scene;
    compare::SceneResult& result = scene.result = startScene(request, m_context.settings());
    Conditions conditions;
    const auto setError = [&](const std::string& message, base::ExitCode code) {
      scene.error = fmt::format("{}: {}", result.name, message); // several problems are several lines
      for (std::size_t at = scene.error.find('\n'); at != std::string::npos; at = scene.error.find('\n', at + 1))
        scene.error.insert(at + 1, result.name + ": ");
      result.error = withoutFolders(message, request);
      result.errorExitCode = static_cast<int>(code);
    };
    try {
      conditions = conditionsNow(request);
      const compare::Budgets budgets = budgetsFor(request);
      const Judges judges{budgets, m_budgets.baseline, request.name, conditions,
                          m_context.deviceReport().description()};
      const ResultWish wish = wishFor(index, budgets);
      const std::optional<std::string> key = resultKey(m_context, conditions, wish);
      if (std::optional<SceneRecord> cached = key ? recall(*key, index, judges) : std::nullopt) {
        result = std::move(cached->result);
        if (m_request.singleFile) scene.pictures = std::move(cached->pictures);
        scene.isCached = true;
      } else {
        measureScene(index, wish, key, judges, scene);
      }
      result.passes.push_back(attributionPass(m_context.settings().attribution, result));
      for (compare::ViewResult& view : result.views) {
        for (compare::MaterialResult& material : view.materials)
          compare::judgeMaterial(material, budgets, request.name);
        compare::judgeWhole(view, budgets, request.name);
      }
    } catch (const base::Error& error) {
      // One catch at the boundary of each scene: the others still run.
      setError(error.what(), error.code());
    } catch (const std::exception& error) {
      setError(base::wordsOf(error), base::ExitCode::failed);
    }
    result.conditions = reported(conditions.scene);
    for (std::string& warning : result.warnings) {
      scene.warnings.push_back(fmt::format("{}: {}", result.name, warning));
      warning = withoutFolders(std::move(warning), request);
    }
    return scene;
  }

private:
  // With the files as they are now.
  Conditions conditionsNow(const SceneRequest& request) const {
    return conditionsOf(m_context.settings(), request, m_context.deviceReport());
  }

  static compare::SceneResult startScene(const SceneRequest& request, const Settings& settings) {
    compare::SceneResult result;
    result.name = request.name;
    result.source = scenes::cleanName(std::filesystem::path(request.scene).filename().string());
    result.environment = request.environment.empty()
                             ? "none"
                             : scenes::cleanName(std::filesystem::path(request.environment).filename().string());
    result.sun = "none";
    result.light = scenes::describe(request.lightScales, request.fog, request.falloff);
    const auto add = [&](const std::string& text) { result.light += (result.light.empty() ? "" : "; ") + text; };
    if (request.shadows.value_or(settings.shadows)) add("shadows");
    const int bounces = request.interreflection.value_or(settings.reference.bounces);
    if (settings.truth && bounces > 0)
      add(fmt::format("in the truth {} bounce{} between surfaces", bounces, bounces > 1 ? "s" : ""));
    return result;
  }

  std::vector<std::string> prefixesOf(std::size_t index) const {
    const SceneRequest& request = m_request.scenes[index];
    std::vector<std::string> prefixes;
    for (std::size_t v = 0; v < request.views.size(); ++v)
      prefixes.push_back(imagePrefix(index, request.name, v, request.views[v].name));
    return prefixes;
  }

  static void setConditions(compare::SceneResult& result, const Conditions& conditions) {
    for (std::size_t v = 0; v < result.views.size(); ++v) result.views[v].conditions = reported(conditions.views[v]);
  }

  // The scene as an earlier run has left it, its pictures written: with the attributions that this run's judges ask
  // for, and no others.
  std::optional<SceneRecord> recall(const std::string& key, std::size_t index, const Judges& judges) {
    const base::Stopwatch watch(&m_context.timings(), "recall results");
    std::optional<SceneRecord> record = findResult(m_context.cache(), key, m_request.scenes[index]);
    if (!record) return std::nullopt;
    MaterialsByView attributed;
    setConditions(record->result, judges.conditions);
    for (const compare::ViewResult& view : record->result.views)
      attributed.push_back(materialsToAttribute(m_context.settings().attribution, view, judges));
    const std::vector<std::string> prefixes = prefixesOf(index);
    renamePictures(*record, prefixes);
    if (!isEmpty(attributed)) {
      std::optional<SceneRecord> more =
          findResult(m_context.cache(), attributedKey(key, attributed), m_request.scenes[index]);
      if (!more) return std::nullopt;
      renamePictures(*more, prefixes);
      record->result = std::move(more->result);
      setConditions(record->result, judges.conditions);
      std::ranges::move(more->pictures, std::back_inserter(record->pictures));
    }
    if (!m_request.singleFile) writePictures(record->pictures, m_request.folder);
    return record;
  }

  Paths paths() const { return {.reference = m_context.settings().truth}; }

  ResultWish wishFor(std::size_t index, const compare::Budgets& budgets) const {
    return {compare::requiredStatistics(budgets), !m_request.folder.empty(), m_request.pixelData,
            gpu::shareOf(index, m_request.scenes.size())};
  }

  // Fills the result, view by view: what was done before an error stays. Keeps it for later runs.
  void measureScene(std::size_t index, const ResultWish& wish, const std::optional<std::string>& key,
                    const Judges& judges, ComparedScene& scene) {
    const SceneRequest& request = m_request.scenes[index];
    compare::SceneResult& result = scene.result;
    m_tell(0, "loading");
    PreparedScene prepared = prepareScene(m_context, request, paths());
    result.environment = prepared.environmentName;
    result.sun = prepared.sunText;
    const auto addLight = [&](const std::string& text) { result.light += (result.light.empty() ? "" : "; ") + text; };
    if (prepared.baked) addLight(fmt::format("baked: {}; ASTC {}", prepared.baked->settings, prepared.baked->astc));
    if (const bool hasCaptures = prepared.baked && !prepared.baked->captures.empty();
        hasCaptures || prepared.mobileEnvironment)
      addLight(describeCaptureScale(m_context.settings().mobile, hasCaptures));
    result.warnings = prepared.scene.warnings;
    requireMaterials(prepared.scene, m_context.settings().materials);
    SceneRenderer renderer(m_context, prepared, paths(), request.views.size(), wish.permutations,
                           imageRelease(prepared, paths()));
    for (const std::string& note : renderer.notes()) result.warnings.push_back("mobile: " + note);
    for (std::string& excess : mobile::samplerWarnings(prepared.scene, samplerInputs(prepared)))
      result.warnings.push_back(std::move(excess));
    // As if nothing were attributed, and what attribution adds: another run's budgets may ask for the one alone.
    std::vector<compare::ViewResult> plainViews;
    std::vector<EncodedPicture> plainPictures, addedPictures;
    MaterialsByView attributed;
    std::uint64_t comparedPixels = 0;
    for (std::size_t v = 0; v < request.views.size(); ++v) {
      m_tell(static_cast<double>(v) / static_cast<double>(request.views.size()), request.views[v].name);
      ViewFrames frames = renderView(request, v, prepared, renderer);
      ComparedView compared = compareOne(index, v, prepared, frames, wish);
      comparedPixels += compared.view.whole.pixels;
      compared.view.conditions = reported(judges.conditions.views[v]);
      compared.view.droppedLights =
          measureDroppedLights(m_context, prepared, renderer, cameraOf(request, v, prepared), frames, compared);
      if (key) plainViews.push_back(compared.view);
      keepPictures(std::move(compared.pictures), scene, key ? &plainPictures : nullptr);
      attributed.push_back(materialsToAttribute(m_context.settings().attribution, compared.view, judges));
      if (!attributed[v].empty()) {
        const bool isLate = frames.highend.terms.empty(); // compareView had none to write
        if (isLate) {
          std::vector<std::size_t> materials;
          for (const std::size_t i : attributed[v]) materials.push_back(compared.materials[i]);
          renderer.addTerms(frames, cameraOf(request, v, prepared), materials);
        }
        attributeView(m_context, frames, attributed[v], prepared.exposureEv, compared);
        if (isLate && wish.pictures && wish.pixelData) {
          const base::Stopwatch watch(&m_context.timings(), "encode images");
          keepPictures(encodeTerms(compared.view, frames, prefixesOf(index)[v]), scene, key ? &addedPictures : nullptr);
        }
      }
      result.views.push_back(std::move(compared.view));
    }
    for (std::string& warning : renderer.warnings()) result.warnings.push_back(std::move(warning));
    result.permutations = renderer.permutations();
    const auto passesOf = [&](Work work) {
      work.comparedPixels = comparedPixels;
      if (m_context.settings().truth) work.comparedWithTruth = comparedPixels;
      if (m_context.settings().costs) work.countedShaders = result.permutations.size();
      return describePasses(work, renderer.reasons());
    };
    result.passes = passesOf(renderer.workWithTerms());
    // The same key again: the environment is still what it was when the scene was lit by it.
    if (!key || resultKey(m_context, conditionsNow(request), wish) != key) return;
    const base::Stopwatch watch(&m_context.timings(), "keep results");
    SceneRecord plain{result, prefixesOf(index), std::move(plainPictures)};
    plain.result.views = std::move(plainViews);
    plain.result.passes = passesOf(renderer.work());
    storeResult(m_context.cache(), *key, request, prepared.scene.sources, plain);
    if (!isEmpty(attributed))
      storeResult(m_context.cache(), attributedKey(*key, attributed), request, prepared.scene.sources,
                  {result, plain.prefixes, std::move(addedPictures)});
  }

  // Writes them, or leaves them with the scene for a single file; and puts them with what is to be kept.
  void keepPictures(std::vector<EncodedPicture> pictures, ComparedScene& scene, std::vector<EncodedPicture>* kept) {
    if (m_request.singleFile) {
      scene.pictures.insert(scene.pictures.end(), pictures.begin(), pictures.end());
    } else {
      const base::Stopwatch watch(&m_context.timings(), "write images");
      writePictures(pictures, m_request.folder);
    }
    if (kept) std::ranges::move(pictures, std::back_inserter(*kept));
  }

  mobile::SamplerInputs samplerInputs(const PreparedScene& prepared) const {
    return {.environment =
                prepared.mobileEnvironment != nullptr || (prepared.baked && !prepared.baked->captures.empty()),
            .shadowMap = !mobile::Renderer::needsShadowMaps(prepared.mobileLights, m_context.settings().mobile).empty(),
            .lightmap = prepared.baked != nullptr,
            .sunShadow = prepared.baked && !prepared.baked->sunField.empty(),
            .normalVariance = m_context.settings().specularAa == gpu::SpecularAa::toksvig};
  }

  compare::Budgets budgetsFor(const SceneRequest& request) const {
    if (m_budgets.first) return *m_budgets.first;
    return request.budgets ? compare::loadBudgets(*request.budgets) : m_budgets.otherwise;
  }

  scenes::Camera cameraOf(const SceneRequest& request, std::size_t view, const PreparedScene& prepared) const {
    const Settings& settings = m_context.settings();
    return scenes::makeCamera(prepared.scene, request.views[view],
                              static_cast<float>(settings.width) / static_cast<float>(settings.height));
  }

  ViewFrames renderView(const SceneRequest& request, std::size_t index, const PreparedScene& prepared,
                        SceneRenderer& renderer) {
    const scenes::ViewRequest& view = request.views[index];
    const Progress tellReference = [&](const std::string& what, double done) {
      m_tell((static_cast<double>(index) + done) / static_cast<double>(request.views.size()), view.name + ", " + what);
    };
    ViewFrames frames = renderer.render(cameraOf(request, index, prepared), tellReference);
    // A picture of nothing but background compares as equal: that is no answer.
    if (std::all_of(frames.coverage.begin(), frames.coverage.end(),
                    [](const auto& list) { return list.pixels.empty(); }))
      throw base::fileError(request.scene, fmt::format("view '{}'", view.name), "shows no part of the scene");
    return frames;
  }

  ComparedView compareOne(std::size_t sceneIndex, std::size_t viewIndex, const PreparedScene& prepared,
                          const ViewFrames& frames, const ResultWish& wish) {
    const SceneRequest& request = m_request.scenes[sceneIndex];
    ViewComparisonRequest comparison;
    comparison.viewName = request.views[viewIndex].name;
    comparison.exposureEv = prepared.exposureEv;
    comparison.samplers = samplerInputs(prepared);
    comparison.statistics = wish.statistics;
    comparison.pictures = wish.pictures;
    comparison.pixelData = wish.pixelData;
    comparison.imagePrefix = imagePrefix(sceneIndex, request.name, viewIndex, comparison.viewName);
    return compareView(m_context, prepared.scene, frames, comparison);
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
