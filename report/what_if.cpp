#include "report/what_if.h"

#include <fmt/format.h>

#include "compare/verdict/wording.h"
#include "report/report.h"

namespace parity::report {

std::string describe(const WhatIf& whatIf, const compare::Figures& now) {
  std::string words = fmt::format("with {}:", whatIf.preset);
  const auto add = [&](const char* figure, const char* before) {
    const std::optional<double> then = whatIf.figures.find(figure), is = now.find(figure);
    if (then && is)
      words += fmt::format(" {}{} instead of {},", before, compare::formatFigure(figure, *then),
                           compare::formatFigure(figure, *is));
  };
  add("flip.mean", "FLIP ");
  add("bias.ev", "");
  return words + " " + nameOf(whatIf.verdict);
}

std::string describeWhatIfs(const MaterialResult& material) {
  std::string words;
  for (const WhatIf& each : material.whatIf) words += (words.empty() ? "" : "; ") + each.words;
  return words;
}

} // namespace parity::report
