// One material's row of the report page: what it is, how it looks by both paths, how far apart, and by which budget.
#include <cmath>

#include <fmt/format.h>

#include "compare/page_parts.h"
#include "compare/text.h"
#include "compare/wording.h"

namespace parity::compare {

std::string materialRow(const MaterialResult& material, const std::string& place, std::size_t order) {
  const Figures& main = mainFigures(material.figures);
  const bool seen = material.figures.all.pixels > 0;
  const double light = main.referenceLuma > 0 ? std::abs(main.testLuma / main.referenceLuma - 1) : 0;
  const std::optional<double> mean = seen ? main.find("flip.mean") : std::nullopt;
  double change = 0;
  if (material.baseline)
    for (const FigureChange& each :
         material.figures.interior.pixels > 0 ? material.baseline->interior : material.baseline->all)
      if (each.metric == "flip.mean") change = each.change();
  std::string ofTruth; // for sorting
  if (material.truth)
    ofTruth = fmt::format(" data-truth=\"{:.6f}\"", mainRegion(*material.truth).highend.find("flip.mean").value_or(0));
  std::string html = fmt::format(
      "<article class=\"material {}\" data-name=\"{}\" data-verdict=\"{}\" data-gravity=\"{}\" data-mean=\"{}\" "
      "data-light=\"{:.6f}\" data-change=\"{:.6f}\"{} data-order=\"{}\"><div class=\"about\">{}<h4><bdi>{}</bdi></h4>",
      verdictClass(material.verdict), escapeMarkup(material.name), verdictClass(material.verdict),
      static_cast<int>(material.verdict), mean && std::isfinite(*mean) ? fmt::format("{:.6f}", *mean) : "",
      seen && std::isfinite(light) ? light : 0, std::isfinite(change) ? change : 0, ofTruth, order,
      verdictBadge(material.verdict), escapeMarkup(material.name));
  if (!material.reason.empty()) html += fmt::format("<p class=\"reason\">{}</p>", escapeMarkup(material.reason));
  if (seen) html += fmt::format("<p class=\"light\">{}</p>", describeBias(main));
  html += baselineLine(material.baseline);
  html += textList(material.notes, "notes");
  std::string budget;
  if (!material.rule.reason.empty()) budget += fmt::format("Limits: {}. ", escapeMarkup(material.rule.reason));
  if (!material.rule.owner.empty()) budget += fmt::format("Owner: {}. ", escapeMarkup(material.rule.owner));
  if (!material.rule.origin.empty()) budget += fmt::format("Rule: {}.", escapeMarkup(material.rule.origin));
  if (!budget.empty()) html += fmt::format("<p class=\"aside\">{}</p>", budget);
  html += "</div>";
  if (!seen) return html + "<p class=\"unseen\">No pixel of this view shows it.</p></article>\n";
  html += imageTrio(material.crops, material.truth, material.name + place);
  return html + fmt::format("<div class=\"numbers\">{}{}{}{}</div>{}</article>\n",
                            checkBars(material.checks) + pairHeading(material.truth),
                            figureTable(material.figures, material.baseline) + encodingLine(material.encoding, false),
                            truthNumbers(material.truth, false), material.truth ? "" : termTable(material.terms),
                            truthTerms(material.truth, false));
}

} // namespace parity::compare
