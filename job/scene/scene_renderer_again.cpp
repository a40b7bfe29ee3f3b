// Looks at the view that was rendered last once more: by its terms, without lights, without a lobe.
#include "job/scene/scene_renderer.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "job/view/term_variants.h"

namespace parity::job {

void SceneRenderer::addTerms(ViewFrames& frames, std::size_t path, const scenes::Camera& camera,
                             const std::vector<std::size_t>& materials, bool pictures) {
  const Settings& settings = m_settings;
  assert(path > 0 && !settings.terms);
  PathState &first = m_paths.front(), &other = m_paths[path];
  const auto shadeAgain = [&](PathState& by, const gpu::Surface& surface) {
    // For one view: whether there will be another is not known.
    if (!by.withTerms)
      by.withTerms =
          makeRenderer(*by.path, {.terms = true, .plan = m_shadesTerms ? by.plain->pass().plan() : nullptr}, 1);
    by.giveBackdrop(*by.withTerms);
    return by.withTerms->shade(surface, camera);
  };
  std::vector<gpu::FrameBuilder> builders; // of both paths' terms
  for (int i = 0; pictures && i < 2; ++i) builders.push_back(makeFrame(true));
  std::vector<char> wanted(m_prepared.scene.materials.size(), 0);
  for (const std::size_t material : materials) wanted[material] = 1;
  gpu::SwapBuilder variants(m_scene.buffers().materialOfInstance(), m_prepared.scene.materials.size(),
                            static_cast<std::uint32_t>(settings.width), settings.samples,
                            std::vector<glm::vec3>(1 + m_scene.buffers().termCount(), settings.background),
                            std::nullopt, std::move(wanted));
  const auto compose = [&](const gpu::Surface& surface, const gpu::ShadedSurface& a, const gpu::ShadedSurface& b) {
    for (std::size_t i = 0; i < builders.size(); ++i) builders[i].lay(surface, i == 0 ? a : b);
    variants.lay(surface, a, b, TermVariants(surface, a, b, variants).planes());
  };
  const auto lay = [&](const KeptLayer& layer) {
    const base::Stopwatch watch(&m_context.timings(), "shade terms");
    m_again.termSamples += 2 * layer.surface.size(); // that are looked at, whenever they were shaded
    if (!layer.shaded.empty()) return compose(layer.surface, layer.shaded.front(), layer.shaded[path]);
    const gpu::ShadedSurface a = shadeAgain(first, layer.surface), b = shadeAgain(other, layer.surface);
    compose(layer.surface, a, b);
  };
  const auto begin = [&](const gpu::Tile& tile) {
    for (gpu::FrameBuilder& builder : builders) builder.begin(tile);
    variants.begin(tile);
  };
  const auto end = [&] {
    for (gpu::FrameBuilder& builder : builders) builder.end();
    variants.end();
  };
  layAgain(camera, m_again, {begin, lay, end});
  for (std::size_t i = 0; i < builders.size(); ++i)
    frames.paths[i == 0 ? 0 : path].frame.terms = builders[i].take().terms;
  frames.paths[path].termVariants = variants.take(frames.coverage, {});
}

bool SceneRenderer::paysInTurn(std::size_t lights) const {
  const std::uint64_t samples = std::accumulate(m_seenSamples.begin(), m_seenSamples.end(), std::uint64_t{0});
  const std::size_t shaders = m_paths.front().plain->pass().compiled().size();
  return static_cast<double>(samples * (lights - 1)) * gpu::kShadingNsPerSample >
         static_cast<double>(shaders) * gpu::kPermutationCostMs * 1e6;
}

std::vector<base::Image> SceneRenderer::renderWithout(std::span<const std::size_t> lights,
                                                      const scenes::Camera& camera) {
  assert(m_mayDropLights && !lights.empty());
  PathState& first = m_paths.front();
  const std::shared_ptr<gpu::PermutationPlan> plan = first.plain->pass().plan();
  if (!first.inTurn && paysInTurn(lights.size())) {
    first.leftOut = std::min<std::size_t>(lights.size(), gpu::kMaxLeftOut);
    first.inTurn = makeRenderer(*first.path, {.leftOut = first.leftOut, .plan = plan}, m_views);
  }
  if (!first.inTurn && !first.leavingOut)
    first.leavingOut = makeRenderer(*first.path, {.terms = m_shadesTerms, .plan = plan}, m_views);
  paths::Renderer& renderer = first.inTurn ? *first.inTurn : *first.leavingOut;
  first.giveBackdrop(renderer);
  std::vector<base::Image> pictures;
  for (std::size_t begin = 0; begin < lights.size();) {
    const std::size_t count = first.inTurn ? std::min(first.leftOut, lights.size() - begin) : 1;
    renderer.leaveOut(lights.subspan(begin, count));
    begin += count;
    std::vector<gpu::FrameBuilder> frames(count, makeFrame(false));
    const auto lay = [&](const KeptLayer& layer) {
      const base::Stopwatch watch(&m_context.timings(), "shade without a light");
      gpu::ShadedSurface shaded = renderer.shade(layer.surface, camera);
      for (std::size_t k = 0; k < count; ++k) {
        if (first.inTurn) shaded.color = std::move(shaded.terms[k]);
        frames[k].lay(layer.surface, shaded);
      }
    };
    layAgain(camera, m_work,
             {[&](const gpu::Tile& tile) { std::ranges::for_each(frames, [&](auto& frame) { frame.begin(tile); }); },
              lay, [&] { std::ranges::for_each(frames, [](auto& frame) { frame.end(); }); }});
    for (gpu::FrameBuilder& frame : frames) pictures.push_back(frame.take().color);
    m_work.lightPictures += count;
  }
  return pictures;
}

base::Image SceneRenderer::renderWithoutLobes(std::uint32_t features, const scenes::Camera& camera) {
  PathState& first = m_paths.front();
  std::unique_ptr<paths::Renderer>& without = first.without[features];
  if (!without) without = makeRenderer(*first.path, {.hiddenFeatures = features}, m_views);
  first.giveBackdrop(*without);
  gpu::FrameBuilder frame = makeFrame(false);
  const auto lay = [&](const KeptLayer& layer) {
    const base::Stopwatch watch(&m_context.timings(), "shade without a lobe");
    frame.lay(layer.surface, without->shade(layer.surface, camera));
  };
  layAgain(camera, m_work, {[&](const gpu::Tile& tile) { frame.begin(tile); }, lay, [&] { frame.end(); }});
  ++m_work.lobePictures;
  return frame.take().color;
}

gpu::FrameBuilder SceneRenderer::makeFrame(bool terms) const {
  const Settings& settings = m_settings;
  return {static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height), settings.samples,
          terms ? m_scene.buffers().termCount() : 0, settings.background};
}

void SceneRenderer::layAgain(const scenes::Camera& camera, Work& work, const Composition& composition) {
  const Settings& settings = m_settings;
  for (const gpu::Tile& tile :
       gpu::makeTiles(static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height)))
    for (const glm::vec2& sample : gpu::samplePositions(settings.samples, settings.filterWidth)) {
      m_context.requireGoesOn();
      composition.begin(tile);
      if (!m_kept.empty()) {
        for (const KeptLayer& layer : m_kept) composition.lay(layer);
      } else {
        const gpu::VisibleLayers visible = rasterise(camera, tile, sample);
        for (std::size_t k = 0; k < visible.layers.size(); ++k) {
          const KeptLayer layer{resolve(visible, k, camera), {}};
          countSurface(layer.surface, work);
          composition.lay(layer);
        }
      }
      composition.end();
    }
}

} // namespace parity::job
