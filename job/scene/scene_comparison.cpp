#include "job/scene/scene_comparison.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "base/background.h"
#include "base/error.h"
#include "base/stopwatch.h"
#include "base/text/error_words.h"
#include "base/text/glob.h"
#include "compare/verdict/budget.h"
#include "job/conditions.h"
#include "job/context.h"
#include "job/result_cache.h"
#include "job/scene/dropped_lights.h"
#include "job/scene/dropped_lobes.h"
#include "job/scene/external_pictures.h"
#include "job/scene/material_cards.h"
#include "job/scene/material_choice.h"
#include "job/scene/scene_inputs.h"
#include "job/scene/scene_start.h"
#include "job/scene/view_rows.h"
#include "job/sentinels.h"
#include "job/stopped.h"
#include "job/view/view_attribution.h"
#include "job/view/view_comparison.h"
#include "report/judge.h"

namespace parity::job {

namespace {

// For each view the materials that are attributed.
using MaterialsByView = std::vector<std::vector<std::size_t>>;

bool isEmpty(const MaterialsByView& materials) {
  return std::ranges::all_of(materials, [](const auto& list) { return list.empty(); });
}

// Whether each glob matches a material of the result, which has those alone that any of them matches.
bool hasEach(const SceneRecord& record, const std::vector<std::string>& globs) {
  return std::ranges::all_of(globs, [&](const std::string& glob) {
    return std::ranges::any_of(record.result.materials,
                               [&](const auto& each) { return base::matchesGlob(glob, each.name); });
  });
}

class SceneComparison {
public:
  SceneComparison(Context& context, const ReportRequest& request, const RunBudgets& budgets, const Tell& tell)
      : m_context(context), m_request(request), m_budgets(budgets), m_tell(tell) {}

  ComparedScene run(std::size_t index) {
    const SceneRequest& request = m_request.scenes[index];
    ComparedScene scene;
    report::SceneResult& result = scene.result = startScene(request);
    Conditions conditions;
    std::optional<compare::Budgets> budgets; // once they are known
    const auto setError = [&](const std::string& message, base::ExitCode code) {
      scene.error = fmt::format("{}: {}", result.name, message); // several problems are several lines
      for (std::size_t at = scene.error.find('\n'); at != std::string::npos; at = scene.error.find('\n', at + 1))
        scene.error.insert(at + 1, result.name + ": ");
      result.error = withoutFolders(message, request);
      result.errorExitCode = static_cast<int>(code);
    };
    try {
      conditions = conditionsNow(request);
      budgets = m_budgets.of(request);
      const Judges judges{*budgets, m_budgets.baseline(), request.name, conditions,
                          m_context.deviceReport().description()};
      const ResultWish wish = wishFor(index, *budgets);
      // An empty cache holds no result: how the machine rounds, which is in the key, need not be known yet.
      const std::optional<std::string> key =
          m_context.cache().isEmpty() ? std::nullopt : resultKey(m_context, conditions, wish);
      std::optional<SceneRecord> cached = key ? recall(*key, index, judges, scene.inputs) : std::nullopt;
      if (cached && !std::ranges::binary_search(m_request.sentinels, index)) {
        result = std::move(cached->result);
        scene.pictures = std::move(cached->pictures);
        scene.isCached = true;
      } else {
        scene.inputs.clear(); // recalling has read some
        // A sentinel that comes out otherwise must not replace what the cache holds.
        measureScene(index, wish, !cached && keepsResults(m_context), judges, scene);
        if (cached) requireSame(*cached, {result, prefixesOf(request, index), scene.pictures});
      }
      result.passes.push_back(attributionPass(request.settings.attribution, result));
    } catch (const Stopped& stopped) {
      report::setNotRun(result, stopped.signal);
    } catch (const base::Error& error) {
      // One catch at the boundary of each scene: the others still run.
      setError(error.what(), error.code());
    } catch (const std::exception& error) {
      setError(base::wordsOf(error), base::ExitCode::failed);
    }
    if (budgets) report::judgeScene(result, *budgets); // the views that were done, whatever became of the others
    result.conditions = reported(conditions.scene);
    result.inputs = inputsOf(request, conditions, scene.inputs);
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

  static void setConditions(const SceneRequest& request, report::SceneResult& result, const Conditions& conditions) {
    std::size_t row = 0;
    forEachView(request, [&](const ViewOfPath& view) {
      if (row < result.views.size()) result.views[row++].conditions = conditionsOfRow(request, view, conditions);
    });
  }

  // Pictures of another engine are held to their transfer, too.
  static std::vector<compare::Condition> conditionsOfRow(const SceneRequest& request, const ViewOfPath& row,
                                                         const Conditions& conditions) {
    std::vector<compare::Condition> all = reported(conditions.views[row.view]);
    const std::vector<Column> columns = columnsOf(request);
    for (const std::size_t column : {row.reference, row.test})
      if (const scenes::ExternalPictures* external = columns[column].external)
        all.push_back({"transfer of " + columns[column].name, external->transfer, compare::ActsOn::figures});
    return all;
  }

  // Both are paths, and the reference is the first: there are terms.
  static bool isOfPaths(const SceneRequest& request, const ViewOfPath& row) {
    return row.reference == 0 && row.test < request.settings.pathNames.size();
  }

  // The scene as an earlier run has left it, its pictures written: with the attributions that this run's judges ask
  // for, and no others.
  std::optional<SceneRecord> recall(const std::string& key, std::size_t index, const Judges& judges,
                                    std::vector<scenes::SourceFile>& inputs) {
    const base::Stopwatch watch(&m_context.timings(), "recall results");
    std::optional<SceneRecord> record = findResult(m_context.cache(), key, m_request.scenes[index], &inputs);
    // A result of a run over several scenes is kept although another scene alone has a material of some glob.
    if (!record || (m_request.scenes.size() == 1 && !hasEach(*record, m_request.scenes[index].settings.materials)))
      return std::nullopt;
    MaterialsByView attributed;
    setConditions(m_request.scenes[index], record->result, judges.conditions);
    const SceneRequest& request = m_request.scenes[index];
    std::size_t row = 0;
    forEachView(request, [&](const ViewOfPath& view) {
      if (row >= record->result.views.size()) return;
      const report::ViewResult& result = record->result.views[row++];
      attributed.push_back(isOfPaths(request, view) ? materialsToAttribute(request.settings.attribution, result, judges)
                                                    : std::vector<std::size_t>());
    });
    const std::vector<std::string> prefixes = prefixesOf(m_request.scenes[index], index);
    renamePictures(*record, prefixes);
    if (!isEmpty(attributed)) {
      std::optional<SceneRecord> more =
          findResult(m_context.cache(), attributedKey(key, attributed), m_request.scenes[index]);
      if (!more) return std::nullopt;
      renamePictures(*more, prefixes);
      record->result = std::move(more->result);
      setConditions(m_request.scenes[index], record->result, judges.conditions);
      std::ranges::move(more->pictures, std::back_inserter(record->pictures));
    }
    return record;
  }

  ResultWish wishFor(std::size_t index, const compare::Budgets& budgets) const {
    const SceneRequest& request = m_request.scenes[index];
    const WholeRun whole = request.partOf.value_or(WholeRun{index, m_request.scenes.size(), request.views.size()});
    return {compare::requiredStatistics(budgets), !m_request.folder.empty() && m_request.pictures != Pictures::none,
            m_request.pixelData, gpu::shareOf(whole.place, whole.scenes), whole.views};
  }

  // Fills the result, view by view: what was done before an error stays. Keeps it for later runs.
  void measureScene(std::size_t index, const ResultWish& wish, bool isKept, const Judges& judges,
                    ComparedScene& scene) {
    const SceneRequest& request = m_request.scenes[index];
    report::SceneResult& result = scene.result;
    m_context.requireGoesOn();
    m_tell(0, "loading");
    const PathChoice paths = pathsOf(request.settings);
    PreparedScene prepared = beginScene(m_context, request, paths);
    scene.inputs = prepared.scene.sources;
    result.environment = prepared.environmentName;
    result.sun = prepared.sunText;
    result.warnings = prepared.scene.warnings;
    const auto addLight = [&](const std::string& text) { result.light += (result.light.empty() ? "" : "; ") + text; };
    if (prepared.baked) addLight(fmt::format("baked: {}; ASTC {}", prepared.baked->settings, prepared.baked->astc));
    const auto saySceneLight = [&] { // of a light that is finished
      const bool hasCaptures = prepared.baked && !prepared.baked->captures.empty();
      for (const paths::Path* path : paths.chosen)
        if (hasCaptures || lightOf(prepared, *path).environment)
          if (const std::string words = path->describeLight(request.settings.options, hasCaptures); !words.empty())
            addLight(words);
      result.warnings = prepared.scene.warnings;
    };
    if (m_request.scenes.size() > 1 && !hasAnyMaterial(prepared.scene, request.settings.materials)) {
      finishLight(prepared);
      saySceneLight();
      scene.isLeftOut = true;
      for (const scenes::Material& material : prepared.scene.materials) scene.materials.push_back(material.name);
      return;
    }
    if (m_request.scenes.size() == 1) requireMaterials(prepared.scene, request.settings.materials);
    m_context.requireGoesOn();
    // As if nothing were attributed, and what attribution adds: another run's budgets may ask for the one alone.
    std::vector<report::ViewResult> plainViews;
    std::vector<EncodedPicture> plainPictures, addedPictures;
    // What the report or the cache will need of a processor as the device, once a core has nothing better to do.
    if (m_request.scenes.size() == 1 && m_context.deviceReport().kind == "cpu" && (isKept || !m_request.folder.empty()))
      m_context.beginNumerics([environments = prepared.pendingEnvironments] {
        if (environments.isValid()) environments.waitPatiently();
      });
    // While the scene goes to the device. An image is freed once both have read it.
    const auto cards = base::Background<MaterialCards>::begin([&] {
      const base::Stopwatch watch(&m_context.timings(), "material cards");
      return describeMaterials(prepared.scene, request.settings.materials, wish.pictures);
    });
    gpu::ImageDone release = imageRelease(prepared, paths);
    if (release)
      release = [cards, &prepared, free = std::move(release)](int image) {
        if (prepared.scene.images[static_cast<std::size_t>(image)].pixels.empty()) return;
        cards.wait();
        free(image);
      };
    SceneRenderer renderer(m_context, prepared, cameraOf(request, 0, prepared), paths, wish.views, wish.permutations,
                           std::move(release));
    saySceneLight();
    for (std::string& note : renderer.notes()) result.warnings.push_back(std::move(note));
    for (std::size_t i = 0; i < paths.chosen.size(); ++i)
      for (const scenes::Material& material : prepared.scene.materials)
        if (const std::string excess = renderer.renderer(i).describeExcess(material); !excess.empty())
          result.warnings.push_back(fmt::format("material '{}' {}", material.name, excess));
    MaterialsByView attributed;
    std::uint64_t comparedPixels = 0;
    ViewFrames frames;
    ExternalPictureReader pictures(
        request); // of other engines; without one that cannot be used the others are compared
    const std::vector<Column> columns = columnsOf(request);
    forEachView(request, [&](const ViewOfPath& view) {
      const std::size_t v = view.view, row = attributed.size();
      if (view == rowsOfView(request, v).front()) {
        m_tell(static_cast<double>(v) / static_cast<double>(request.views.size()), request.views[v].name);
        frames = {}; // before the next one takes memory
        frames = renderView(request, v, prepared, renderer);
        pictures.addTo(frames, v);
      }
      const bool isOurs = isOfPaths(request, view);
      const auto isThere = [&](std::size_t column) { return !frames.paths[column].frame.color.empty(); };
      if (!isThere(view.test) || !isThere(view.reference)) return attributed.push_back({});
      const scenes::Camera camera = cameraOf(request, v, prepared);
      m_context.requireGoesOn();
      std::optional<DroppedChoice> droppedLights;
      base::Background<bool> compiled; // the shaders of pictures without these lights; ends before what it refers to
      if (isOurs)
        droppedLights =
            chooseDroppedLights(prepared, renderer, view.test,
                                chooseMaterials(prepared.scene, request.settings.materials, frames.coverage.size()));
      if (droppedLights)
        compiled = base::Background<bool>::begin([&] {
          renderer.compileWithout(droppedLights->measured, camera);
          return true;
        });
      ComparedView compared = compareOne(index, view, prepared, renderer, frames, wish);
      comparedPixels += compared.view.whole.pixels;
      compared.view.conditions = conditionsOfRow(request, view, judges.conditions);
      if (isOurs) {
        if (compiled.isValid()) compiled.get();
        if (droppedLights)
          compared.view.droppedLights =
              measureDroppedLights(m_context, prepared, renderer, camera, frames, compared, std::move(*droppedLights));
        measureDroppedLobes(m_context, prepared, renderer, camera, frames, compared);
      }
      if (isKept) plainViews.push_back(compared.view);
      std::vector<EncodedPicture> termPictures;
      attributed.push_back(isOurs ? materialsToAttribute(request.settings.attribution, compared.view, judges)
                                  : std::vector<std::size_t>());
      if (!attributed[row].empty()) {
        const bool isLate = !request.settings.terms; // compareView had none to write
        if (isLate) {
          std::vector<std::size_t> materials;
          for (const std::size_t i : attributed[row]) materials.push_back(compared.materials[i]);
          renderer.addTerms(frames, view.test, camera, materials);
        }
        attributeView(m_context, frames, attributed[row], request.settings, *paths.chosen[view.test], compared);
        if (isLate && wish.pictures && wish.pixelData) {
          const base::Stopwatch watch(&m_context.timings(), "encode images");
          termPictures =
              encodeTerms(compared.view, termPlanesOf(frames, columns, view.test), prefixesOf(request, index)[row]);
        }
        if (isLate) { // the next row is compared as if this one had none
          frames.paths.front().frame.terms.clear();
          frames.paths[view.test].frame.terms.clear();
        }
      }
      // Last: a view that is given up leaves no pictures, and a scene without any view no cards.
      if (result.views.empty()) {
        result.materials = cards.get().cards;
        keepPictures(cards.get().pictures, scene, isKept ? &plainPictures : nullptr);
      }
      keepPictures(std::move(compared.pictures), scene, isKept ? &plainPictures : nullptr);
      keepPictures(std::move(termPictures), scene, isKept ? &addedPictures : nullptr);
      result.views.push_back(std::move(compared.view));
    });
    scene.inputs = prepared.scene.sources;
    scene.inputs.insert(scene.inputs.end(), pictures.sources().begin(), pictures.sources().end());
    for (std::string& warning : renderer.warnings()) result.warnings.push_back(std::move(warning));
    for (std::string& warning : pictures.warnings()) result.warnings.push_back(std::move(warning));
    if (pictures.problem()) throw base::Error(*pictures.problem());
    result.permutations = renderer.permutations();
    const auto passesOf = [&](Work work) {
      work.comparedPixels = comparedPixels;
      if (request.settings.truth) work.comparedWithTruth = comparedPixels;
      if (request.settings.costs) work.countedShaders = result.permutations.size();
      return describePasses(work, renderer.reasons());
    };
    result.passes = passesOf(renderer.workWithTerms());
    // The same key again: the environment is still what it was when the scene was lit by it.
    if (!isKept) return;
    const std::optional<std::string> key = resultKey(m_context, judges.conditions, wish);
    if (!key || resultKey(m_context, conditionsNow(request), wish) != key) return;
    const base::Stopwatch watch(&m_context.timings(), "keep results");
    SceneRecord plain{result, prefixesOf(request, index), std::move(plainPictures)};
    plain.result.views = std::move(plainViews);
    plain.result.passes = passesOf(renderer.work());
    storeResult(m_context.cache(), *key, request, scene.inputs, plain);
    if (!isEmpty(attributed))
      storeResult(m_context.cache(), attributedKey(*key, attributed), request, scene.inputs,
                  {result, plain.prefixes, std::move(addedPictures)});
  }

  // Puts them with the scene, and with what is to be kept.
  static void keepPictures(std::vector<EncodedPicture> pictures, ComparedScene& scene,
                           std::vector<EncodedPicture>* kept) {
    scene.pictures.insert(scene.pictures.end(), pictures.begin(), pictures.end());
    if (kept) std::ranges::move(pictures, std::back_inserter(*kept));
  }

  scenes::Camera cameraOf(const SceneRequest& request, std::size_t view, const PreparedScene& prepared) const {
    const Settings& settings = request.settings;
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
      throw base::fileError(request.scene, fmt::format("view '{}'", view.name),
                            "shows no part of the scene; change the camera");
    return frames;
  }

  ComparedView compareOne(std::size_t sceneIndex, const ViewOfPath& view, const PreparedScene& prepared,
                          const SceneRenderer& renderer, const ViewFrames& frames, const ResultWish& wish) {
    const SceneRequest& request = m_request.scenes[sceneIndex];
    const std::string name = viewName(request, view);
    return compareView(
        m_context, prepared.scene, frames,
        {.viewName = name,
         .settings = request.settings,
         .paths = renderer.paths(),
         .columns = columnsOf(request),
         .reference = view.reference,
         .test = view.test,
         .renderer = view.test < renderer.paths().chosen.size() ? &renderer.renderer(view.test) : nullptr,
         .statistics = wish.statistics,
         .pictures = wish.pictures,
         .pixelData = wish.pixelData,
         .imagePrefix = prefixesOf(request, sceneIndex)[rowOf(request, view)]});
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

ComparedScene notRunScene(const SceneRequest& request, int signal) {
  ComparedScene scene;
  scene.result = startScene(request);
  report::setNotRun(scene.result, signal);
  return scene;
}

} // namespace parity::job
