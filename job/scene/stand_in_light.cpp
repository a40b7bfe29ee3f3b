#include "job/scene/stand_in_light.h"

#include "lighting/environment/irradiance_cube.h"
#include "shading/shading.h"

namespace parity::job {

namespace {

constexpr int kFaces = 6, kCellsWidth = 64, kCellsHeight = 32;
constexpr glm::vec4 kWhite(1.f);

lighting::EnvironmentLight makeEnvironment(lighting::PrefilterLevels levels) {
  lighting::EnvironmentLight light;
  light.prefiltered.faceSize = lighting::kMinFaceSize;
  for (int mip = 0; mip <= shading::f64::kPrefilterRoughestMip; ++mip) {
    const auto side = static_cast<std::size_t>(lighting::kMinFaceSize >> mip);
    light.prefiltered.mips.emplace_back(
        static_cast<std::size_t>(kFaces * lighting::layersOfMip(mip, levels)) * side * side, kWhite);
  }
  if (lighting::hasIrradianceCube(levels))
    light.irradianceCube.assign(std::size_t{kFaces} * lighting::kIrradianceFaceSize * lighting::kIrradianceFaceSize,
                                kWhite);
  if (levels == lighting::PrefilterLevels::fine)
    light.lamps.wide.nodes.push_back(
        {.direction = glm::vec3(0, 1, 0), .spread = 1e-3f, .light = glm::vec3(1), .next = 1});
  return light;
}

lighting::PanoramaCells makeCells() {
  lighting::PanoramaCells cells;
  cells.width = kCellsWidth, cells.height = kCellsHeight;
  for (int mip = 0; mip < 2; ++mip)
    cells.mips.emplace_back(static_cast<std::size_t>(kCellsWidth >> mip) * (kCellsHeight >> mip), kWhite);
  return cells;
}

} // namespace

paths::Light standInLight(const paths::Light& light, const paths::LightNeeds& needs) {
  return {.lights = light.lights,
          .environment = std::make_shared<const lighting::EnvironmentLight>(makeEnvironment(needs.prefilter.levels)),
          .cells = needs.cells ? std::make_shared<const lighting::PanoramaCells>(makeCells()) : nullptr};
}

} // namespace parity::job
