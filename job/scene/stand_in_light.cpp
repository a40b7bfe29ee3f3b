#include "job/scene/stand_in_light.h"

#include <algorithm>
#include <bit>

#include "lighting/environment/cube.h"
#include "lighting/environment/irradiance_cube.h"
#include "shading/shading.h"

namespace parity::job {

namespace {

constexpr glm::vec4 kWhite(1.f);

lighting::EnvironmentLight makeEnvironment(lighting::PrefilterLevels levels, bool hasLamps) {
  lighting::EnvironmentLight light;
  light.prefiltered.faceSize = lighting::kMinFaceSize;
  for (int mip = 0; mip <= shading::f64::kPrefilterRoughestMip; ++mip) {
    const auto side = static_cast<std::size_t>(lighting::kMinFaceSize >> mip);
    light.prefiltered.mips.emplace_back(
        static_cast<std::size_t>(lighting::kCubeFaces * lighting::layersOfMip(mip, levels)) * side * side, kWhite);
  }
  if (lighting::hasIrradianceCube(levels))
    light.irradianceCube.assign(
        std::size_t{lighting::kCubeFaces} * lighting::kIrradianceFaceSize * lighting::kIrradianceFaceSize, kWhite);
  if (hasLamps)
    light.lamps.wide.nodes.push_back(
        {.direction = glm::vec3(0, 1, 0), .spread = 1e-3f, .light = glm::vec3(1), .next = 1});
  return light;
}

// Lamps are what is brighter than the mean (lighting/environment/lamp_tree.h).
bool hasLamps(const lighting::PanoramaCells& cells) {
  const std::vector<glm::vec4>& texels = cells.mips.front();
  return std::ranges::any_of(texels, [&](const glm::vec4& texel) { return texel != texels.front(); });
}

lighting::PanoramaCells makeCells(const lighting::PanoramaCells& cells) {
  const auto sideFor = [](int side) { return std::has_single_bit(static_cast<unsigned>(side)) ? 64 : 60; };
  lighting::PanoramaCells small;
  small.width = sideFor(cells.width), small.height = sideFor(cells.height);
  for (int mip = 0; mip < 2; ++mip)
    small.mips.emplace_back(static_cast<std::size_t>(small.width >> mip) * (small.height >> mip), kWhite);
  return small;
}

} // namespace

paths::Light standInLight(const paths::Light& light, const paths::LightNeeds& needs) {
  const bool isFine = needs.prefilter.levels == lighting::PrefilterLevels::fine && light.cells;
  return {.lights = light.lights,
          .environment = std::make_shared<const lighting::EnvironmentLight>(
              makeEnvironment(needs.prefilter.levels, isFine && hasLamps(*light.cells))),
          .cells = light.cells ? std::make_shared<const lighting::PanoramaCells>(makeCells(*light.cells)) : nullptr};
}

} // namespace parity::job
