// Pieces of the report page: badges, images, bars, tables, the legend.
#include "compare/page_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "compare/budget.h"
#include "compare/magma.h"
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
  const char* side = isLowerBound(check) ? "below" : "above";
  std::string words;
  if (check.warnAbove) words += fmt::format("warn {} {}", side, formatFigure(check.metric, *check.warnAbove));
  if (check.failAbove)
    words += fmt::format("{}fail {} {}", words.empty() ? "" : ", ", side, formatFigure(check.metric, *check.failAbove));
  return words;
}

// The right end of a bar: a little beyond whatever it has to show.
double barScale(const CheckResult& check) {
  double most = std::isfinite(check.value) ? check.value : 0;
  for (const std::optional<double>& limit : {check.warnAbove, check.failAbove})
    most = std::max(most, limit.value_or(0));
  return most > 0 ? 1.15 * most : 1;
}

std::string checkBar(const CheckResult& check) {
  const double scale = barScale(check);
  // Identical images have an infinite psnr: a full bar.
  const double share = std::isnan(check.value) ? 0 : std::clamp(check.value / scale, 0.0, 1.0);
  const auto mark = [&](const std::optional<double>& limit, const char* kind) {
    return limit ? fmt::format("<i class=\"mark {}\" style=\"left:{:.2f}%\"></i>", kind, 100 * *limit / scale) : "";
  };
  const std::optional<Metric> metric = metricByName(check.metric);
  std::string html =
      fmt::format("<div class=\"check {}\"><div class=\"check-head\"><span>{} <small>{}</small></span><b>{}</b></div>"
                  "<div class=\"bar\"><i class=\"fill\" style=\"width:{:.2f}%\"></i>{}{}</div><small>{} {}</small>",
                  verdictClass(check.verdict), escapeMarkup(metric ? labelOf(*metric) : std::string_view(check.metric)),
                  escapeMarkup(check.region), formatFigure(check.metric, check.value), 100 * share,
                  mark(check.warnAbove, "warn"), mark(check.failAbove, "fail"), nameOf(check.verdict),
                  limitWords(check).empty() ? "" : "(" + limitWords(check) + ")");
  if (!check.note.empty()) html += fmt::format(" <small class=\"aside\">{}</small>", escapeMarkup(check.note));
  return html + "</div>";
}

} // namespace

std::string verdictClass(Verdict verdict) { return verdict == Verdict::notSeen ? "not-seen" : nameOf(verdict); }

std::string verdictBadge(Verdict verdict) {
  return fmt::format("<span class=\"badge {}\"><span aria-hidden=\"true\">{}</span> {}</span>", verdictClass(verdict),
                     signOf(verdict), nameOf(verdict));
}

std::string imageTrio(const ImageSet& images, const std::string& subject) {
  return fmt::format("<div class=\"trio\" data-title=\"{}\">{}{}{}</div>", escapeMarkup(subject),
                     image(images.reference, "reference", "High-end (reference)", subject),
                     image(images.test, "test", "Mobile", subject),
                     image(images.flip, "flip", "Difference (FLIP)", subject));
}

std::string checkBars(const std::vector<CheckResult>& checks) {
  std::string html;
  for (const CheckResult& check : checks) html += checkBar(check);
  return html.empty() ? html : "<div class=\"checks\">" + html + "</div>";
}

std::string figureTable(const RegionFigures& regions) {
  if (regions.all.pixels == 0) return {};
  struct Row {
    const char* label;
    std::string (*cell)(const Figures&);
  };
  static constexpr std::array<Row, 9> kRows = {{
      {"mean FLIP", [](const Figures& f) { return formatFigure("flip.mean", f.flip.mean); }},
      {"median", [](const Figures& f) { return formatFigure("flip.p50", f.flip.p50); }},
      {"p95", [](const Figures& f) { return formatFigure("flip.p95", f.flip.p95); }},
      {"max", [](const Figures& f) { return formatFigure("flip.max", f.flip.max); }},
      {"RMSE", [](const Figures& f) { return formatFigure("rmse", f.rmse); }},
      {"PSNR", [](const Figures& f) { return formatFigure("psnr", f.psnr); }},
      {"luma, high-end", [](const Figures& f) { return fmt::format("{:.3f}", f.referenceLuma); }},
      {"luma, mobile", [](const Figures& f) { return fmt::format("{:.3f}", f.testLuma); }},
      {"pixels", [](const Figures& f) { return fmt::format("{}", f.pixels); }},
  }};
  std::string html = "<table class=\"figures\"><thead><tr><th></th><th scope=\"col\">interior</th><th scope=\"col\">all"
                     "</th></tr></thead><tbody>";
  for (const Row& row : kRows)
    html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>", row.label,
                        regions.interior.pixels > 0 ? row.cell(regions.interior) : "–", row.cell(regions.all));
  return html + "</tbody></table>";
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

std::string textList(const std::vector<std::string>& texts, const char* cssClass) {
  if (texts.empty()) return {};
  std::string html = fmt::format("<ul class=\"{}\">", cssClass);
  for (const std::string& text : texts) html += fmt::format("<li>{}</li>", escapeMarkup(text));
  return html + "</ul>";
}

} // namespace parity::compare
