// index.html: one self-contained page beside images/, for whoever has a minute.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "compare/page_parts.h"
#include "compare/report.h"
#include "compare/text.h"
#include "compare/wording.h"
#include "compare_page/report_page.css.h"
#include "compare_page/report_page.js.h"

namespace parity::compare {
namespace {

// Nothing but images beside the page, and what the page itself holds.
constexpr const char* kPolicy = "default-src 'none'; img-src 'self' data: file:; style-src 'unsafe-inline'; "
                                "script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

std::size_t countViews(const Report& report) {
  std::size_t views = 0;
  for (const SceneResult& scene : report.scenes) views += scene.views.size();
  return views;
}

std::string anchor(std::size_t scene, std::size_t view) { return fmt::format("scene-{}-view-{}", scene + 1, view + 1); }

// Which truth it is, in the header: it decides what its figures mean.
std::string truthLine(const Report& report) {
  const auto setting = std::ranges::find(report.settings, "truth", [](const auto& each) { return each.first; });
  return setting == report.settings.end() ? "" : fmt::format("<br/>Truth: {}", escapeMarkup(setting->second));
}

std::string header(const Report& report, const RunInfo& run) {
  std::string details = definition("Version", report.version) + definition("Device", report.device) +
                        definition("Started", run.startedAt);
  for (const auto& [name, value] : report.settings) details += definition(name, value);
  details += definition("Command", run.commandLine);
  for (const auto& [stage, timeMs] : run.timings) details += definition(stage, fmt::format("{:.0f} ms", timeMs));
  return fmt::format(
      "<header class=\"{}\"><div><p class=\"kicker\">{} report</p><h1>{} {}</h1><p "
      "class=\"sub\">{}{}</p></div>{}</header>\n"
      "<div class=\"two\"><details><summary>Settings, device, times</summary><dl>{}</dl></details>\n"
      "<details><summary>How to read this page</summary><div class=\"help\"><p>Every material is shaded twice at the "
      "very "
      "same surface points: by the high-end path and by the mobile path. FLIP says how different the two look when one "
      "flips between them: 0 is alike, 1 is far apart. On an even mid grey, 0.03 is one step of 8 bit, 0.10 is 10 % "
      "more "
      "or less light (seen side by side), 0.20 about 25 % (seen at a glance), 0.50 twice as much or a third.</p><p>"
      "<b>interior</b> leaves out a rim of 10 pixels, where FLIP also sees the neighbours. <b>p95</b>: a twentieth of "
      "the "
      "pixels is worse than this. <b>Warmer</b> is yellower, <b>cooler</b> bluer, on average. Click an image to flip "
      "between the renders; the number keys and the arrows work "
      "there.</p>{}</div></details></div>\n",
      verdictClass(report.verdict), escapeMarkup(report.tool), verdictBadge(report.verdict),
      escapeMarkup(headline(report)), escapeMarkup(report.device), truthLine(report), magmaLegend(), details,
      truthHelp(report));
}

std::string toolbar(const Report& report) {
  const VerdictCounts counts = countVerdicts(report);
  std::string html =
      "<div class=\"toolbar\" hidden=\"\"><input type=\"search\" id=\"filter\" placeholder=\"Filter materials\" "
      "aria-label=\"Filter materials by name\"/>";
  const auto chip = [&](Verdict verdict, std::size_t count) {
    if (count > 0)
      html +=
          fmt::format("<label class=\"chip {0}\"><input type=\"checkbox\" checked=\"\" value=\"{0}\"/> {1} {2}</label>",
                      verdictClass(verdict), count, nameOf(verdict));
  };
  chip(Verdict::error, counts.error);
  chip(Verdict::fail, counts.fail);
  chip(Verdict::warn, counts.warn);
  chip(Verdict::notSeen, counts.notSeen);
  chip(Verdict::pass, counts.pass);
  return html +
         "<label class=\"sort\">Sort by <select id=\"sort\"><option value=\"gravity\">verdict</option><option "
         "value=\"mean\">mean FLIP</option><option value=\"light\">brightness difference</option>" +
         std::string(hasTruth(report) ? "<option value=\"truth\">high-end against truth</option>" : "") +
         std::string(report.baseline ? "<option value=\"change\">change since the baseline</option>" : "") +
         "<option value=\"name\">name</option><option value=\"order\">order in the "
         "scene</option></select></label></div>\n";
}

// One line a view, for reports of several; the worst first.
std::string overview(const Report& report) {
  if (countViews(report) < 2 && report.scenes.size() < 2) return {};
  struct Line {
    Verdict verdict;
    double mean;
    std::string html;
  };
  const bool truth = hasTruth(report);
  const auto meanCell = [](const std::optional<double>& mean) {
    return fmt::format("<td>{}</td>", mean ? formatFigure("flip.mean", *mean) : "–");
  };
  const auto truthCells = [&](const ViewResult& view) {
    if (!truth) return std::string();
    const auto mean = [&](Figures TruthRegion::*path) {
      return view.truth ? (view.truth->all.*path).find("flip.mean") : std::nullopt;
    };
    return meanCell(mean(&TruthRegion::highend)) + meanCell(mean(&TruthRegion::mobile));
  };
  std::vector<Line> lines;
  for (std::size_t s = 0; s < report.scenes.size(); ++s) {
    const SceneResult& scene = report.scenes[s];
    if (!scene.error.empty())
      lines.push_back(
          {Verdict::error, 0,
           fmt::format("<tr><td>{}</td><td><a href=\"#scene-{}\">{}</a></td><td colspan=\"{}\">{}</td></tr>",
                       verdictBadge(Verdict::error), s + 1, escapeMarkup(scene.name), truth ? 7 : 5,
                       escapeMarkup(scene.error))});
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
      const ViewResult& view = scene.views[v];
      const auto over =
          std::ranges::count_if(view.materials, [](const MaterialResult& m) { return m.verdict >= Verdict::fail; });
      const bool seen = view.whole.all.pixels > 0;
      const std::optional<double> mean = seen ? view.whole.all.find("flip.mean") : std::nullopt;
      lines.push_back(
          {view.verdict, mean.value_or(0), // unmeasured ones sort last
           fmt::format("<tr><td>{}</td><td><a href=\"#{}\">{}</a></td><td>{}</td><td>{}</td><td>{}</td>{}{}<td>{}"
                       "</td></tr>",
                       verdictBadge(view.verdict), anchor(s, v), escapeMarkup(scene.name), escapeMarkup(view.name),
                       view.materials.size(), over, meanCell(mean), truthCells(view),
                       seen ? describeBias(view.whole.all) : "nothing seen")});
    }
  }
  std::ranges::stable_sort(lines, [](const Line& a, const Line& b) {
    return a.verdict != b.verdict ? a.verdict > b.verdict : a.mean > b.mean;
  });
  std::string html =
      "<table class=\"overview\"><thead><tr><th scope=\"col\">verdict</th><th scope=\"col\">scene</th><th "
      "scope=\"col\">view</th><th scope=\"col\">materials</th><th scope=\"col\">over budget</th><th "
      "scope=\"col\">mean FLIP</th>" +
      std::string(truth ? "<th scope=\"col\">high-end / truth</th><th scope=\"col\">mobile / truth</th>" : "") +
      "<th scope=\"col\">bias</th></tr></thead><tbody>";
  for (const Line& line : lines) html += line.html;
  return html + "</tbody></table>\n";
}

std::string viewSection(const SceneResult& scene, const ViewResult& view, const std::string& id) {
  const std::string place = fmt::format(", {}, view {}", scene.name, view.name);
  std::string html = fmt::format(
      "<section class=\"view\" id=\"{}\"><h3>{} View <bdi>{}</bdi> <small>{} × {} pixels</small></h3>\n<div "
      "class=\"whole\">{}<div class=\"numbers\"><h4>Whole image {}</h4>",
      id, verdictBadge(view.verdict), escapeMarkup(view.name), view.width, view.height,
      imageTrio(view.images, view.truth, "Whole image" + place), verdictBadge(view.wholeVerdict));
  if (!view.reason.empty()) html += fmt::format("<p class=\"reason\">{}</p>", escapeMarkup(view.reason));
  if (view.whole.all.pixels > 0) html += fmt::format("<p class=\"light\">{}</p>", describeBias(view.whole.all));
  html += baselineLine(view.baseline) + checkBars(view.checks) + pairHeading(view.truth) +
          figureTable(view.whole, view.baseline) + encodingLine(view.encoding, true) + truthNumbers(view.truth, true) +
          "</div>" + truthTerms(view.truth, true) + "</div>\n";

  std::vector<std::size_t> order(view.materials.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const MaterialResult &left = view.materials[a], &right = view.materials[b];
    if (left.verdict != right.verdict) return left.verdict > right.verdict;
    const auto mean = [](const MaterialResult& m) { return mainFigures(m.figures).find("flip.mean").value_or(0); };
    return mean(left) > mean(right);
  });
  html += "<div class=\"materials\">\n";
  for (const std::size_t i : order) html += materialRow(view.materials[i], place, i);
  return html + "</div></section>\n";
}

std::string sceneSection(const SceneResult& scene, std::size_t index) {
  std::string html =
      fmt::format("<section class=\"scene\" id=\"scene-{}\"><h2>{} <bdi>{}</bdi></h2>\n<dl "
                  "class=\"inline\">{}{}{}{}</dl>\n",
                  index + 1, verdictBadge(scene.verdict), escapeMarkup(scene.name), definition("Source", scene.source),
                  definition("Environment", scene.environment), definition("Sun", scene.sun),
                  scene.light.empty() ? std::string() : definition("Light", scene.light));
  if (!scene.error.empty())
    html += fmt::format("<p class=\"error-box\"><b>Not compared:</b> {}</p>\n", escapeMarkup(scene.error));
  html += textList(scene.warnings, "warnings") + passTable(scene.passes) + permutationTable(scene.permutations);
  for (std::size_t v = 0; v < scene.views.size(); ++v) html += viewSection(scene, scene.views[v], anchor(index, v));
  return html + "</section>\n";
}

} // namespace

std::string toHtml(const Report& report, const RunInfo& run) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta "
      "http-equiv=\"Content-Security-Policy\" "
      "content=\"{}\"/>\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<meta "
      "name=\"referrer\" "
      "content=\"no-referrer\"/>\n<meta name=\"color-scheme\" content=\"light dark\"/>\n<title>{}: {}</title>\n",
      kPolicy, escapeMarkup(report.tool), escapeMarkup(headline(report)));
  html += fmt::format("<style>\n{}</style>\n</head>\n<body>\n<main>\n", kReportPageCss);
  html += header(report, run) + textList(report.warnings, "warnings") + baselineSection(report) + overview(report) +
          toolbar(report);
  for (std::size_t s = 0; s < report.scenes.size(); ++s) html += sceneSection(report.scenes[s], s);
  html += "</main>\n<dialog id=\"viewer\"><div class=\"viewer-bar\"><b id=\"viewer-title\"></b><span "
          "id=\"viewer-tabs\"></span><a id=\"viewer-open\" target=\"_blank\" rel=\"noopener\">Open the file</a><button "
          "type=\"button\" id=\"viewer-close\">Close</button></div><img id=\"viewer-image\" alt=\"\"/></dialog>\n";
  return html + fmt::format("<script>\n{}</script>\n</body>\n</html>\n", kReportPageJs);
}

} // namespace parity::compare
