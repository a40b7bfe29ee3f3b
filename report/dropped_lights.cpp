#include "report/dropped_lights.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "compare/verdict/wording.h"
#include "report/wording.h"

namespace parity::report {

void rankByEffect(DroppedLights& dropped) {
  for (DroppedLight& light : dropped.measured)
    std::ranges::stable_sort(light.materials, std::greater<>(), &LightEffect::flip);
  std::ranges::stable_sort(dropped.measured, std::greater<>(), &DroppedLight::worst);
}

std::string describe(const DroppedLights& dropped, const std::string& reference, const std::string& test) {
  constexpr std::size_t kMaxNamed = 3;
  std::string text = fmt::format("{} drops {} of {} light{}", titleOf(test), dropped.count(), dropped.lights,
                                 dropped.lights == 1 ? "" : "s");
  std::size_t named = 0;
  for (const DroppedLight& light : dropped.measured) {
    const std::string flip = compare::formatFigure("flip.mean", light.worst());
    if (named == kMaxNamed || flip == compare::formatFigure("flip.mean", 0)) break;
    const LightEffect& effect = light.materials.front();
    text += named++ == 0 ? fmt::format("; without '{}' the {} picture of '{}' changes by FLIP {}", light.name,
                                       titleOf(reference), effect.material, flip)
                         : fmt::format(", '{1}' by {2} without '{0}'", light.name, effect.material, flip);
  }
  if (named == 0) text += fmt::format("; no measured light changes the {} picture", titleOf(reference));
  if (!dropped.notMeasured.empty())
    text += fmt::format("; {} more {} not measured (--dropped-lights)", dropped.notMeasured.size(),
                        dropped.notMeasured.size() == 1 ? "was" : "were");
  return text;
}

} // namespace parity::report
