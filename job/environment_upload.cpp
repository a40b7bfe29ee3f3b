#include "job/environment_upload.h"

#include <span>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "lighting/capture.h"
#include "shading/shading.h"

namespace parity::job {

namespace {

// mips: of each, all cubes' layers one after another.
gpu::EnvironmentMaps makeMaps(const gpu::Device& device, const SkyIrradiance& sky, const gpu::DeviceImage::Shape& shape,
                              std::span<const std::span<const std::byte>> mips) {
  if (!device.filtersLinearly(shape.format))
    throw base::Error(base::ExitCode::failed, device.report().name, "environment",
                      fmt::format("the device cannot filter textures of {}", vk::to_string(shape.format)));
  if (const std::uint32_t limit = device.properties().limits.maxImageArrayLayers; 6 * shape.arraySize > limit)
    throw base::Error(base::ExitCode::failed, device.report().name, "environment captures",
                      fmt::format("{} cubes, the device takes {} at most", shape.arraySize, limit / 6));
  vk::SamplerCreateInfo sampler({}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear);
  sampler.addressModeU = sampler.addressModeV = sampler.addressModeW = vk::SamplerAddressMode::eClampToEdge;
  sampler.maxLod = VK_LOD_CLAMP_NONE;
  gpu::EnvironmentMaps maps{gpu::DeviceImage(device, shape, mips), vk::raii::Sampler(device.handle(), sampler), {}};
  for (std::size_t i = 0; i < maps.sh.size(); ++i) maps.sh[i] = glm::vec4(sky[i], 0);
  return maps;
}

} // namespace

gpu::EnvironmentMaps uploadEnvironment(const gpu::Device& device, const lighting::EnvironmentLight& light) {
  const lighting::CubeMap* cube = &light.prefiltered;
  return uploadCaptures(device, {&cube, 1}, light.irradianceSh);
}

gpu::EnvironmentMaps uploadCapture(const gpu::Device& device, const lighting::EnvironmentLight& light,
                                   mobile::CaptureEncoding encoding) {
  const lighting::CubeMap* cube = &light.prefiltered;
  return uploadCaptures(device, {&cube, 1}, light.irradianceSh, encoding);
}

gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, CaptureCubes cubes, const SkyIrradiance& sky) {
  const std::size_t mipCount = cubes.front()->mips.size();
  std::vector<std::vector<glm::vec4>> texels(mipCount);
  for (std::size_t m = 0; m < mipCount; ++m)
    for (const lighting::CubeMap* cube : cubes) {
      const std::vector<glm::vec4>& mip = cube->mips[m];
      texels[m].insert(texels[m].end(), mip.begin(), mip.end());
      // Mips of one layer hold it in place of those that are not read, too.
      for (int layer = lighting::layersOfMip(static_cast<int>(m)); layer < shading::f32::kPrefilterLayers; ++layer)
        texels[m].insert(texels[m].end(), mip.begin(), mip.end());
    }
  std::vector<std::span<const std::byte>> mips;
  for (const std::vector<glm::vec4>& mip : texels) mips.push_back(std::as_bytes(std::span{mip}));
  const auto size = static_cast<std::uint32_t>(cubes.front()->faceSize);
  return makeMaps(device, sky,
                  {.format = vk::Format::eR32G32B32A32Sfloat,
                   .width = size,
                   .height = size,
                   .mips = static_cast<std::uint32_t>(mips.size()),
                   .cube = true,
                   .arraySize = static_cast<std::uint32_t>(cubes.size()) * shading::f32::kPrefilterLayers},
                  mips);
}

gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, CaptureCubes cubes, const SkyIrradiance& sky,
                                    mobile::CaptureEncoding encoding) {
  const bool rgbm = encoding == mobile::CaptureEncoding::rgbm;
  std::vector<std::vector<std::byte>> texels;
  std::uint32_t size = 0;
  for (const lighting::CubeMap* cube : cubes) {
    const lighting::Capture capture = rgbm ? lighting::encodeRgbm(*cube) : lighting::encodeHalf(*cube);
    size = static_cast<std::uint32_t>(capture.faceSize);
    texels.resize(capture.mips.size());
    for (std::size_t m = 0; m < texels.size(); ++m)
      texels[m].insert(texels[m].end(), capture.mips[m].begin(), capture.mips[m].end());
  }
  const std::vector<std::span<const std::byte>> mips(texels.begin(), texels.end());
  return makeMaps(device, sky,
                  {.format = rgbm ? vk::Format::eR8G8B8A8Unorm : vk::Format::eR16G16B16A16Sfloat,
                   .width = size,
                   .height = size,
                   .mips = static_cast<std::uint32_t>(mips.size()),
                   .cube = true,
                   .arraySize = static_cast<std::uint32_t>(cubes.size())},
                  mips);
}

} // namespace parity::job
