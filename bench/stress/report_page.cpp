// index.html of a stress run: findings, every function's figures, maps of errors, scenes. Self-contained.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "compare/magma.h"
#include "compare/text.h"
#include "stress/stress_run.h"

namespace parity::stress {

namespace {

using compare::escapeMarkup;

constexpr const char* kStyle = R"(
:root {
  --ground: #f4f5f7; --card: #ffffff; --ink: #1b1f24; --quiet: #5c6670; --line: #d9dee3; --pass: #1a7f4b; --fail: #c4232b;
}
@media (prefers-color-scheme: dark) {
  :root {
    --ground: #14171a; --card: #1d2125; --ink: #e8eaed; --quiet: #9aa4ae; --line: #343a40; --pass: #4cc38a; --fail: #ff6b6b;
  }
}
.pass { --tone: var(--pass); }
.fail { --tone: var(--fail); }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 15px/1.45 system-ui, "DejaVu Sans", sans-serif; }
main { max-width: 1560px; margin: 0 auto; padding: 24px 20px 80px; }
h1 { font-size: 26px; margin: 2px 0 4px; overflow-wrap: anywhere; }
h2 { font-size: 21px; margin: 0 0 4px; }
p { margin: 0; }
small, .aside, .kicker { color: var(--quiet); font-size: 13px; }
.kicker { text-transform: uppercase; letter-spacing: .08em; font-weight: 600; }
header { padding: 18px 20px; background: var(--card); border: 1px solid var(--line); border-left: 6px solid var(--tone);
  border-radius: 10px; }
figure { margin: 0; }
.badge { padding: 1px 9px; border: 1px solid var(--tone); border-radius: 99px; color: var(--tone); font-size: 13px; }
main > section { margin-top: 26px; }
.panel { padding: 14px 16px; background: var(--card); border: 1px solid var(--line); border-radius: 10px; overflow-x:
  auto; }
.stress { border-collapse: collapse; width: 100%; font-size: 13px; font-variant-numeric: tabular-nums; }
.stress th { text-align: left; color: var(--quiet); font-weight: 500; }
.stress th, .stress td { padding: 3px 12px 3px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
.stress td.n { text-align: right; white-space: nowrap; }
.stress code, .finding code { overflow-wrap: anywhere; font-size: 12px; }
.bad { color: var(--fail); font-weight: 650; }
.finding { margin: 8px 0; padding: 10px 14px; background: var(--card); border: 1px solid var(--line); border-left:
  5px solid var(--tone); border-radius: 8px; }
.maps { display: grid; grid-template-columns: repeat(auto-fill, minmax(330px, 1fr)); gap: 14px; }
.maps figure { padding: 10px; background: var(--card); border: 1px solid var(--line); border-radius: 10px; }
.maps svg { width: 48%; height: auto; }
.maps figcaption { text-align: left; color: var(--ink); font-size: 13px; margin: 0 0 6px; }
.known td:nth-child(3) { min-width: 300px; }
.known td:nth-child(n+5) { min-width: 220px; overflow-wrap: anywhere; }
.maps rect { width: 6px; height: 6px; }
.axis { fill: var(--quiet); font-size: 9px; }
)";

// log10 of the error from 1e-8 (black) to 1 (white), as the difference maps are drawn.
std::string colorOf(double error) {
  const double share = std::clamp((std::log10(std::max(error, 1e-8)) + 8) / 8, 0.0, 1.0);
  const auto rgb = compare::magmaColor(static_cast<int>(std::lround(255 * share)));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::string drawMap(const Column& column, const std::string& roughness, const std::string& cosine) {
  constexpr int kCell = 6, kLeft = 14, kSide = kMapSize * kCell;
  std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", kSide + kLeft, kSide + 24,
                                escapeMarkup(column.name()));
  for (int r = 0; r < kMapSize; ++r)
    for (int c = 0; c < kMapSize; ++c) {
      const double error = column.tally.map[static_cast<std::size_t>(r * kMapSize + c)];
      if (error < 0) continue;
      svg += fmt::format("<rect x=\"{}\" y=\"{}\" fill=\"{}\"><title>{:.2f}, {:.2f}: {:.2g}</title></rect>",
                         kLeft + c * kCell, (kMapSize - 1 - r) * kCell, colorOf(error), (r + 0.5) / kMapSize,
                         (c + 0.5) / kMapSize, error);
    }
  svg += fmt::format("<text class=\"axis\" x=\"{}\" y=\"{}\">{} from 0 to 1</text>", kLeft, kSide + 10,
                     escapeMarkup(cosine));
  svg += fmt::format("<text class=\"axis\" transform=\"translate(10 {}) rotate(-90)\">{}</text>", kSide,
                     escapeMarkup(roughness));
  svg += fmt::format("<text class=\"axis\" x=\"{}\" y=\"{}\">{}</text></svg>", kLeft, kSide + 21,
                     escapeMarkup(column.name()));
  return svg;
}

std::string inputAt(const Domain& domain, int at) {
  for (const Input& input : domain.inputs)
    if (input.at == at) return input.name;
  return "";
}

// What is new, a card each.
std::string unexpectedList(const Report& report) {
  std::string html;
  for (const Finding& finding : report.findings) {
    if (finding.expected) continue;
    html += fmt::format("<div class=\"finding fail\"><b>{}</b> {} <span class=\"badge\">✗ unexpected</span> {}",
                        escapeMarkup(finding.subject), escapeMarkup(finding.place), escapeMarkup(finding.fault));
    if (finding.count > 0) html += fmt::format(", {} times", finding.count);
    if (!finding.region.empty())
      html +=
          fmt::format("<br>It was expected where {}: {}", escapeMarkup(finding.region), escapeMarkup(finding.reason));
    if (!finding.example.empty()) html += "<br><small>Worst: " + escapeMarkup(finding.example) + "</small>";
    html += "<br><code>parity stress " + escapeMarkup(finding.reproduce) + "</code></div>";
  }
  return html.empty() ? "<p>None.</p>" : html;
}

// What is known: a row for each cause, whatever the precisions and sides.
std::string expectedTable(const Report& report) {
  std::map<std::array<std::string, 3>, std::vector<const Finding*>> known;
  for (const Finding& finding : report.findings)
    if (finding.expected) known[{finding.subject, finding.fault, finding.region}].push_back(&finding);
  std::string html =
      "<table class=\"stress known\"><thead><tr><th>Of<th>What<th>Where and why<th>Rows or pixels<th>Worst of "
      "the first<th>Repeat</tr></thead><tbody>";
  for (const auto& [what, findings] : known) {
    std::string counts;
    for (const Finding* finding : findings)
      counts += fmt::format("{}: {}<br>", escapeMarkup(finding->place), finding->count);
    const Finding& first = *findings.front();
    html +=
        fmt::format("<tr><td><b>{}</b></td><td>{}</td><td>{}. {}</td><td class=\"n\">{}</td><td><small>{}</small></td>"
                    "<td><code>{}</code></td></tr>",
                    escapeMarkup(what[0]), escapeMarkup(what[1]), escapeMarkup(what[2]), escapeMarkup(first.reason),
                    counts, escapeMarkup(first.example), escapeMarkup(first.reproduce));
  }
  return html + "</tbody></table>";
}

std::string faultCells(const Tally& tally) {
  std::string html;
  for (const FaultCount& count : tally.faults)
    html += count.rows == 0 ? "<td class=\"n\">·</td>"
                            : fmt::format("<td class=\"n{}\">{}</td>", count.unexpected > 0 ? " bad" : "", count.rows);
  return html;
}

std::string functionTable(const Report& report) {
  std::string html = "<table class=\"stress\"><thead><tr><th>Function<th>Side<th>Rows";
  for (std::size_t f = 0; f < kFaultCount; ++f) html += fmt::format("<th>{}", nameOf(static_cast<Fault>(f)));
  html += "<th>Error 99.9 %<th>Error max<th>Device ulp<th>Outside, not finite<th>Worst error at</tr></thead><tbody>";
  for (const FunctionResult& result : report.functions) {
    bool first = true;
    for (const Column& column : result.columns) {
      html +=
          fmt::format("<tr><td>{}</td><td>{}</td>", first ? "<b>" + escapeMarkup(result.function.name) + "</b>" : "",
                      escapeMarkup(column.name()));
      first = false;
      const Tally& tally = column.tally;
      if (!column.skipped.empty()) {
        html += fmt::format("<td colspan=\"12\">skipped: {}</td></tr>", escapeMarkup(column.skipped));
        continue;
      }
      html += fmt::format("<td class=\"n\">{}</td>{}", tally.inside, faultCells(tally));
      html += fmt::format("<td class=\"n\">{:.3g}</td><td class=\"n\">{:.3g}</td><td class=\"n\">{}</td>",
                          tally.errors.percentile(0.999), tally.worstError ? tally.worstError->value : 0,
                          column.onDevice ? fmt::format("{:.3g}", tally.greatestUlps) : "");
      html += fmt::format("<td class=\"n\">{} of {}</td><td><code>{}</code></td></tr>", tally.outsideNotFinite,
                          tally.outside,
                          tally.worstError ? escapeMarkup(formatAt(result.function, tally.worstError->row)) : "");
    }
  }
  return html + "</tbody></table>";
}

std::string mapFigures(const Report& report) {
  std::string html;
  for (const FunctionResult& result : report.functions) {
    if (result.function.map.roughness < 0) continue;
    const std::string roughness = inputAt(result.function.domain, result.function.map.roughness),
                      cosine = inputAt(result.function.domain, result.function.map.cosine);
    html += fmt::format("<figure><figcaption>{}</figcaption>", escapeMarkup(result.function.name));
    for (const Column& column : result.columns)
      if (!column.onDevice && column.precision != Precision::f64) html += drawMap(column, roughness, cosine);
    html += "</figure>";
  }
  return html;
}

std::string sceneTable(const Report& report) {
  std::string html = "<table class=\"stress\"><thead><tr><th>Scene<th>What must come out<th>Result</tr></thead><tbody>";
  for (const SceneResult& scene : report.scenes) {
    const auto unexpected =
        std::count_if(scene.findings.begin(), scene.findings.end(), [](const Finding& f) { return !f.expected; });
    const std::string verdict = unexpected > 0 ? fmt::format("<span class=\"bad\">✗ {} unexpected</span>", unexpected)
                                : scene.findings.empty() ? "✓"
                                                         : fmt::format("✓, {} expected", scene.findings.size());
    html += fmt::format("<tr><td><b>{}</b></td><td>{}</td><td>{}</td></tr>", escapeMarkup(scene.name),
                        escapeMarkup(scene.wants), verdict);
  }
  return html + "</tbody></table>";
}

} // namespace

std::string formatPage(const Report& report) {
  const std::size_t unexpected = report.unexpected();
  std::string html = "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
                     "content=\"width=device-width\"><title>parity stress</title><style>";
  html += kStyle;
  html += fmt::format("</style></head><body><main><header class=\"{}\"><div><p class=\"kicker\">parity stress</p>"
                      "<h1>{} unexpected, {} expected findings</h1><p>",
                      unexpected > 0 ? "fail" : "pass", unexpected, report.findings.size() - unexpected);
  if (!report.functions.empty())
    html +=
        fmt::format("{} functions, {} points each on the CPU, {} on the device, besides special values ({:.0f} s). ",
                    report.functions.size(), report.points, report.devicePoints, report.functionsMs / 1000);
  if (!report.scenes.empty())
    html += fmt::format("{} scenes by every path, twice, under the validation layers ({:.0f} s). ",
                        report.scenes.size(), report.rendersMs / 1000);
  html += escapeMarkup(report.deviceName);
  if (!report.failure.empty()) html += ". Ended early: " + escapeMarkup(report.failure);
  if (!report.halfSkipped.empty()) html += ". Skipped: fp16 on the device: " + escapeMarkup(report.halfSkipped);
  html += "</p></div></header><section><h2>New</h2>" + unexpectedList(report) + "</section>";
  if (unexpected < report.findings.size())
    html += "<section><h2>Known</h2><div class=\"panel\">" + expectedTable(report) + "</div></section>";
  if (!report.functions.empty()) {
    html += "<section><h2>Errors over roughness and cosine</h2><p class=\"aside\">Greatest error against fp64 at the "
            "same inputs, relative to the value (or to the scale that the table states), from 1e-8 (black) to 1 and "
            "more (light).</p><div class=\"maps\">" +
            mapFigures(report) + "</div></section>";
    html += "<section><h2>Functions</h2><div class=\"panel\">" + functionTable(report) + "</div></section>";
  }
  if (!report.scenes.empty())
    html += "<section><h2>Scenes</h2><div class=\"panel\">" + sceneTable(report) + "</div></section>";
  return html + "</main></body></html>\n";
}

} // namespace parity::stress
