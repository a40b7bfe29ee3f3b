#include "sweep/sweep_page.h"

#include <cmath>

#include <fmt/format.h>

#include "compare/text.h"
#include "sweep/pareto_svg.h"
#include "sweep/statistics.h"

namespace parity::sweep {

namespace {

using compare::escapeMarkup;

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"/><title>parity bench</title>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'"/>
<style>
:root{color-scheme:light dark;--ink:#1d2230;--soft:#667;--line:#d8dce6;--paper:#fff;--high:#c2410c;--mob:#2563eb}
@media(prefers-color-scheme:dark){:root{--ink:#e6e8ef;--soft:#99a;--line:#3a3f4d;--paper:#171a21;--high:#fb923c;--mob:#7aa7ff}}
body{font:14px/1.45 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:1200px;margin:24px auto;padding:0 20px}
h1{font-size:22px;margin:0}h2{font-size:18px;margin:36px 0 6px;border-top:1px solid var(--line);padding-top:18px}
.sub{color:var(--soft);margin:4px 0 12px}table{border-collapse:collapse;font-variant-numeric:tabular-nums;margin:8px 0}
th,td{padding:2px 10px 2px 0;text-align:right;border-bottom:1px solid var(--line);white-space:nowrap}
th{color:var(--soft);font-weight:500}th:first-child,td:first-child{text-align:left;white-space:normal}
tr.dominated td{color:var(--soft)}tr.plain td{font-weight:600}.scroll{overflow-x:auto}
svg.pareto{width:100%;max-width:900px;display:block}svg text{font-size:11px;fill:var(--soft)}svg .title{font-size:12px}
svg .grid{stroke:var(--line)}circle.highend{fill:var(--high)}circle.mobile{fill:var(--mob)}
circle.dominated{fill:var(--soft);opacity:.45}circle:hover{stroke:var(--ink);stroke-width:2}
.front{fill:none;stroke-width:1.5;stroke-dasharray:4 3}.front.highend{stroke:var(--high)}.front.mobile{stroke:var(--mob)}
.key{display:inline-block;width:10px;height:10px;border-radius:5px;margin:0 4px 0 14px}
.slower{color:#b91c1c;font-weight:600}.faster{color:#15803d;font-weight:600}
</style></head><body>
)";

std::string number(double value, const char* form = "{:.3g}") {
  return std::isnan(value) ? "NaN" : fmt::format(fmt::runtime(form), value);
}

std::string list(const std::vector<std::string>& texts) {
  std::string html = "<ul>";
  for (const std::string& text : texts) html += "<li>" + escapeMarkup(text) + "</li>";
  return html + "</ul>\n";
}

std::string purchaseTable(const Conclusions& c) {
  if (c.purchases.empty()) return "";
  std::string html = fmt::format(
      "<h2>What a millisecond buys</h2><p class=\"sub\">One knob turned from the faster value to the slower one; "
      "medians over the scenes; ms of device time a million surface samples; {} against {}. A minus: it costs time and "
      "does harm. Where the quartiles of the two times overlap in most scenes, time counts as 1 % of the "
      "default's.</p>\n"
      "<div class=\"scroll\"><table><tr><th>knob</th><th>from</th><th>to</th><th>ms</th><th>error less</th>"
      "<th>error less a ms</th><th>times apart in</th></tr>\n",
      escapeMarkup(c.figure), c.against == Against::truth ? "the reference" : "the high-end default");
  for (const Purchase& p : c.purchases)
    html += fmt::format("<tr><td>{} {}</td><td>{}</td><td>{}</td><td>{:.2f}</td><td>{:+.5f}</td><td>{:+.2g}</td>"
                        "<td>{:.0f} %</td></tr>\n",
                        escapeMarkup(p.path), escapeMarkup(p.knob), escapeMarkup(p.from), escapeMarkup(p.to), p.timeMs,
                        p.error, p.perMs, 100 * p.certain);
  return html + "</table></div>\n";
}

std::string budgetTable(const Conclusions& c) {
  if (!c.budget) return "";
  std::string html = fmt::format("<h2>The fastest within {} &le; {:g}</h2><table><tr><th>scene</th><th>path</th>"
                                 "<th>setting</th></tr>\n",
                                 escapeMarkup(c.budget->figure), c.budget->limit);
  for (const Conclusions::Cheapest& each : c.cheapest)
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        each.scene.empty() ? "<b>all</b>" : escapeMarkup(each.scene), each.path,
                        each.setting ? escapeMarkup(*each.setting) : "none");
  return html + "</table>\n";
}

std::string ratioTable(const Conclusions& c) {
  if (!c.ratios) return "";
  std::string html = fmt::format("<h2>Against the earlier sweep</h2><p class=\"sub\">Time now over time then, with an "
                                 "interval of {:.2f} % confidence (all together 95 %).</p>\n",
                                 100 * c.ratios->confidence) +
                     list(c.ratios->notes) +
                     "<div class=\"scroll\"><table><tr><th>setting</th><th>scene</th><th>ratio</th><th>from</th>"
                     "<th>to</th><th></th></tr>\n";
  for (const VariantRatio& v : c.ratios->variants)
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{}</td></tr>\n",
                        escapeMarkup(v.id), escapeMarkup(v.scene), v.time.ratio, v.time.low, v.time.high,
                        v.time.isSlower()   ? "<span class=\"slower\">slower</span>"
                        : v.time.isFaster() ? "<span class=\"faster\">faster</span>"
                                            : "");
  return html + "</table></div>\n";
}

std::string errorCells(const RegionErrors& region) {
  std::string html;
  for (const std::string& name : errorNames())
    html += fmt::format("<td>{}</td>", region.truth ? number(errorOf(*region.truth, name), "{:.4g}") : "–");
  for (const std::string& name : errorNames())
    html += fmt::format("<td>{}</td>", number(errorOf(region.highend, name), "{:.4g}"));
  return html + fmt::format("<td>{}</td>", region.highend.nonFinite ? std::to_string(region.highend.nonFinite) : "");
}

// Cells of time and cost, by stage, under their heads.
std::string timeHeads(Stage stage) {
  if (stage == Stage::storage) return "";
  if (stage == Stage::preparation) return "<th>prepare ms</th><th>quartiles</th>";
  return "<th>device ms</th><th>quartiles</th><th>wall</th><th>CPU</th><th>compile</th><th>operations</th>"
         "<th>fetches</th><th>samplers</th>";
}
std::string timeCells(const VariantResult& v) {
  if (v.stage == Stage::storage) return "";
  const Spread time = spreadOf(v.stage == Stage::shading ? v.times.deviceMs : v.prepareMs);
  std::string html = fmt::format("<td>{:.2f}</td><td>{:.2f}–{:.2f}</td>", time.median, time.low, time.high);
  if (v.stage == Stage::preparation) return html;
  return html + fmt::format("<td>{:.2f}</td><td>{:.2f}</td><td>{:.0f}</td><td>{:.0f}</td><td>{:.1f}</td><td>{}</td>",
                            spreadOf(v.times.wallMs).median, spreadOf(v.times.cpuMs).median, v.times.compileMs,
                            v.cost.operations, v.cost.fetches, v.cost.samplers);
}

// Empty where the scene has no setting of that stage.
std::string variantTable(const SceneSweep& scene, Stage stage, const std::vector<bool>& dominated) {
  std::string rows;
  for (std::size_t i = 0; i < scene.variants.size(); ++i) {
    const VariantResult& v = scene.variants[i];
    if (v.stage == stage)
      rows += fmt::format("<tr class=\"{}\"><td>{}</td>{}{}</tr>\n",
                          v.name == "default" ? "plain"
                          : dominated[i]      ? "dominated"
                                              : "",
                          escapeMarkup(v.id()), timeCells(v), errorCells(v.whole));
  }
  if (rows.empty()) return "";
  return "<div class=\"scroll\"><table><tr><th>setting</th>" + timeHeads(stage) +
         "<th>FLIP, reference</th><th>p95</th><th>relMSE</th><th>FLIP, high-end</th><th>p95</th><th>relMSE</th>"
         "<th>NaN</th></tr>\n" +
         rows + "</table></div>\n";
}

// FLIP mean of every material by every setting, folded away.
std::string materialTable(const SceneSweep& scene, Against against, const std::string& figure) {
  if (scene.variants.empty() || scene.variants.front().materials.empty()) return "";
  std::string html =
      fmt::format("<details><summary>{} by material</summary><div class=\"scroll\"><table><tr><th>setting"
                  "</th>",
                  escapeMarkup(figure));
  for (const RegionErrors& region : scene.variants.front().materials)
    html += "<th>" + escapeMarkup(region.name) + "</th>";
  html += "</tr>\n";
  for (const VariantResult& v : scene.variants) {
    html += "<tr><td>" + escapeMarkup(v.id()) + "</td>";
    for (const RegionErrors& region : v.materials)
      html += fmt::format("<td>{}</td>", number(errorOf(region, against, figure).value_or(std::nan("")), "{:.4f}"));
    html += "</tr>\n";
  }
  return html + "</table></div></details>\n";
}

std::string sceneSection(const SceneSweep& scene, const Conclusions& c) {
  std::string html = fmt::format("<h2>{}</h2>", escapeMarkup(scene.scene));
  if (!scene.failure.empty()) return html + "<p class=\"slower\">" + escapeMarkup(scene.failure) + "</p>\n";
  html += fmt::format("<p class=\"sub\">environment {}, sun {}; {}x{}, {} surface samples{}</p>\n",
                      escapeMarkup(scene.environment), escapeMarkup(scene.sun), scene.width, scene.height, scene.pixels,
                      scene.truthError > 0
                          ? fmt::format("; the reference is known to {:.2g} % (median pixel)", 100 * scene.truthError)
                          : "");
  html += "<p><span class=\"key\" style=\"background:var(--high)\"></span>high-end"
          "<span class=\"key\" style=\"background:var(--mob)\"></span>mobile"
          "<span class=\"key\" style=\"background:var(--soft);opacity:.45\"></span>dominated; the larger dot is a "
          "path's default</p>\n";
  html += paretoSvg(scene, Stage::shading, c.against, c.figure);
  if (c.against == Against::truth) html += paretoSvg(scene, Stage::shading, Against::highend, c.figure);
  const std::vector<bool> dominated = findDominated(scene, c.against, c.figure);
  html += variantTable(scene, Stage::shading, dominated);
  html += paretoSvg(scene, Stage::preparation, c.against, c.figure);
  html += variantTable(scene, Stage::preparation, dominated) + variantTable(scene, Stage::storage, dominated);
  html += materialTable(scene, c.against, c.figure);
  if (!scene.skipped.empty())
    html += "<p class=\"sub\">Not tried, for the scene does not need it:</p>" + list(scene.skipped);
  return html;
}

} // namespace

std::string toPage(const SweepReport& report, const Conclusions& c) {
  std::string html = kHead;
  html += fmt::format("<h1>Error against time</h1><p class=\"sub\">parity {}; {}; {} ({}, driver {}), {} threads, SIMD "
                      "{}; {} rounds in random order, medians; compiling apart; {}<br/><code>{}</code></p>\n",
                      escapeMarkup(report.version), escapeMarkup(report.machine.processor),
                      escapeMarkup(report.machine.device), escapeMarkup(report.machine.deviceKind),
                      escapeMarkup(report.machine.driver), report.machine.threads, escapeMarkup(report.machine.simd),
                      report.rounds, escapeMarkup(report.startedAt), escapeMarkup(report.commandLine));
  html += ratioTable(c) + budgetTable(c) + purchaseTable(c);
  html +=
      fmt::format("<h2>Dominated in every scene</h2><p class=\"sub\">Another setting of the same path is as fast and "
                  "as right everywhere ({}).</p>\n",
                  escapeMarkup(c.figure));
  html += c.dominated.empty() ? "<p>None.</p>\n" : list(c.dominated);
  for (const SceneSweep& scene : report.scenes) html += sceneSection(scene, c);
  return html + "</body></html>\n";
}

} // namespace parity::sweep
