#include "report/dropped_lights.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "compare/verdict/wording.h"

namespace parity::report {

void rankByEffect(DroppedLights& dropped) {
  for (DroppedLight& light : dropped.measured)
    std::ranges::stable_sort(light.materials, std::greater<>(), &LightEffect::flip);
  std::ranges::stable_sort(dropped.measured, std::greater<>(), &DroppedLight::worst);
}

std::string describe(const DroppedLights& dropped) {
  constexpr std::size_t kMaxNamed = 3;
  std::string text =
      fmt::format("mobile drops {} of {} light{}", dropped.count(), dropped.lights, dropped.lights == 1 ? "" : "s");
  std::size_t named = 0;
  for (const DroppedLight& light : dropped.measured) {
    const std::string flip = compare::formatFigure("flip.mean", light.worst());
    if (named == kMaxNamed || flip == compare::formatFigure("flip.mean", 0)) break;
    const LightEffect& effect = light.materials.front();
    text += named++ == 0 ? fmt::format("; without '{}' the high-end picture of '{}' changes by FLIP {}", light.name,
                                       effect.material, flip)
                         : fmt::format(", without '{}' of '{}' by {}", light.name, effect.material, flip);
  }
  if (named == 0) text += "; without any one of those measured the high-end picture looks the same";
  if (!dropped.notMeasured.empty())
    text += fmt::format("; {} more {} not measured (--dropped-lights)", dropped.notMeasured.size(),
                        dropped.notMeasured.size() == 1 ? "was" : "were");
  return text;
}

} // namespace parity::report
