#include "job/environment_upload.h"

#include <cassert>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "lighting/capture.h"
#include "lighting/irradiance_cube.h"
#include "lighting/tinted_irradiance.h"
#include "shading/shading.h"

namespace parity::job {

namespace {

// mips: of each, all cubes' layers one after another.
gpu::EnvironmentMaps makeMaps(const gpu::Device& device, const gpu::DeviceImage::Shape& shape,
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
  return {gpu::DeviceImage(device, shape, mips), vk::raii::Sampler(device.handle(), sampler)};
}

vk::Format formatOf(mobile::CaptureEncoding encoding) {
  if (encoding == mobile::CaptureEncoding::rgbm) return vk::Format::eR8G8B8A8Unorm;
  if (encoding == mobile::CaptureEncoding::rgb9e5) return vk::Format::eE5B9G9R9UfloatPack32;
  return vk::Format::eR16G16B16A16Sfloat;
}

lighting::Capture encodeAs(mobile::CaptureEncoding encoding, const lighting::CubeMap& cube) {
  if (encoding == mobile::CaptureEncoding::rgbm) return lighting::encodeRgbm(cube);
  if (encoding == mobile::CaptureEncoding::rgb9e5) return lighting::encodeRgb9e5(cube);
  return lighting::encodeHalf(cube);
}

std::array<glm::vec4, gpu::kTintedSkyNumbers> packTinted(const lighting::TintedIrradiance& sky) {
  std::array<glm::vec4, gpu::kTintedSkyNumbers> packed{};
  for (std::size_t i = 0; i < sky.linear.size(); ++i) packed[i] = glm::vec4(sky.linear[i], 0);
  packed[4] = glm::vec4(sky.tint, 0);
  packed[5] = glm::vec4(sky.quadratic[0], sky.quadratic[1], sky.quadratic[2], 0);
  packed[6] = glm::vec4(sky.quadratic[3], sky.quadratic[4], 0, 0);
  return packed;
}

static_assert(gpu::kMaxLamps >= 2 * (lighting::kMaxWideLampLeaves + lighting::kMaxCompactLamps));

// The compact ones, then the wide ones.
std::optional<gpu::Buffer> uploadLamps(const gpu::Device& device, const lighting::Lamps& lamps) {
  const std::size_t compact = lamps.compact.nodes.size(), count = compact + lamps.wide.nodes.size();
  if (count == 0) return std::nullopt;
  std::vector<gpu::GpuLamp> nodes;
  nodes.reserve(gpu::kMaxLamps);
  for (const lighting::LampTree* tree : {&lamps.compact, &lamps.wide})
    for (std::size_t i = 0; i < tree->nodes.size(); ++i) {
      const lighting::LampNode& node = tree->nodes[i];
      const std::size_t next = node.next + (tree == &lamps.wide ? compact : 0),
                        bits = (tree->isLeaf(i) ? gpu::kLampIsLeaf : 0) +
                               (tree == &lamps.compact ? gpu::kLampIsCompact : 0) + 4 * (next % count);
      nodes.push_back({glm::vec4(node.direction, node.spread), glm::vec4(node.light, static_cast<float>(bits))});
    }
  nodes.resize(gpu::kMaxLamps);
  return gpu::Buffer(device, std::span<const gpu::GpuLamp>(nodes));
}

} // namespace

gpu::EnvironmentMaps uploadEnvironment(const gpu::Device& device, const lighting::EnvironmentLight& light,
                                       const lighting::PanoramaCells* cells) {
  const lighting::CubeMap* cube = &light.prefiltered;
  gpu::EnvironmentMaps maps = uploadCaptures(device, {&cube, 1}, light);
  if (!cells) return maps;
  assert(lighting::layersOf(light.prefiltered, 0) == shading::f32::kPrefilterLayers);
  std::vector<std::span<const std::byte>> mips;
  for (const std::vector<glm::vec4>& mip : cells->mips) mips.push_back(std::as_bytes(std::span{mip}));
  const gpu::DeviceImage::Shape shape{.format = vk::Format::eR32G32B32A32Sfloat,
                                      .width = static_cast<std::uint32_t>(cells->width),
                                      .height = static_cast<std::uint32_t>(cells->height),
                                      .mips = static_cast<std::uint32_t>(mips.size())};
  maps.panorama.emplace(device, shape, mips);
  maps.panoramaTurns = cells->turns;
  maps.lamps = uploadLamps(device, light.lamps);
  return maps;
}

gpu::EnvironmentMaps uploadCapture(const gpu::Device& device, const lighting::EnvironmentLight& light,
                                   mobile::CaptureEncoding encoding) {
  const lighting::CubeMap* cube = &light.prefiltered;
  return uploadCaptures(device, {&cube, 1}, light, encoding);
}

gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, CaptureCubes cubes,
                                    const lighting::EnvironmentLight& sky) {
  const std::size_t mipCount = cubes.front()->mips.size();
  std::vector<std::vector<glm::vec4>> texels(mipCount);
  for (std::size_t m = 0; m < mipCount; ++m)
    for (const lighting::CubeMap* cube : cubes) {
      const std::vector<glm::vec4>& mip = cube->mips[m];
      texels[m].insert(texels[m].end(), mip.begin(), mip.end());
      // Mips of one layer hold it in place of those that are not read, too.
      for (int layer = lighting::layersOf(*cube, static_cast<int>(m)); layer < shading::f32::kPrefilterLayers; ++layer)
        texels[m].insert(texels[m].end(), mip.begin(), mip.end());
    }
  std::vector<std::span<const std::byte>> mips;
  for (const std::vector<glm::vec4>& mip : texels) mips.push_back(std::as_bytes(std::span{mip}));
  const auto size = static_cast<std::uint32_t>(cubes.front()->faceSize);
  constexpr auto kFormat = vk::Format::eR32G32B32A32Sfloat;
  gpu::EnvironmentMaps maps =
      makeMaps(device,
               {.format = kFormat,
                .width = size,
                .height = size,
                .mips = static_cast<std::uint32_t>(mips.size()),
                .cube = true,
                .arraySize = static_cast<std::uint32_t>(cubes.size()) * shading::f32::kPrefilterLayers},
               mips);
  if (sky.irradianceCube.empty()) return maps;
  constexpr std::uint32_t kSide = lighting::kIrradianceFaceSize;
  const std::span<const std::byte> irradiance = std::as_bytes(std::span{sky.irradianceCube});
  maps.irradiance.emplace(device,
                          gpu::DeviceImage::Shape{.format = kFormat, .width = kSide, .height = kSide, .cube = true},
                          std::span{&irradiance, 1});
  return maps;
}

gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, CaptureCubes cubes,
                                    const lighting::EnvironmentLight& sky, mobile::CaptureEncoding encoding) {
  std::vector<std::vector<std::byte>> texels;
  std::uint32_t size = 0;
  for (const lighting::CubeMap* cube : cubes) {
    const lighting::Capture capture = encodeAs(encoding, *cube);
    size = static_cast<std::uint32_t>(capture.faceSize);
    texels.resize(capture.mips.size());
    for (std::size_t m = 0; m < texels.size(); ++m)
      texels[m].insert(texels[m].end(), capture.mips[m].begin(), capture.mips[m].end());
  }
  const std::vector<std::span<const std::byte>> mips(texels.begin(), texels.end());
  gpu::EnvironmentMaps maps = makeMaps(device,
                                       {.format = formatOf(encoding),
                                        .width = size,
                                        .height = size,
                                        .mips = static_cast<std::uint32_t>(mips.size()),
                                        .cube = true,
                                        .arraySize = static_cast<std::uint32_t>(cubes.size())},
                                       mips);
  for (std::size_t i = 0; i < maps.sh.size(); ++i) maps.sh[i] = glm::vec4(sky.irradianceSh[i], 0);
  maps.tintedSky = packTinted(lighting::tintIrradiance(sky.irradianceSh));
  return maps;
}

} // namespace parity::job
