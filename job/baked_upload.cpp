#include "job/baked_upload.h"

#include <vector>

#include "job/environment_upload.h"

namespace parity::job {

namespace {

// Pages as one array of layers, tight.
template <typename T> std::vector<T> layersOf(const std::vector<base::BasicImage<T>>& pages) {
  std::vector<T> texels;
  for (const auto& page : pages) texels.insert(texels.end(), page.pixels.begin(), page.pixels.end());
  return texels;
}

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
std::vector<gpu::GpuCapture> capturesOf(const bake::BakedLight& baked, bool isNormalised) {
  std::vector<gpu::GpuCapture> captures;
  for (const bake::Capture& c : baked.captures)
    captures.push_back({glm::vec4(c.position, c.radius),
                        glm::vec4(c.boxLower, isNormalised ? c.averageBrightness() : 0.f), glm::vec4(c.boxUpper, 0)});
  return captures;
}

std::vector<const lighting::CubeMap*> cubesOf(const bake::BakedLight& baked) {
  std::vector<const lighting::CubeMap*> cubes;
  for (const bake::Capture& c : baked.captures) cubes.push_back(&c.light->prefiltered);
  return cubes;
}

} // namespace

// The captures show the direct light of stationary lights, which the high-end lightmap lacks: no measure for each
// other.
gpu::BakedMaps uploadHighendBaked(const gpu::Device& device, const bake::BakedLight& baked) {
  const std::vector<std::uint16_t> lightmap = layersOf(baked.highend);
  const std::vector<std::uint8_t> sun = layersOf(baked.sunMask);
  const std::vector<gpu::GpuCapture> captures = capturesOf(baked, baked.localLights == bake::LocalLights::isStatic);
  return gpu::makeBakedMaps(device, {.lightmap = pagesOf(vk::Format::eR16G16B16A16Sfloat, baked.highend, lightmap),
                                     .sunShadow = pagesOf(vk::Format::eR8Unorm, baked.sunMask, sun),
                                     .transitionScale = 1,
                                     .scales = {},
                                     .captures = captures});
}

gpu::BakedMaps uploadMobileBaked(const gpu::Device& device, const bake::BakedLight& baked) {
  const std::vector<std::uint8_t> lightmap = layersOf(baked.mobile), sun = layersOf(baked.sunField);
  const std::vector<gpu::GpuCapture> captures = capturesOf(baked, true);
  std::vector<gpu::GpuLightmapScales> scales;
  for (std::size_t i = 0; i + 4 <= baked.mobileScales.size(); i += 4)
    scales.push_back(
        {baked.mobileScales[i], baked.mobileScales[i + 1], baked.mobileScales[i + 2], baked.mobileScales[i + 3]});
  return gpu::makeBakedMaps(device, {.lightmap = pagesOf(vk::Format::eR8G8B8A8Unorm, baked.mobile, lightmap),
                                     .sunShadow = pagesOf(vk::Format::eR8Unorm, baked.sunField, sun),
                                     .transitionScale = baked.transitionScale,
                                     .scales = scales,
                                     .captures = captures});
}

gpu::EnvironmentMaps uploadHighendCaptures(const gpu::Device& device, const bake::BakedLight& baked) {
  return uploadCaptures(device, cubesOf(baked), *baked.captures.front().light);
}

gpu::EnvironmentMaps uploadMobileCaptures(const gpu::Device& device, const bake::BakedLight& baked,
                                          mobile::CaptureEncoding encoding) {
  return uploadCaptures(device, cubesOf(baked), *baked.captures.front().light, encoding);
}

} // namespace parity::job
