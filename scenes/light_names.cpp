#include "scenes/light_names.h"

#include <fmt/format.h>

#include "scenes/names.h"

namespace parity::scenes {

const char* nameOf(LightKind kind) {
  switch (kind) {
  case LightKind::directional:
    return "directional";
  case LightKind::point:
    return "point";
  case LightKind::spot:
    return "spot";
  }
  return "";
}

std::vector<std::string> lightNames(std::span<const Light> lights) {
  UniqueNames unique;
  std::vector<std::string> names;
  for (const Light& light : lights)
    names.push_back(unique.make(light.name, fmt::format("{} light {}", nameOf(light.kind), names.size() + 1)));
  return names;
}

} // namespace parity::scenes
