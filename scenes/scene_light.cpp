#include "scenes/scene_light.h"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace parity::scenes {

const std::vector<std::string>& falloffNames() {
  static const std::vector<std::string> names = {"khr", "ue4"};
  return names;
}

std::string describe(const LightScales& scales, const Fog& fog, Falloff falloff) {
  const auto rgb = [](const glm::vec3& c) { return fmt::format("{},{},{}", c.x, c.y, c.z); };
  const LightScales plain;
  std::vector<std::string> parts;
  if (scales.skyLightColor != plain.skyLightColor) parts.push_back("sky light x " + rgb(scales.skyLightColor));
  if (scales.indirectColorScale != plain.indirectColorScale)
    parts.push_back("lightmaps x " + rgb(scales.indirectColorScale));
  if (scales.sunSpecularScale != plain.sunSpecularScale)
    parts.push_back(fmt::format("specular of directional lights x {}", scales.sunSpecularScale));
  if (falloff != Falloff::khr)
    parts.push_back("falloff of local lights: " + falloffNames().at(static_cast<std::size_t>(falloff)));
  if (fog.isSeen())
    parts.push_back(
        fmt::format("fog: density {} per m at {} m, falloff {} per m, colour {}, start {} m, largest opacity {}",
                    fog.density, fog.height, fog.heightFalloff, rgb(fog.color), fog.startDistance, fog.maxOpacity));
  return fmt::format("{}", fmt::join(parts, "; "));
}

} // namespace parity::scenes
