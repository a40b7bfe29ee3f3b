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
    for (const glm::vec2& sample : gpu::samplePositions(m_settings.samples))
      m_parts.push_back({tile, m_pass.render(m_camera, tile, sample)});
}

void Surfaces::rasteriseAgain() const {
  const auto samples = gpu::samplePositions(m_settings.samples);
  for (std::size_t i = 0; i < m_parts.size(); ++i)
    m_pass.render(m_camera, m_parts[i].tile, samples[i % samples.size()]);
}

std::uint64_t Surfaces::size() const {
  std::uint64_t entries = 0;
  for (const Part& part : m_parts)
    for (const gpu::Surface& layer : part.layers) entries += layer.size();
  return entries;
}

void Surfaces::lay(std::size_t part, const Shaded& shaded, auto& builder) const {
  builder.begin(m_parts[part].tile);
  for (std::size_t k = 0; k < shaded.size(); ++k) builder.lay(m_parts[part].layers[k], shaded[k]);
  builder.end();
}

base::Image Surfaces::compose(const std::vector<Shaded>& shaded, const std::optional<gpu::TargetCodec>& target) const {
  gpu::FrameBuilder frame(static_cast<std::uint32_t>(m_settings.width), static_cast<std::uint32_t>(m_settings.height),
                          m_settings.samples, false, m_settings.background, target);
  for (std::size_t i = 0; i < m_parts.size(); ++i) lay(i, shaded[i], frame);
  return frame.take().color;
}

std::vector<base::PixelList> Surfaces::coverage(const std::vector<Shaded>& shaded) const {
  gpu::CoverageBuilder coverage(m_buffers, m_settings.samples);
  for (std::size_t i = 0; i < m_parts.size(); ++i) lay(i, shaded[i], coverage);
  return coverage.take();
}

} // namespace parity::sweep
