#include "report/what_if.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "compare/verdict/wording.h"
#include "report/report.h"

namespace parity::report {
namespace {

constexpr double kLeastShare = 0.1; // of FLIP, as of a cause (report/wording.h)

double flipOf(const compare::Figures& figures) { return figures.find("flip.mean").value_or(INFINITY); }

// Another verdict is no help, because it judges less.
bool isJudged(compare::Verdict verdict) {
  return verdict == compare::Verdict::pass || verdict == compare::Verdict::warn || verdict == compare::Verdict::fail;
}

bool helps(const WhatIf& whatIf, const MaterialResult& material) {
  if (!isJudged(whatIf.verdict) || whatIf.verdict > material.verdict) return false;
  return whatIf.verdict < material.verdict || flipOf(whatIf.figures) <= flipOf(material.figures) * (1 - kLeastShare);
}

} // namespace

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

const WhatIf* bestWhatIf(const MaterialResult& material) {
  const WhatIf* best = nullptr;
  for (const WhatIf& each : material.whatIf) {
    if (!helps(each, material)) continue;
    if (!best || std::pair(each.verdict, flipOf(each.figures)) < std::pair(best->verdict, flipOf(best->figures)))
      best = &each;
  }
  return best;
}

} // namespace parity::report
