#include "mobile/environment_upload.h"

#include <vector>

#include "lighting/environment/capture.h"
#include "lighting/environment/tinted_irradiance.h"
#include "paths/baked_upload.h"

namespace parity::mobile {

namespace {

vk::Format formatOf(CaptureEncoding encoding) {
  if (encoding == CaptureEncoding::rgbm) return vk::Format::eR8G8B8A8Unorm;
  if (encoding == CaptureEncoding::rgb9e5) return vk::Format::eE5B9G9R9UfloatPack32;
  return vk::Format::eR16G16B16A16Sfloat;
}

lighting::Capture encodeAs(CaptureEncoding encoding, const lighting::CubeMap& cube) {
  if (encoding == CaptureEncoding::rgbm) return lighting::encodeRgbm(cube);
  if (encoding == CaptureEncoding::rgb9e5) return lighting::encodeRgb9e5(cube);
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

} // namespace

gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, paths::Cubes cubes,
                                    const lighting::EnvironmentLight& sky, CaptureEncoding encoding) {
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
  gpu::EnvironmentMaps maps = paths::makeCubes(device,
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

gpu::BakedMaps uploadBaked(const gpu::Device& device, const lighting::BakedLight& baked, LightmapForm form) {
  const bool isHq = form == LightmapForm::hq;
  const std::vector<std::uint16_t> halves = isHq ? paths::layersOf(baked.halfPages) : std::vector<std::uint16_t>();
  const std::vector<std::uint8_t> bytes = isHq ? std::vector<std::uint8_t>() : paths::layersOf(baked.lqPages),
                                  sun = paths::layersOf(baked.sunField);
  const gpu::BakedPages lightmap = isHq ? paths::pagesOf(vk::Format::eR16G16B16A16Sfloat, baked.halfPages, halves)
                                        : paths::pagesOf(vk::Format::eR8G8B8A8Unorm, baked.lqPages, bytes);
  const std::vector<gpu::GpuCapture> captures = paths::capturesOf(baked, true);
  std::vector<gpu::GpuLightmapScales> scales;
  for (std::size_t i = 0; i + 4 <= baked.lqScales.size(); i += 4)
    scales.push_back({baked.lqScales[i], baked.lqScales[i + 1], baked.lqScales[i + 2], baked.lqScales[i + 3]});
  return gpu::makeBakedMaps(device, {.lightmap = lightmap,
                                     .sunShadow = paths::pagesOf(vk::Format::eR8Unorm, baked.sunField, sun),
                                     .transitionScale = baked.transitionScale,
                                     .scales = scales,
                                     .captures = captures});
}

} // namespace parity::mobile
