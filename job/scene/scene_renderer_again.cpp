// Looks at the view that was rendered last once more: by its terms, without lights, without a lobe.
#include "job/scene/scene_renderer.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "gpu/surface/other_terms.h"
#include "job/view/term_variants.h"

namespace parity::job {

void SceneRenderer::addTerms(ViewFrames& frames, std::size_t path, const scenes::Camera& camera,
                             const std::vector<std::size_t>& materials) {
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
  // What is 0 in both paths takes no picture. What is shaded only now may hold any term.
  const bool areKept = keepsTerms();
  std::vector<char> used(m_scene.buffers().termCount(), areKept ? 0 : 1);
  if (areKept)
    for (const KeptLayer& layer : m_kept) markUsedTerms(layer.shaded.front(), layer.shaded[path], used);
  const std::vector<std::size_t> terms = placesOf(used);
  const auto makeTerms = [&] {
    return gpu::FrameBuilder::ofTerms(static_cast<std::uint32_t>(settings.width),
                                      static_cast<std::uint32_t>(settings.height), settings.samples, used);
  };
  gpu::FrameBuilder firstTerms = makeTerms(), otherTerms = makeTerms();
  std::vector<char> wanted(m_prepared.scene.materials.size(), 0);
  for (const std::size_t material : materials) wanted[material] = 1;
  gpu::SwapBuilder variants(m_scene.buffers().materialOfInstance(), m_prepared.scene.materials.size(),
                            static_cast<std::uint32_t>(settings.width), settings.samples,
                            std::vector<glm::vec3>(1 + terms.size(), settings.background), std::nullopt,
                            std::move(wanted));
  const auto compose = [&](const gpu::Surface& surface, const gpu::ShadedSurface& a, const gpu::ShadedSurface& b) {
    firstTerms.lay(surface, a);
    otherTerms.lay(surface, b);
    variants.lay(surface, a, b, TermVariants(surface, a, b, terms, variants).planes());
  };
  const auto lay = [&](const KeptLayer& layer) {
    const base::Stopwatch watch(&m_context.timings(), "shade terms");
    m_again.termSamples += 2 * layer.surface.size(); // that are looked at, whenever they were shaded
    if (!layer.shaded.empty()) return compose(layer.surface, layer.shaded.front(), layer.shaded[path]);
    const gpu::ShadedSurface a = shadeAgain(first, layer.surface), b = shadeAgain(other, layer.surface);
    compose(layer.surface, a, b);
  };
  layAgain(camera, m_again,
           {[&](const gpu::Tile& tile, std::size_t layers) {
              firstTerms.begin(tile), otherTerms.begin(tile), variants.begin(tile, layers);
            },
            lay, [&] { firstTerms.end(), otherTerms.end(), variants.end(); }});
  frames.paths.front().frame.terms = firstTerms.take().terms;
  frames.paths[path].frame.terms = otherTerms.take().terms;
  frames.paths[path].termVariants = variants.take(frames.coverage, {});
  frames.paths[path].variantTerms = terms;
}

// By this view alone: what it reports depends on no other.
bool SceneRenderer::paysAtOnce(std::size_t lights) const {
  if (m_context.deviceReport().kind != "cpu") return false; // shading takes less than compiling
  std::uint64_t samples = 0;
  std::set<gpu::MaterialClass> classes;
  for (std::size_t i = 0; i < m_seenSamples.size(); ++i) {
    if (m_seenSamples[i] == 0) continue;
    samples += m_seenSamples[i];
    const std::size_t mesh = m_prepared.scene.instances[i].mesh;
    classes.insert(m_scene.buffers().classOfMaterial()[m_prepared.scene.meshes[mesh].material]);
  }
  const std::size_t shaders = std::min(classes.size(), gpu::kMaxPermutations);
  return static_cast<double>(samples * (lights - 1)) * gpu::kShadingNsPerSample >
         static_cast<double>(shaders) * gpu::kPermutationCostMs * 1e6;
}

bool SceneRenderer::keepsTerms() const {
  return !m_kept.empty() && std::ranges::none_of(m_kept, [](const KeptLayer& layer) { return layer.shaded.empty(); });
}

SceneRenderer::Without SceneRenderer::rendererWithout(std::size_t lights) {
  assert(lights > 0);
  PathState& first = m_paths.front();
  const bool hasFog = (m_scene.buffers().vertexData() & gpu::kVertexFog) != 0;
  const bool atOnce = paysAtOnce(lights),
             lightsAlone = atOnce && keepsTerms() && !hasFog && !m_scene.buffers().hasLobes();
  std::unique_ptr<paths::Renderer>& renderer = lightsAlone ? first.lightsAlone
                                               : atOnce    ? first.withoutSome
                                                           : first.withoutOne;
  const std::size_t most =
      atOnce ? std::min<std::size_t>(static_cast<std::size_t>(m_settings.droppedLights), gpu::kMaxLeftOut) : 1;
  if (!renderer)
    renderer = makeRenderer(*first.path,
                            {.leftOut = atOnce ? most : 0,
                             .lightsAlone = lightsAlone,
                             .plan = first.plain->pass().plan(),
                             .planWritesTerms = m_shadesTerms && !atOnce},
                            m_views);
  first.giveBackdrop(*renderer);
  return {*renderer, most, lightsAlone};
}

void SceneRenderer::compileWithout(std::size_t lights, const scenes::Camera& camera) {
  if (m_kept.empty() || !paysAtOnce(lights)) return; // one by one: by the shaders of the picture with all lights
  const paths::Renderer& renderer = rendererWithout(lights).renderer;
  for (const KeptLayer& layer : m_kept) renderer.pass().compile(layer.surface, camera);
}

void SceneRenderer::renderWithout(std::span<const std::size_t> lights, const scenes::Camera& camera,
                                  const std::function<void(std::size_t, const base::Image&)>& take) {
  assert(m_mayDropLights && !lights.empty());
  const Without without = rendererWithout(lights.size());
  const std::size_t most = without.most;
  const bool atOnce = most > 1; // paysAtOnce is false for one light
  for (std::size_t begin = 0; begin < lights.size(); begin += most) {
    const std::size_t count = std::min(most, lights.size() - begin);
    without.renderer.leaveOut(lights.subspan(begin, count));
    std::vector<gpu::FrameBuilder> frames;
    for (std::size_t k = 0; k < count; ++k) frames.push_back(makeFrame());
    const auto lay = [&](const KeptLayer& layer) {
      const base::Stopwatch watch(&m_context.timings(), "shade without a light");
      gpu::ShadedSurface shaded = without.renderer.shade(layer.surface, camera);
      std::vector<const gpu::ShadedPlane*> others;
      if (without.lightsAlone) others = gpu::otherTerms(layer.shaded.front().terms);
      for (std::size_t k = 0; k < count; ++k) {
        if (atOnce) shaded.color = std::move(shaded.terms[k]);
        if (without.lightsAlone) {
          const base::Stopwatch adding(&m_context.timings(), "add terms of no light");
          shaded.color = gpu::withOtherTerms(shaded.color, others);
        }
        frames[k].lay(layer.surface, shaded);
      }
    };
    layAgain(camera, m_work,
             {[&](const gpu::Tile& tile, std::size_t) {
                std::ranges::for_each(frames, [&](auto& frame) { frame.begin(tile); });
              },
              lay, [&] { std::ranges::for_each(frames, [](auto& frame) { frame.end(); }); }});
    m_work.lightPictures += count;
    for (std::size_t k = 0; k < count; ++k) take(begin + k, frames[k].take().color);
  }
}

base::Image SceneRenderer::renderWithoutLobes(std::uint32_t features, const scenes::Camera& camera) {
  PathState& first = m_paths.front();
  std::unique_ptr<paths::Renderer>& without = first.without[features];
  if (!without)
    without = makeRenderer(
        *first.path, {.hiddenFeatures = features, .plan = first.plain->pass().plan(), .planWritesTerms = m_shadesTerms},
        m_views);
  first.giveBackdrop(*without);
  gpu::FrameBuilder frame = makeFrame();
  const auto lay = [&](const KeptLayer& layer) {
    const base::Stopwatch watch(&m_context.timings(), "shade without a lobe");
    frame.lay(layer.surface, without->shade(layer.surface, camera));
  };
  layAgain(camera, m_work, {[&](const gpu::Tile& tile, std::size_t) { frame.begin(tile); }, lay, [&] { frame.end(); }});
  ++m_work.lobePictures;
  return frame.take().color;
}

gpu::FrameBuilder SceneRenderer::makeFrame() const {
  const Settings& settings = m_settings;
  return {static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height), settings.samples,
          std::vector<char>(), settings.background};
}

void SceneRenderer::layAgain(const scenes::Camera& camera, Work& work, const Composition& composition) {
  const Settings& settings = m_settings;
  for (const gpu::Tile& tile :
       gpu::makeTiles(static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height)))
    for (const glm::vec2& sample : gpu::samplePositions(settings.samples, settings.filterWidth)) {
      m_context.requireGoesOn();
      if (!m_kept.empty()) {
        composition.begin(tile, m_kept.size());
        for (const KeptLayer& layer : m_kept) composition.lay(layer);
      } else {
        const gpu::VisibleLayers visible = rasterise(camera, tile, sample);
        composition.begin(tile, visible.layers.size());
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
