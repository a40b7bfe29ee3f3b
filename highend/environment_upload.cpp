#include "highend/environment_upload.h"

#include <cassert>
#include <optional>
#include <span>
#include <vector>

#include "lighting/environment/irradiance_cube.h"
#include "lighting/environment/median_cut.h"
#include "paths/baked_upload.h"
#include "shading/shading.h"

namespace parity::highend {

namespace {

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

// Few, then many; where there are not as many, black ones.
gpu::Buffer uploadPoints(const gpu::Device& device, const lighting::PanoramaCells& cells) {
  std::vector<gpu::GpuEnvironmentPoint> points(gpu::kEnvironmentPoints);
  const auto fill = [&](std::size_t first, std::uint32_t count) {
    for (const lighting::EnvironmentPoint& point : lighting::cutEnvironment(cells, static_cast<int>(count)))
      points[first++] = {glm::vec4(point.direction, 0), glm::vec4(point.light, 0)};
  };
  fill(0, gpu::kFewPoints);
  fill(gpu::kFewPoints, gpu::kManyPoints);
  return gpu::Buffer(device, std::span<const gpu::GpuEnvironmentPoint>(points));
}

} // namespace

gpu::EnvironmentMaps uploadEnvironment(const gpu::Device& device, const lighting::EnvironmentLight& light,
                                       const lighting::PanoramaCells* cells, bool sheen) {
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
  if (sheen) maps.points = uploadPoints(device, *cells);
  return maps;
}

gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, paths::Cubes cubes,
                                    const lighting::EnvironmentLight& sky) {
  const std::size_t mipCount = cubes.front()->mips.size();
  std::vector<std::vector<glm::vec4>> joined(mipCount);
  std::vector<std::span<const std::byte>> mips;
  for (std::size_t m = 0; m < mipCount; ++m) {
    const auto lacking = [&](const lighting::CubeMap& cube) {
      return shading::f32::kPrefilterLayers - lighting::layersOf(cube, static_cast<int>(m));
    };
    if (cubes.size() == 1 && lacking(*cubes.front()) == 0) { // an environment's finest are tens of megabytes
      mips.push_back(std::as_bytes(std::span{cubes.front()->mips[m]}));
      continue;
    }
    for (const lighting::CubeMap* cube : cubes) {
      const std::vector<glm::vec4>& mip = cube->mips[m];
      // Mips of one layer hold it in place of those that are not read, too.
      for (int copies = 1 + lacking(*cube); copies > 0; --copies)
        joined[m].insert(joined[m].end(), mip.begin(), mip.end());
    }
    mips.push_back(std::as_bytes(std::span{joined[m]}));
  }
  const auto size = static_cast<std::uint32_t>(cubes.front()->faceSize);
  constexpr auto kFormat = vk::Format::eR32G32B32A32Sfloat;
  gpu::EnvironmentMaps maps =
      paths::makeCubes(device,
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

// The captures show the direct light of stationary lights, which this lightmap lacks: no measure for each other.
gpu::BakedMaps uploadBaked(const gpu::Device& device, const lighting::BakedLight& baked) {
  const std::vector<std::uint16_t> lightmap = paths::layersOf(baked.halfPages);
  const std::vector<std::uint8_t> sun = paths::layersOf(baked.sunMask);
  const std::vector<gpu::GpuCapture> captures =
      paths::capturesOf(baked, baked.localLights == lighting::LocalLights::isStatic);
  return gpu::makeBakedMaps(device,
                            {.lightmap = paths::pagesOf(vk::Format::eR16G16B16A16Sfloat, baked.halfPages, lightmap),
                             .sunShadow = paths::pagesOf(vk::Format::eR8Unorm, baked.sunMask, sun),
                             .transitionScale = 1,
                             .scales = {},
                             .captures = captures});
}

} // namespace parity::highend
