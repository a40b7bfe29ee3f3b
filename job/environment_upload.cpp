#include "job/environment_upload.h"

#include <span>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "lighting/capture.h"
#include "shading/shading.h"

namespace parity::job {

namespace {

gpu::EnvironmentMaps makeMaps(const gpu::Device& device, const lighting::EnvironmentLight& light,
                              const gpu::DeviceImage::Shape& shape, std::span<const std::span<const std::byte>> mips) {
  if (!device.filtersLinearly(shape.format))
    throw base::Error(base::ExitCode::failed, device.report().name, "environment",
                      fmt::format("the device cannot filter textures of {}", vk::to_string(shape.format)));
  vk::SamplerCreateInfo sampler({}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear);
  sampler.addressModeU = sampler.addressModeV = sampler.addressModeW = vk::SamplerAddressMode::eClampToEdge;
  sampler.maxLod = VK_LOD_CLAMP_NONE;
  gpu::EnvironmentMaps maps{gpu::DeviceImage(device, shape, mips), vk::raii::Sampler(device.handle(), sampler), {}};
  for (std::size_t i = 0; i < maps.sh.size(); ++i) maps.sh[i] = glm::vec4(light.irradianceSh[i], 0);
  return maps;
}

} // namespace

gpu::EnvironmentMaps uploadEnvironment(const gpu::Device& device, const lighting::EnvironmentLight& light) {
  std::vector<std::vector<glm::vec4>> texels;
  texels.reserve(light.prefiltered.mips.size()); // the spans stay where they are
  std::vector<std::span<const std::byte>> mips;
  for (const auto& mip : light.prefiltered.mips) {
    // Mips of one layer hold it in place of those that are not read, too.
    std::vector<glm::vec4>& layers = texels.emplace_back(mip);
    for (int layer = lighting::layersOfMip(static_cast<int>(mips.size())); layer < shading::f32::kPrefilterLayers;
         ++layer)
      layers.insert(layers.end(), mip.begin(), mip.end());
    mips.push_back(std::as_bytes(std::span{layers}));
  }
  const auto size = static_cast<std::uint32_t>(light.prefiltered.faceSize);
  return makeMaps(device, light,
                  {.format = vk::Format::eR32G32B32A32Sfloat,
                   .width = size,
                   .height = size,
                   .mips = static_cast<std::uint32_t>(mips.size()),
                   .cube = true,
                   .arraySize = shading::f32::kPrefilterLayers},
                  mips);
}

gpu::EnvironmentMaps uploadCapture(const gpu::Device& device, const lighting::EnvironmentLight& light,
                                   mobile::CaptureEncoding encoding) {
  const bool rgbm = encoding == mobile::CaptureEncoding::rgbm;
  const lighting::Capture capture =
      rgbm ? lighting::encodeRgbm(light.prefiltered) : lighting::encodeHalf(light.prefiltered);
  const std::vector<std::span<const std::byte>> mips(capture.mips.begin(), capture.mips.end());
  const auto size = static_cast<std::uint32_t>(capture.faceSize);
  return makeMaps(device, light,
                  {.format = rgbm ? vk::Format::eR8G8B8A8Unorm : vk::Format::eR16G16B16A16Sfloat,
                   .width = size,
                   .height = size,
                   .mips = static_cast<std::uint32_t>(mips.size()),
                   .cube = true},
                  mips);
}

} // namespace parity::job
