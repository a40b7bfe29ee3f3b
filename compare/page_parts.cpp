// Pieces of the report page: badges, images, bars, tables, the legend.
#include "compare/page_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "compare/magma.h"
#include "compare/statistic.h"
#include "compare/text.h"
#include "compare/wording.h"

namespace parity::compare {
namespace {

const char* signOf(Verdict verdict) {
  switch (verdict) {
  case Verdict::pass:
    return "✓";
  case Verdict::notSeen:
    return "○";
  case Verdict::warn:
    return "!";
  case Verdict::fail:
    return "✕";
  case Verdict::error:
    return "‼";
  }
  return "‼";
}

std::string image(const std::string& path, const char* kind, const char* caption, const std::string& subject) {
  const std::string label = fmt::format("<figcaption>{}</figcaption>", caption);
  if (path.empty()) return fmt::format("<figure><div class=\"no-image\">no image</div>{}</figure>", label);
  return fmt::format("<figure><a class=\"shot\" href=\"{0}\" target=\"_blank\" rel=\"noopener\" data-kind=\"{1}\"><img "
                     "src=\"{0}\" alt=\"{2}: {3}\" loading=\"lazy\"/></a>{4}</figure>",
                     escapeMarkup(encodeUrlPath(path)), kind, escapeMarkup(subject), caption, label);
}

std::string limitWords(const CheckResult& check) {
  std::string words;
  if (check.warnAbove) words += "warn " + formatLimit(check, *check.warnAbove);
  if (check.failAbove) words += (words.empty() ? "fail " : ", fail ") + formatLimit(check, *check.failAbove);
  return words;
}

// What a bar shows of a value: signed figures are limited in size, and what has not become worse has no length.
double barValue(const CheckResult& check) {
  if (std::isnan(check.value)) return 0;
  return check.regress ? std::max(check.value, 0.0) : std::abs(check.value);
}

// The right end of a bar: a little beyond whatever it has to show.
double barScale(const CheckResult& check) {
  double most = std::isfinite(check.value) ? barValue(check) : 0;
  for (const std::optional<double>& limit : {check.warnAbove, check.failAbove})
    most = std::max(most, limit.value_or(0));
  return most > 0 ? 1.15 * most : 1;
}

std::string checkBar(const CheckResult& check) {
  const double scale = barScale(check);
  // Identical images have an infinite psnr: a full bar.
  const double share = std::clamp(barValue(check) / scale, 0.0, 1.0);
  const auto mark = [&](const std::optional<double>& limit, const char* kind) {
    return limit ? fmt::format("<i class=\"mark {}\" style=\"left:{:.2f}%\"></i>", kind, 100 * *limit / scale) : "";
  };
  const char* verdict = check.judged() ? nameOf(check.verdict) : "not judged";
  std::string html = fmt::format(
      "<div class=\"check {}\"><div class=\"check-head\"><span>{} <small>{}{}</small></span><b>{}</b></div>"
      "<div class=\"bar\"><i class=\"fill\" style=\"width:{:.2f}%\"></i>{}{}</div><small>{} {}</small>",
      check.judged() ? verdictClass(check.verdict) : "not-seen", escapeMarkup(labelOf(check)),
      escapeMarkup(check.region), check.regress ? ", regression" : "", escapeMarkup(formatCheckValue(check)),
      100 * share, mark(check.warnAbove, "warn"), mark(check.failAbove, "fail"), verdict,
      limitWords(check).empty() ? "" : "(" + limitWords(check) + ")");
  if (!check.judged()) html += fmt::format(" <small class=\"aside\">{}</small>", escapeMarkup(check.unjudged));
  if (!check.note.empty()) html += fmt::format(" <small class=\"aside\">{}</small>", escapeMarkup(check.note));
  return html + "</div>";
}

} // namespace

std::string verdictClass(Verdict verdict) { return verdict == Verdict::notSeen ? "not-seen" : nameOf(verdict); }

std::string verdictBadge(Verdict verdict) {
  return fmt::format("<span class=\"badge {}\"><span aria-hidden=\"true\">{}</span> {}</span>", verdictClass(verdict),
                     signOf(verdict), nameOf(verdict));
}

std::string imageTrio(const ImageSet& images, const std::optional<Truth>& truth, const std::string& subject) {
  std::string html;
  if (!truth)
    html = image(images.reference, "reference", "High-end (reference)", subject) +
           image(images.test, "test", "Mobile", subject) + image(images.flip, "flip", "Difference (FLIP)", subject);
  else
    html = image(truth->images.truth, "truth", "Truth", subject) +
           image(images.reference, "reference", "High-end", subject) + image(images.test, "test", "Mobile", subject) +
           image(images.flip, "flip", "FLIP, mobile against high-end", subject) +
           image(truth->images.highendFlip, "highend-truth-flip", "FLIP, high-end against truth", subject) +
           image(truth->images.mobileFlip, "mobile-truth-flip", "FLIP, mobile against truth", subject);
  return fmt::format("<div class=\"trio\" data-title=\"{}\">{}</div>", escapeMarkup(subject), html);
}

std::string checkBars(const std::vector<CheckResult>& checks) {
  std::string html;
  for (const CheckResult& check : checks) html += checkBar(check);
  return html.empty() ? html : "<div class=\"checks\">" + html + "</div>";
}

std::string figureTable(const RegionFigures& regions, const std::optional<BaselineChange>& baseline) {
  const std::vector<FigureChange>* changes = nullptr;
  if (baseline && !baseline->isNew) changes = regions.interior.pixels > 0 ? &baseline->interior : &baseline->all;
  std::string rows;
  // By the name that budgets use: labels would take three lines each here; they show when pointed at.
  const auto addRow = [&](const std::string& name, const std::string& label, const std::string& interior,
                          const std::string& all, const std::string& change) {
    rows += fmt::format("<tr><th scope=\"row\" title=\"{}\">{}</th><td>{}</td><td>{}</td>", escapeMarkup(label),
                        escapeMarkup(name), interior, all);
    rows += changes ? fmt::format("<td>{}</td></tr>", change) : "</tr>";
  };
  for (const Figure& figure : regions.all.values) {
    const std::optional<double> interior =
        regions.interior.pixels > 0 ? regions.interior.find(figure.name) : std::nullopt;
    const std::optional<Statistic> statistic = statisticByName(figure.name);
    std::string change = "–";
    if (changes)
      for (const FigureChange& each : *changes)
        if (each.metric == figure.name) change = formatChange(figure.name, each.change());
    addRow(figure.name, statistic ? statistic->label : figure.name,
           interior ? formatFigure(figure.name, *interior) : "–", formatFigure(figure.name, figure.value), change);
  }
  const auto addCount = [&](const char* label, const auto& cell) {
    addRow(label, label, regions.interior.pixels > 0 ? cell(regions.interior) : "–", cell(regions.all), "");
  };
  addCount("luma, high-end", [](const Figures& f) { return fmt::format("{:.3f}", f.referenceLuma); });
  addCount("luma, mobile", [](const Figures& f) { return fmt::format("{:.3f}", f.testLuma); });
  addCount("pixels", [](const Figures& f) { return fmt::format("{}", f.pixels); });
  return fmt::format("<table class=\"figures\"><thead><tr><th></th><th scope=\"col\">interior</th><th "
                     "scope=\"col\">all</th>{}</tr></thead><tbody>{}</tbody></table>",
                     changes ? "<th scope=\"col\">since then</th>" : "", rows);
}

std::string baselineLine(const std::optional<BaselineChange>& baseline) {
  if (!baseline) return {};
  if (baseline->isNew) return "<p class=\"baseline\"><b>New</b>: the baseline does not show it.</p>";
  return fmt::format("<p class=\"baseline\">In the baseline: {}.</p>", verdictBadge(baseline->before));
}

std::string encodingLine(const std::optional<Encoding>& encoding, bool whole) {
  const std::string words = describeEncoding(encoding, whole);
  return words.empty() ? "" : fmt::format("<p class=\"aside encoding\">Mobile {}.</p>", escapeMarkup(words));
}

std::string termTable(const std::vector<TermFigures>& terms) {
  if (terms.empty()) return {};
  double total = 0;
  for (const TermFigures& term : terms) total += term.reference;
  std::string html =
      "<details class=\"terms\"><summary>Where the light comes from</summary><table class=\"figures\">"
      "<thead><tr><th scope=\"col\">term</th><th scope=\"col\">high-end</th><th scope=\"col\">mobile</th>"
      "<th scope=\"col\">of all light</th></tr></thead><tbody>";
  for (const TermFigures& term : terms) {
    const std::string share = total > 0 ? fmt::format("{:+.1f} %", 100 * (term.test - term.reference) / total) : "–";
    html += fmt::format("<tr><th scope=\"row\">{}</th><td>{:.4f}</td><td>{:.4f}</td><td>{}</td></tr>",
                        escapeMarkup(term.term), term.reference, term.test, share);
  }
  return html + "</tbody></table></details>";
}

std::string magmaLegend() {
  std::string stops;
  constexpr int kStops = 16;
  for (int i = 0; i <= kStops; ++i) {
    const std::array<std::uint8_t, 3> color = magmaColor(i * 255 / kStops);
    stops += fmt::format(",rgb({},{},{})", color[0], color[1], color[2]);
  }
  return fmt::format("<div class=\"legend\"><div class=\"scale\" style=\"background:linear-gradient(90deg{})\"></div>"
                     "<div class=\"ends\"><span>0 alike</span><span>0.25</span><span>0.5</span><span>0.75</span>"
                     "<span>1 far apart</span></div></div>",
                     stops);
}

std::string definition(const std::string& name, const std::string& value) {
  return value.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>", escapeMarkup(name), escapeMarkup(value));
}

std::string textList(const std::vector<std::string>& texts, const char* cssClass) {
  if (texts.empty()) return {};
  std::string html = fmt::format("<ul class=\"{}\">", cssClass);
  for (const std::string& text : texts) html += fmt::format("<li>{}</li>", escapeMarkup(text));
  return html + "</ul>";
}

} // namespace parity::compare
