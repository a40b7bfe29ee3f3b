#include "gpu/surface/backdrop.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <vector>

namespace parity::gpu {

namespace {

// Each texel the mean of four; of an odd last row or column, which has no pair, of fewer.
base::Image halve(const base::Image& fine) {
  const int width = std::max(fine.width / 2, 1), height = std::max(fine.height / 2, 1);
  base::Image coarse(width, height, fine.channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      // The last one takes what is over.
      const int right = x == width - 1 ? fine.width : 2 * x + 2, below = y == height - 1 ? fine.height : 2 * y + 2;
      const float weight = 1.f / static_cast<float>((right - 2 * x) * (below - 2 * y));
      for (int v = 2 * y; v < below; ++v)
        for (int u = 2 * x; u < right; ++u)
          for (int c = 0; c < fine.channels; ++c) coarse.at(x, y)[c] += weight * fine.at(u, v)[c];
    }
  return coarse;
}

} // namespace

BackdropBuilder::BackdropBuilder(std::uint32_t width, std::uint32_t height, int samples)
    : m_weight(1.f / static_cast<float>(samples)), m_color(static_cast<int>(width), static_cast<int>(height), 4),
      m_depth(static_cast<int>(width), static_cast<int>(height), 1) {}

void BackdropBuilder::lay(const Surface& surface, const scenes::Camera& camera, const ShadedPlane& color) {
  if (surface.size() == 0) return;
  const std::vector<glm::uvec4> positions = surface.position.downloadAs<glm::uvec4>(surface.size());
  const glm::vec3 forward = -glm::vec3(camera.toWorld[2]), eye(camera.toWorld[3]);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const glm::vec3 position(std::bit_cast<float>(positions[i].x), std::bit_cast<float>(positions[i].y),
                             std::bit_cast<float>(positions[i].z));
    float* texel = m_color.pixels.data() + std::size_t{4} * surface.pixels[i];
    for (int c = 0; c < 3; ++c)
      if (std::isfinite(color[i][c])) texel[c] += m_weight * color[i][c];
    texel[3] += m_weight;
    m_depth.pixels[surface.pixels[i]] += m_weight * glm::dot(forward, position - eye);
  }
}

Backdrop BackdropBuilder::take(const Device& device) {
  std::vector<std::vector<float>> texels;
  base::Image color = std::move(m_color), depth = std::move(m_depth);
  const DeviceImage::Shape shape{
      .format = kBackdropFormat,
      .width = static_cast<std::uint32_t>(color.width),
      .height = static_cast<std::uint32_t>(color.height),
      .mips = static_cast<std::uint32_t>(std::bit_width(static_cast<unsigned>(std::max(color.width, color.height)))),
      .array = true,
      .arraySize = kBackdropLayers};
  for (std::uint32_t mip = 0; mip < shape.mips; ++mip) {
    if (mip > 0) {
      color = halve(color);
      depth = halve(depth);
    }
    std::vector<float>& both = texels.emplace_back(color.pixels);
    for (const float value : depth.pixels) both.insert(both.end(), {value, 0.f, 0.f, 0.f});
  }
  std::vector<std::span<const std::byte>> mips;
  for (const std::vector<float>& mip : texels) mips.push_back(std::as_bytes(std::span{mip}));
  return Backdrop(DeviceImage(device, shape, mips));
}

} // namespace parity::gpu
