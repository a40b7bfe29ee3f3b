#include "report/dropped_lobes.h"

#include <fmt/format.h>

#include "compare/verdict/wording.h"
#include "report/wording.h"

namespace parity::report {

std::string describeDroppedLobes(const MaterialResult& material, const std::string& reference,
                                 const std::string& test) {
  std::string text = fmt::format("{} drops ", titleOf(test));
  for (std::size_t i = 0; i < material.droppedLobes.size(); ++i) {
    const DroppedLobe& dropped = material.droppedLobes[i];
    const std::string flip = compare::formatFigure("flip.mean", dropped.flip);
    text += i == 0
                ? fmt::format("the {} (FLIP {} of the {} picture without it)", dropped.lobe, flip, titleOf(reference))
                : fmt::format(" and the {} ({})", dropped.lobe, flip);
  }
  return text;
}

} // namespace parity::report
