#include "job/view/view_surfaces.h"

namespace parity::job {

ViewSurfaces::ViewSurfaces(const gpu::Device& device, const SceneOnDevice& scene, const Settings& settings,
                           const scenes::Camera& camera)
    : m_device(device), m_scene(scene), m_settings(settings), m_camera(camera) {
  for (const gpu::Tile& tile :
       gpu::makeTiles(static_cast<std::uint32_t>(m_settings.width), static_cast<std::uint32_t>(m_settings.height)))
    for (const glm::vec2& sample : gpu::samplePositions(m_settings.samples, m_settings.filterWidth))
      m_parts.push_back({tile, m_scene.surfacePass().render(m_camera, tile, sample)});
}

gpu::Backdrop ViewSurfaces::backdropOf(const paths::Renderer& renderer) const {
  if (m_behind.empty()) {
    const auto samples = gpu::samplePositions(m_settings.samples, m_settings.filterWidth);
    for (std::size_t i = 0; i < m_parts.size(); ++i) {
      const gpu::VisibleLayers visible =
          m_scene.surfacePass().rasteriseBehind(m_camera, m_parts[i].tile, samples[i % samples.size()]);
      m_behind.push_back(m_scene.surfacePass().resolve(visible, 0, m_camera));
    }
  }
  gpu::BackdropBuilder builder(static_cast<std::uint32_t>(m_settings.width),
                               static_cast<std::uint32_t>(m_settings.height), m_settings.samples);
  for (const gpu::Surface& surface : m_behind) builder.lay(surface, m_camera, renderer.shade(surface, m_camera).color);
  return builder.take(m_device);
}

std::vector<ViewSurfaces::Shaded> ViewSurfaces::shade(paths::Renderer& renderer) const {
  std::optional<gpu::Backdrop> behind;
  if (renderer.readsBackdrop()) renderer.setBackdrop(&behind.emplace(backdropOf(renderer)));
  std::vector<Shaded> all;
  for (const Part& part : m_parts) {
    Shaded& shaded = all.emplace_back();
    for (const gpu::Surface& layer : part.layers) shaded.push_back(renderer.shade(layer, m_camera));
  }
  renderer.setBackdrop(nullptr);
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
                          m_settings.samples, {}, m_settings.background, target);
  for (std::size_t i = 0; i < m_parts.size(); ++i) lay(i, shaded[i], frame);
  return frame.take().color;
}

std::vector<base::PixelList> ViewSurfaces::coverage(const std::vector<Shaded>& shaded) const {
  gpu::CoverageBuilder coverage(m_scene.buffers(), m_settings.samples);
  for (std::size_t i = 0; i < m_parts.size(); ++i) lay(i, shaded[i], coverage);
  return coverage.take();
}

std::vector<gpu::SwappedPixels> ViewSurfaces::swap(const std::vector<Shaded>& first, const std::vector<Shaded>& second,
                                                   const std::optional<gpu::TargetCodec>& target,
                                                   const base::Image& picture,
                                                   const std::vector<base::PixelList>& coverage) const {
  gpu::SwapBuilder builder(m_scene.buffers().materialOfInstance(), coverage.size(),
                           static_cast<std::uint32_t>(m_settings.width), m_settings.samples, {m_settings.background},
                           target);
  for (std::size_t i = 0; i < m_parts.size(); ++i) {
    builder.begin(m_parts[i].tile, m_parts[i].layers.size());
    for (std::size_t k = 0; k < first[i].size(); ++k)
      builder.lay(m_parts[i].layers[k], first[i][k], second[i][k],
                  std::array{gpu::SwapPlane{first[i][k].color, second[i][k].color}});
    builder.end();
  }
  return builder.take(coverage, std::array{&picture});
}

} // namespace parity::job
