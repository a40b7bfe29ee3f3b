#include "sweep/surfaces.h"

#include "scenes/view.h"

namespace parity::sweep {

Surfaces::Surfaces(job::Context& context, const job::PreparedScene& prepared, const scenes::ViewRequest& view)
    : m_settings(context.settings()), m_buffers(context.device(), prepared.scene, m_settings.specularAa),
      m_pass(context.device(), m_buffers, static_cast<std::uint32_t>(m_settings.width),
             static_cast<std::uint32_t>(m_settings.height)),
      m_camera(scenes::makeCamera(prepared.scene, view, static_cast<float>(m_settings.width) / m_settings.height)) {
  for (const gpu::Tile& tile :
       gpu::makeTiles(static_cast<std::uint32_t>(m_settings.width), static_cast<std::uint32_t>(m_settings.height)))
    for (const glm::vec2& sample : gpu::samplePositions(m_settings.samples)) {
      Part& part = m_parts.emplace_back();
      part.tile = tile;
      part.opaque = m_pass.render(m_camera, tile, sample, gpu::Layer::opaque);
      if (m_pass.hasBlended()) part.blended = m_pass.render(m_camera, tile, sample, gpu::Layer::blended);
    }
}

void Surfaces::rasteriseAgain() const {
  const auto samples = gpu::samplePositions(m_settings.samples);
  for (std::size_t i = 0; i < m_parts.size(); ++i) {
    m_pass.render(m_camera, m_parts[i].tile, samples[i % samples.size()], gpu::Layer::opaque);
    if (m_pass.hasBlended()) m_pass.render(m_camera, m_parts[i].tile, samples[i % samples.size()], gpu::Layer::blended);
  }
}

std::uint64_t Surfaces::size() const {
  std::uint64_t entries = 0;
  for (const Part& part : m_parts) entries += part.opaque.size() + (part.blended ? part.blended->size() : 0);
  return entries;
}

base::Image Surfaces::compose(const std::vector<Shaded>& shaded, const std::optional<gpu::TargetCodec>& target) const {
  gpu::FrameBuilder frame(static_cast<std::uint32_t>(m_settings.width), static_cast<std::uint32_t>(m_settings.height),
                          m_settings.samples, false, m_settings.background, target);
  for (std::size_t i = 0; i < m_parts.size(); ++i)
    frame.add(m_parts[i].opaque, shaded[i].opaque, m_parts[i].blended ? &*m_parts[i].blended : nullptr,
              shaded[i].blended ? &*shaded[i].blended : nullptr, m_parts[i].tile);
  return frame.take().color;
}

std::vector<base::PixelList> Surfaces::coverage(const std::vector<Shaded>& shaded) const {
  gpu::CoverageBuilder coverage(m_buffers, m_settings.samples);
  for (std::size_t i = 0; i < m_parts.size(); ++i)
    coverage.add(m_parts[i].opaque, m_parts[i].blended ? &*m_parts[i].blended : nullptr,
                 shaded[i].blended ? &*shaded[i].blended : nullptr, m_parts[i].tile);
  return coverage.take();
}

} // namespace parity::sweep
