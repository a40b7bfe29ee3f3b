// What the page says of the ground truth: both paths against it in words and figures, term by term, and what it is.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "compare/page_parts.h"
#include "compare/statistic.h"
#include "compare/text.h"
#include "compare/wording.h"
#include "shading/terms.h"

namespace parity::compare {
namespace {

std::string cell(const Figures& figures, const std::string& name) {
  const std::optional<double> value = figures.pixels > 0 ? figures.find(name) : std::nullopt;
  if (!value) return "<td>–</td>";
  return fmt::format("<td>{}</td>", name == "relmse" ? formatRelMse(*value) : formatFigure(name, *value));
}

std::string percent(double share) { return std::isnan(share) ? "not known" : fmt::format("{:.2g} %", 100 * share); }

// How well the truth is known.
std::string describeError(const TruthRegion& region) {
  const TruthError& error = region.error;
  const std::string luma = fmt::format("The truth's luma is {:.3f}", region.highend.referenceLuma);
  if (error.worst == 0)
    return luma + (error.samples > 0
                       ? fmt::format("; its {:.0f} samples a pixel in each way did not scatter.", error.samples)
                       : std::string("; it is in closed form, without noise."));
  return fmt::format(
      "{}; its standard error {} in the median, {} at worst, which alone gives relMSE {}; {:.0f} samples "
      "a pixel in each way.",
      luma, percent(error.median), percent(error.worst), formatRelMse(error.relmse), error.samples);
}

// "high-end is 0.1 EV darker", "mobile: equally bright, same tint".
std::string biasOf(const char* path, const Figures& figures) {
  const std::string words = describeBias(figures, path);
  return words.starts_with(path) ? words : fmt::format("{}: {}", path, words);
}

// Which terms no row is about.
std::string blackTerms(const std::vector<TruthTerm>& terms) {
  std::vector<std::string_view> black;
  for (const std::string_view name : shading::kTermNames)
    if (std::ranges::find(terms, name, &TruthTerm::name) == terms.end()) black.push_back(name);
  if (black.empty()) return {};
  return fmt::format("<p class=\"aside\">Black in all three: {}.</p>", fmt::join(black, ", "));
}

} // namespace

std::string pairHeading(const std::optional<Truth>& truth) { return truth ? "<h5>Mobile against high-end</h5>" : ""; }

std::string truthNumbers(const std::optional<Truth>& truth, bool whole) {
  if (!truth) return {};
  const TruthRegion& main = whole ? truth->all : mainRegion(*truth);
  std::string rows;
  for (const Figure& figure : main.highend.values) {
    const std::optional<Statistic> statistic = statisticByName(figure.name);
    rows += fmt::format("<tr><th scope=\"row\" title=\"{}\">{}</th>{}{}</tr>",
                        escapeMarkup(statistic ? statistic->label : figure.name), escapeMarkup(figure.name),
                        cell(main.highend, figure.name), cell(main.mobile, figure.name));
  }
  return fmt::format("<div class=\"truth\"><h5>Against the truth</h5><p class=\"light\">{}; {}</p><table "
                     "class=\"figures\"><thead><tr><th scope=\"col\">{}</th><th scope=\"col\">high-end</th><th "
                     "scope=\"col\">mobile</th></tr></thead><tbody>{}</tbody></table><p class=\"aside\">{}</p>{}</div>",
                     biasOf("high-end", main.highend), biasOf("mobile", main.mobile),
                     &main == &truth->interior ? "interior" : "all", rows, describeError(main),
                     textList(truth->notes, "warnings"));
}

std::string truthTerms(const std::optional<Truth>& truth, bool whole) {
  if (!truth) return {};
  double total = 0;
  for (const TruthTerm& term : truth->terms) total += term.truth;
  const auto share = [&](double light) {
    const std::string text = total > 0 ? fmt::format("{:+.1f} %", 100 * light / total) : std::string("–");
    return text == "-0.0 %" ? "+0.0 %" : text;
  };
  std::string rows;
  for (const TruthTerm& term : truth->terms) {
    const auto main = [&](const RegionFigures& f) -> const Figures& { return whole ? f.all : mainFigures(f); };
    const Figures &highend = main(term.highendFigures), &mobile = main(term.mobileFigures);
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{:.4f}</td><td>{:.4f}</td><td>{:.4f}</td><td>{}</td><td>{}"
                        "</td>{}{}{}{}</tr>",
                        escapeMarkup(term.name), term.truth, term.highend, term.mobile,
                        share(term.highend - term.truth), share(term.mobile - term.truth), cell(highend, "flip.mean"),
                        cell(mobile, "flip.mean"), cell(highend, "relmse"), cell(mobile, "relmse"));
  }
  return fmt::format(
      "<details class=\"terms truth-terms\" open=\"\"><summary>Where the light comes from, against the truth</summary>"
      "<table class=\"figures\"><thead><tr><th></th><th scope=\"colgroup\" colspan=\"3\">mean luminance</th><th "
      "scope=\"colgroup\" colspan=\"2\">more or less than the truth, of all light</th><th scope=\"colgroup\" "
      "colspan=\"2\">mean FLIP</th><th scope=\"colgroup\" colspan=\"2\">relMSE</th></tr><tr><th "
      "scope=\"col\">term</th><th scope=\"col\">truth</th>{0}{0}{0}{0}</tr></thead><tbody>{1}</tbody></table>{2}"
      "</details>",
      "<th scope=\"col\">high-end</th><th scope=\"col\">mobile</th>", rows, blackTerms(truth->terms));
}

std::string truthHelp(const Report& report) {
  if (!hasTruth(report)) return {};
  return "<p><b>The truth</b> is the same surface points lit by exact integrals, to the standard error that was asked "
         "for. It shows which of the two paths is off and by which term; it judges nothing. Terms are displayed and "
         "exposed alone, as the whole picture is; <b>relMSE</b> is the mean of the squared difference over the squared "
         "truth + 0.01, so that a pixel where the truth is black counts 100 times its squared light. Any relMSE "
         "against "
         "the truth holds that of its noise.</p>";
}

} // namespace parity::compare
