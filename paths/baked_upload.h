// Pages and captures of baked light as the device takes them.
#pragma once

#include <vector>

#include "gpu/surface/baked_maps.h"
#include "lighting/baked_light.h"

namespace parity::paths {

// Pages as one array of layers, tight.
template <typename T> std::vector<T> layersOf(const std::vector<base::BasicImage<T>>& pages) {
  std::vector<T> texels;
  for (const auto& page : pages) texels.insert(texels.end(), page.pixels.begin(), page.pixels.end());
  return texels;
}

// texels: layersOf the pages, which must outlive what is returned.
template <typename T> gpu::BakedPages pagesOf(vk::Format format, const std::vector<base::BasicImage<T>>& pages,
                                              const std::vector<T>& texels) {
  if (pages.empty()) return {};
  return {.format = format,
          .width = static_cast<std::uint32_t>(pages.front().width),
          .height = static_cast<std::uint32_t>(pages.front().height),
          .count = static_cast<std::uint32_t>(pages.size()),
          .texels = std::as_bytes(std::span(texels))};
}

// isNormalised: whether reflections follow the lightmap.
std::vector<gpu::GpuCapture> capturesOf(const lighting::BakedLight& baked, bool isNormalised);

} // namespace parity::paths
