#include "job/view/view_surfaces.h"

namespace parity::job {

ViewSurfaces::ViewSurfaces(const SceneOnDevice& scene, const Settings& settings, const scenes::Camera& camera)
    : m_scene(scene), m_settings(settings), m_camera(camera) {
  for (const gpu::Tile& tile :
       gpu::makeTiles(static_cast<std::uint32_t>(m_settings.width), static_cast<std::uint32_t>(m_settings.height)))
    for (const glm::vec2& sample : gpu::samplePositions(m_settings.samples, m_settings.filterWidth))
      m_parts.push_back({tile, m_scene.surfacePass().render(m_camera, tile, sample)});
}

std::vector<ViewSurfaces::Shaded> ViewSurfaces::shade(const paths::Renderer& renderer) const {
  std::vector<Shaded> all;
  for (const Part& part : m_parts) {
    Shaded& shaded = all.emplace_back();
    for (const gpu::Surface& layer : part.layers) shaded.push_back(renderer.shade(layer, m_camera));
  }
  return all;
}

void ViewSurfaces::rasteriseAgain() const {
  const auto samples = gpu::samplePositions(m_settings.samples, m_settings.filterWidth);
  for (std::size_t i = 0; i < m_parts.size(); ++i)
    m_scene.surfacePass().render(m_camera, m_parts[i].tile, samples[i % samples.size()]);
}

std::uint64_t ViewSurfaces::size() const {
  std::uint64_t entries = 0;
  for (const Part& part : m_parts)
    for (const gpu::Surface& layer : part.layers) entries += layer.size();
  return entries;
}

void ViewSurfaces::lay(std::size_t part, const Shaded& shaded, auto& builder) const {
  builder.begin(m_parts[part].tile);
  for (std::size_t k = 0; k < shaded.size(); ++k) builder.lay(m_parts[part].layers[k], shaded[k]);
  builder.end();
}

base::Image ViewSurfaces::compose(const std::vector<Shaded>& shaded,
                                  const std::optional<gpu::TargetCodec>& target) const {
  gpu::FrameBuilder frame(static_cast<std::uint32_t>(m_settings.width), static_cast<std::uint32_t>(m_settings.height),
                          m_settings.samples, 0, m_settings.background, target);
  for (std::size_t i = 0; i < m_parts.size(); ++i) lay(i, shaded[i], frame);
  return frame.take().color;
}

std::vector<base::PixelList> ViewSurfaces::coverage(const std::vector<Shaded>& shaded) const {
  gpu::CoverageBuilder coverage(m_scene.buffers(), m_settings.samples);
  for (std::size_t i = 0; i < m_parts.size(); ++i) lay(i, shaded[i], coverage);
  return coverage.take();
}

} // namespace parity::job
