#include "paths/cube_upload.h"

#include <fmt/format.h>

#include "base/error.h"

namespace parity::paths {

gpu::EnvironmentMaps makeCubes(const gpu::Device& device, const gpu::DeviceImage::Shape& shape,
                               std::span<const std::span<const std::byte>> mips) {
  if (!device.filtersLinearly(shape.format))
    throw base::Error(base::ExitCode::failed, device.report().name, "environment",
                      fmt::format("the device cannot filter textures of {}", vk::to_string(shape.format)));
  if (const std::uint32_t limit = device.properties().limits.maxImageArrayLayers; 6 * shape.arraySize > limit)
    throw base::Error(base::ExitCode::failed, device.report().name, "environment captures",
                      fmt::format("{} cube maps; the device allows at most {}", shape.arraySize, limit / 6));
  vk::SamplerCreateInfo sampler({}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear);
  sampler.addressModeU = sampler.addressModeV = sampler.addressModeW = vk::SamplerAddressMode::eClampToEdge;
  sampler.maxLod = VK_LOD_CLAMP_NONE;
  return {gpu::DeviceImage(device, shape, mips), vk::raii::Sampler(device.handle(), sampler)};
}

std::vector<const lighting::CubeMap*> cubesOf(const lighting::BakedLight& baked) {
  std::vector<const lighting::CubeMap*> cubes;
  for (const lighting::BakedCapture& c : baked.captures) cubes.push_back(&c.light->prefiltered);
  return cubes;
}

} // namespace parity::paths
