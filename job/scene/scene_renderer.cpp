#include "job/scene/scene_renderer.h"

#include <algorithm>
#include <cassert>
#include <set>

namespace parity::job {

namespace {

std::uint64_t pixelsOf(const Settings& settings, std::size_t views) {
  return static_cast<std::uint64_t>(settings.width) * settings.height * settings.samples * views;
}

// Tiles of a picture times samples of a pixel.
std::size_t partsOf(const Settings& settings) {
  return gpu::makeTiles(static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height))
             .size() *
         static_cast<std::size_t>(settings.samples);
}

// Entries of surfaces that wait to be looked at or shaded again: two of each pixel of a tile.
constexpr std::size_t kMaxKeptEntries = 2 * std::size_t{gpu::kMaxTilePixels};

} // namespace

SceneRenderer::SceneRenderer(WithoutLight, Context& context, const PreparedScene& prepared, const Settings& settings,
                             const PathChoice& paths, std::size_t views, const gpu::PermutationBudget& budget,
                             gpu::ImageDone onLastRead)
    : m_context(context), m_prepared(prepared), m_settings(settings), m_choice(paths), m_views(views), m_budget(budget),
      m_work(prepared.work), m_scene(context, prepared, settings, paths, std::move(onLastRead)) {
  if (prepared.baked) {
    m_work.lightmapPages = prepared.baked->lqPages.size();
    m_work.captures = prepared.baked->captures.size();
  }
  m_mayDropLights = mayDropLights();
  m_mayDropLobes = mayDropLobes();
  m_mayAddTerms = paths.compares() && !settings.terms && settings.attribution == Attribution::overBudget;
  // To write the terms takes a shader a third longer: less than to compile another one, and to shade again what is over
  // budget. Pictures in several parts would have to keep too much.
  m_shadesTerms = settings.terms || (m_mayAddTerms && paths.intermediate == 0 && partsOf(settings) == 1);
}

SceneRenderer::SceneRenderer(Context& context, const PreparedScene& prepared, const Settings& settings,
                             const PathChoice& paths, std::size_t views, const gpu::PermutationBudget& budget,
                             gpu::ImageDone onLastRead)
    : SceneRenderer(WithoutLight{}, context, prepared, settings, paths, views, budget, std::move(onLastRead)) {
  makeRenderers();
}

SceneRenderer::SceneRenderer(Context& context, PreparedScene& prepared, const scenes::Camera& firstView,
                             const PathChoice& paths, std::size_t views, const gpu::PermutationBudget& budget,
                             gpu::ImageDone onLastRead)
    : SceneRenderer(WithoutLight{}, context, prepared, prepared.settings, paths, views, budget, std::move(onLastRead)) {
  if (!isLightReady(prepared) && partsOf(m_settings) == 1) compileAhead(firstView);
  finishLight(prepared);
  makeRenderers();
}

void SceneRenderer::makeRenderers() {
  assert(!m_prepared.pendingEnvironments.isValid() && "finishLight comes first");
  for (std::size_t i = 0; i < m_choice.chosen.size(); ++i) {
    SceneOnDevice::RendererWish wish{.terms = m_shadesTerms, .intermediate = m_choice.intermediate};
    if (!m_plans.empty()) wish.plan = m_plans[i];
    PathState& state = m_paths.emplace_back();
    state.path = m_choice.chosen[i];
    state.plain = makeRenderer(*m_choice.chosen[i], wish, m_views);
  }
  for (std::size_t i = 1; i < m_paths.size(); ++i) // those that are compared with the first
    if (m_scene.hasOwnTextures(*m_paths[i].path, m_settings.options))
      m_paths[i].ofOriginals = makeRenderer(
          *m_paths[i].path, {.terms = m_shadesTerms, .originalTextures = true, .plan = m_paths[i].plain->pass().plan()},
          m_views);
  if (m_choice.compares())
    for (const WhatIfPreset& each : m_settings.whatIfs) {
      const paths::Path& path = pathByName(each.path);
      PathState& state = m_whatIfs.emplace_back();
      state.path = &path;
      state.plain = makeRenderer(path, each.options, {}, m_views);
    }
  if (m_choice.truth) {
    m_truth.emplace(m_context, m_prepared, m_settings, m_scene.buffers(), m_scene.surfacePass().binKinds(),
                    pixelsOf(m_settings, m_views), gpu::Compilation{m_budget, &m_context.pipelines()});
    if (tracesScene(m_prepared)) m_work.occluderMeshes = m_prepared.scene.meshes.size();
  }
}

bool SceneRenderer::mayDropLights() const {
  if (m_settings.droppedLights == 0 || !m_choice.compares() || !m_prepared.isLit) return false;
  // Only of those that are compared, and where the first can leave a light out.
  if (!m_choice.chosen.front()->leavesOutLights()) return false;
  return std::any_of(m_choice.chosen.begin() + 1, m_choice.chosen.end(), [&](const paths::Path* path) {
    return path->mayDropLights(lightOf(m_prepared, *path).lights, m_settings.options);
  });
}

bool SceneRenderer::mayDropLobes() const {
  if (m_settings.droppedLights == 0 || !m_choice.compares() || !m_prepared.scene.hasLobes()) return false;
  if (!m_choice.chosen.front()->hidesLobes()) return false;
  return std::any_of(m_choice.chosen.begin() + 1, m_choice.chosen.end(), [&](const paths::Path* path) {
    return std::ranges::any_of(m_prepared.scene.materials, [&](const scenes::Material& material) {
      return path->droppedLobes(material, m_settings.options) != 0;
    });
  });
}

std::unique_ptr<paths::Renderer> SceneRenderer::makeRenderer(const paths::Path& path, SceneOnDevice::RendererWish wish,
                                                             std::size_t views) {
  return makeRenderer(path, m_settings.options, wish, views);
}

std::unique_ptr<paths::Renderer> SceneRenderer::makeRenderer(const paths::Path& path, const paths::Options& options,
                                                             SceneOnDevice::RendererWish wish, std::size_t views) {
  wish.expectedPixels = pixelsOf(m_settings, views);
  wish.budget = m_budget;
  return m_scene.makeRenderer(path, options, wish);
}

gpu::VisibleLayers SceneRenderer::rasterise(const scenes::Camera& camera, const gpu::Tile& tile,
                                            const glm::vec2& sample) {
  const base::Stopwatch watch(&m_context.timings(), "surface");
  return m_scene.surfacePass().rasterise(camera, tile, sample);
}

SceneRenderer::Layers SceneRenderer::layersOf(const gpu::VisibleLayers& visible) {
  Layers layers;
  for (const gpu::VisibleLayers::Layer& layer : visible.layers) layers.push_back(layer.bins);
  return layers;
}

gpu::Surface SceneRenderer::resolve(const gpu::VisibleLayers& visible, std::size_t layer,
                                    const scenes::Camera& camera) {
  const base::Stopwatch watch(&m_context.timings(), "surface");
  return m_scene.surfacePass().resolve(visible, layer, camera);
}

void SceneRenderer::countSurface(const gpu::Surface& surface, Work& work) const {
  (surface.blended ? work.blendedSamples : work.surfaceSamples) += surface.size();
  if ((m_scene.buffers().vertexData() & gpu::kVertexFog) != 0) work.fogSamples += surface.size();
}

ViewFrames SceneRenderer::render(const scenes::Camera& camera, const Progress& progress) {
  const Settings& settings = m_settings;
  std::vector<ViewBuilder::PathPlan> plans;
  for (const PathState& each : m_paths) {
    ViewBuilder::PathPlan& plan = plans.emplace_back();
    plan.ofOriginals = each.ofOriginals != nullptr;
    if (m_choice.intermediate == 0) // others are looked at as they were computed
      plan.target = each.path->target(settings.options, m_context.device().report(), settings.exposureEv);
  }
  for (std::size_t i = 0; i < m_whatIfs.size(); ++i)
    plans.push_back({.target = m_whatIfs[i].path->target(settings.whatIfs[i].options, m_context.device().report(),
                                                         settings.exposureEv),
                     .isWhatIf = true});
  ViewBuilder view(settings, plans, m_truth.has_value(), m_scene.buffers());
  std::set<std::uint32_t> cutPixels;
  m_kept.clear();
  renderBackdrops(camera);
  m_seenSamples.assign(m_mayDropLights ? m_prepared.scene.instances.size() : 0, 0);

  const std::vector<gpu::Tile> tiles =
      gpu::makeTiles(static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height));
  const std::size_t parts = partsOf(settings);
  std::size_t part = 0;
  for (const gpu::Tile& tile : tiles)
    for (const glm::vec2& sample : gpu::samplePositions(settings.samples, settings.filterWidth)) {
      m_context.requireGoesOn();
      const gpu::VisibleLayers visible = rasterise(camera, tile, sample);
      cutPixels.insert(visible.cutPixels.begin(), visible.cutPixels.end());
      m_scene.requireTextures(visible);
      const Layers layers = layersOf(visible);
      for (const std::vector<PathState>* states : {&m_paths, &m_whatIfs})
        for (const PathState& each : *states) each.plain->pass().expect(layers);
      const bool keeps =
          parts == 1 && (m_mayAddTerms || m_mayDropLights || m_mayDropLobes) && visible.size() <= kMaxKeptEntries;
      const std::size_t layerCount = visible.layers.size();
      view.begin(tile, layerCount);
      // From the back to the front, as hardware blends; one layer's surface at a time.
      for (std::size_t k = 0; k < layerCount; ++k) {
        gpu::Surface surface = resolve(visible, k, camera);
        if (m_mayDropLights)
          for (const std::uint32_t instance : surface.instances) ++m_seenSamples[instance];
        // Apart from each other, and the nearest layer's the same however many lie behind.
        const std::size_t fromFront = layerCount - 1 - k, stream = 2 * part + (k == 0 ? 0 : 1 + 2 * parts * fromFront);
        const auto told = [&](double done) {
          m_context.requireGoesOn();
          const double share = (static_cast<double>(k) + done) / static_cast<double>(layerCount);
          if (progress) progress("truth", (static_cast<double>(part) + share) / static_cast<double>(parts));
        };
        std::vector<gpu::ShadedSurface> shaded = shade(surface, camera, static_cast<std::uint32_t>(stream), told, view);
        if (!m_mayAddTerms || !m_shadesTerms) shaded.clear();
        if (keeps) m_kept.push_back({std::move(surface), std::move(shaded)});
      }
      const base::Stopwatch watch(&m_context.timings(), "compose");
      view.end();
      ++part;
    }
  m_cutPixels += cutPixels.size();
  m_work.integratedSamples += view.sampledPoints();
  if (m_truth && progress) progress("truth", 1);
  return view.take();
}

void SceneRenderer::renderBackdrops(const scenes::Camera& camera) {
  if (m_choice.intermediate != 0) return; // light behind is no intermediate
  const auto width = static_cast<std::uint32_t>(m_settings.width),
             height = static_cast<std::uint32_t>(m_settings.height);
  std::vector<PathState*> reading;
  std::vector<gpu::BackdropBuilder> builders;
  for (std::vector<PathState>* states : {&m_paths, &m_whatIfs})
    for (PathState& each : *states)
      if (each.plain->readsBackdrop()) {
        reading.push_back(&each);
        builders.emplace_back(width, height, m_settings.samples);
      }
  if (reading.empty()) return;
  const base::Stopwatch watch(&m_context.timings(), "backdrop");
  for (const gpu::Tile& tile : gpu::makeTiles(width, height))
    for (const glm::vec2& sample : gpu::samplePositions(m_settings.samples, m_settings.filterWidth)) {
      m_context.requireGoesOn();
      const gpu::VisibleLayers visible = m_scene.surfacePass().rasteriseBehind(camera, tile, sample);
      m_scene.requireTextures(visible);
      if (m_firstLayers.empty()) {
        m_firstLayers = layersOf(m_scene.surfacePass().rasterise(camera, tile, sample));
        m_firstLayers.push_back(visible.layers.front().bins);
      }
      for (const PathState* each : reading) each->plain->pass().expect(m_firstLayers);
      const gpu::Surface surface = m_scene.surfacePass().resolve(visible, 0, camera);
      m_work.backdropSamples += surface.size();
      for (std::size_t i = 0; i < reading.size(); ++i)
        builders[i].lay(surface, camera, reading[i]->plain->shade(surface, camera).color);
    }
  for (std::size_t i = 0; i < reading.size(); ++i) {
    reading[i]->backdrop.emplace(builders[i].take(m_context.device()));
    reading[i]->giveBackdrop(*reading[i]->plain);
    if (reading[i]->ofOriginals) reading[i]->giveBackdrop(*reading[i]->ofOriginals);
  }
}

std::vector<gpu::ShadedSurface> SceneRenderer::shade(const gpu::Surface& surface, const scenes::Camera& camera,
                                                     std::uint32_t stream, const reference::Progress& progress,
                                                     ViewBuilder& view) {
  countSurface(surface, m_work);
  const auto begin = [&](const std::string& stage) {
    if (m_settings.terms) m_work.termSamples += surface.size();
    return base::Stopwatch(&m_context.timings(), stage);
  };
  std::vector<ShadedByPath> shaded;
  for (const PathState& each : m_paths) {
    const base::Stopwatch watch = begin("shade " + each.path->name());
    ShadedByPath& by = shaded.emplace_back(each.plain->shade(surface, camera), std::nullopt);
    if (each.ofOriginals) by.ofOriginals = each.ofOriginals->shade(surface, camera);
  }
  for (const PathState& each : m_whatIfs) {
    const base::Stopwatch watch(&m_context.timings(), "shade what-ifs");
    shaded.push_back({each.plain->shade(surface, camera), std::nullopt});
    m_work.whatIfSamples += surface.size();
  }
  std::optional<ReferenceSurface> truth;
  if (m_truth) {
    const base::Stopwatch watch = begin("shade truth");
    truth = m_truth->shade(surface, camera, stream, progress);
    m_work.resolvedSamples += surface.size();
  }
  const base::Stopwatch watch(&m_context.timings(), "compose");
  view.lay(surface, shaded, truth ? &*truth : nullptr);
  std::vector<gpu::ShadedSurface> ofPaths;
  for (std::size_t i = 0; i < m_paths.size(); ++i) ofPaths.push_back(std::move(shaded[i].shaded));
  return ofPaths;
}

} // namespace parity::job
