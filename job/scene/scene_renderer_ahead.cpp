// Compiles a scene's shaders while its environments are prepared.
#include "job/scene/scene_renderer.h"

#include <algorithm>
#include <optional>

#include "job/scene/stand_in_light.h"

namespace parity::job {

// In the order of render(), so that the plans become the same.
void SceneRenderer::compileAhead(const scenes::Camera& camera) {
  const base::Stopwatch watch(&m_context.timings(), "compile ahead");
  m_standIns.reserve(m_choice.chosen.size()); // renderers refer to them
  std::vector<std::unique_ptr<paths::Renderer>> renderers;
  for (const paths::Path* path : m_choice.chosen) {
    m_standIns.push_back(standInLight(lightOf(m_prepared, *path), path->lightNeeds(m_settings.options)));
    SceneOnDevice::RendererWish wish{.terms = m_shadesTerms, .intermediate = m_choice.intermediate};
    wish.light = &m_standIns.back();
    renderers.push_back(makeRenderer(*path, wish, m_views));
    m_plans.push_back(renderers.back()->pass().plan());
  }
  const auto expect = [&](const Layers& layers, const auto& isWanted) {
    for (const auto& renderer : renderers)
      if (isWanted(*renderer)) renderer->pass().expect(layers);
  };
  const auto compile = [&](const gpu::VisibleLayers& part, const auto& isWanted) {
    m_scene.requireTextures(part);
    expect(layersOf(part), isWanted);
    for (std::size_t k = 0; k < part.layers.size(); ++k) {
      const gpu::Surface surface = resolve(part, k, camera);
      for (const auto& renderer : renderers) {
        if (!isWanted(*renderer)) continue;
        m_context.requireGoesOn();
        renderer->pass().compile(surface, camera);
      }
    }
  };
  const gpu::Tile tile =
      gpu::makeTiles(static_cast<std::uint32_t>(m_settings.width), static_cast<std::uint32_t>(m_settings.height))
          .front();
  const glm::vec2 sample = gpu::samplePositions(m_settings.samples, m_settings.filterWidth).front();
  const gpu::VisibleLayers visible = rasterise(camera, tile, sample);
  const auto readsBackdrop = [](const paths::Renderer& renderer) { return renderer.readsBackdrop(); };
  std::optional<gpu::Backdrop> backdrop; // of the kind of the one to come
  if (m_choice.intermediate == 0 &&
      std::ranges::any_of(renderers, [&](const auto& each) { return readsBackdrop(*each); })) {
    const gpu::VisibleLayers behind = m_scene.surfacePass().rasteriseBehind(camera, tile, sample);
    m_firstLayers = layersOf(visible);
    m_firstLayers.push_back(behind.layers.front().bins);
    expect(m_firstLayers, readsBackdrop);
    compile(behind, readsBackdrop);
    gpu::BackdropBuilder builder(static_cast<std::uint32_t>(m_settings.width),
                                 static_cast<std::uint32_t>(m_settings.height), m_settings.samples);
    backdrop.emplace(builder.take(m_context.device()));
    for (const auto& renderer : renderers)
      if (readsBackdrop(*renderer)) renderer->setBackdrop(&*backdrop);
  }
  compile(visible, [](const paths::Renderer&) { return true; });
}

} // namespace parity::job
