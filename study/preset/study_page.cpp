// A study of presets as one page without scripts.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/text.h"
#include "study/preset/preset_study.h"

namespace parity::presets {

namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>parity study-preset</title>
<style>
:root { color-scheme: light dark; --line: #8884; --bad: #c0392b; }
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 72rem; padding: 0 1rem; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2.2rem; }
table { border-collapse: collapse; margin: .6rem 0; display: block; overflow-x: auto; }
th, td { border-bottom: 1px solid var(--line); padding: .25rem .8rem .25rem 0; text-align: right; }
th:first-child, td:first-child { text-align: left; white-space: nowrap; }
td.best { font-weight: 600; } td.bad { color: var(--bad); font-weight: 600; }
img { max-width: 100%; background: #fff; } p.note { max-width: 46rem; } code { font-size: .95em; }
</style></head><body>
)";

std::string text(const std::string& words) { return base::escapeMarkup(words); }

std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
  std::string all = "<tr>";
  for (const std::string& cell : cells) all += fmt::format("<{0}>{1}</{0}>", tag, cell);
  return all + "</tr>\n";
}

// Cells of numbers, the least of them in bold.
std::string numbers(const std::string& head, const std::vector<double>& values, int digits) {
  const double least = *std::ranges::min_element(values);
  std::string all = "<tr><td>" + head + "</td>";
  for (const double value : values)
    all +=
        fmt::format("<td{}>{:.{}f}</td>", values.size() > 1 && value == least ? " class=\"best\"" : "", value, digits);
  return all + "</tr>\n";
}

std::vector<std::string> headOf(const std::vector<const PresetStudy*>& studies, const std::string& first) {
  std::vector<std::string> cells = {first};
  for (const PresetStudy* study : studies) // the hash stands below
    cells.push_back("<code>" + text(study->preset.substr(0, study->preset.find('@'))) + "</code>");
  return cells;
}

template <typename Value>
std::vector<double> valuesOf(const std::vector<const PresetStudy*>& studies, const Value& value) {
  std::vector<double> values;
  for (const PresetStudy* study : studies) values.push_back(value(*study));
  return values;
}

std::string errorTables(const std::vector<const PresetStudy*>& studies) {
  std::string page = "<h2>Environment BRDF against the table</h2>\n<p class=\"note\">Absolute error of F0 A + B over "
                     "roughness and N.V from 0.05 to 1. The table is the high-end path's.</p>\n<table>" +
                     row(headOf(studies, "root mean square, largest"), "th");
  for (std::size_t i = 0; i < studies.front()->envBrdf.size(); ++i) {
    const EnvBrdfError& first = studies.front()->envBrdf[i];
    const std::string head = fmt::format("F0 = {}, {}", first.F0, first.half ? "fp16" : "fp32");
    page += numbers(head + ", rms", valuesOf(studies, [&](const PresetStudy& s) { return s.envBrdf.at(i).rms; }), 4);
    page += numbers(head + ", max", valuesOf(studies, [&](const PresetStudy& s) { return s.envBrdf.at(i).max; }), 4);
  }
  page += "</table>\n<h2>Light of one lamp against GGX</h2>\n<p class=\"note\">At F0 = 1 in fp32, against GGX with the "
          "light that scatters more than once. Energy: reflected "
          "light over the truth's, whose best is 1. Rms: of the difference, over the truth's own.</p>\n<table>" +
          row(headOf(studies, "energy, root mean square"), "th");
  for (std::size_t i = 0; i < studies.front()->lobe.size(); ++i) {
    std::vector<std::string> cells = {fmt::format("roughness {:.3g}, energy", studies.front()->lobe[i].roughness)};
    for (const PresetStudy* study : studies) cells.push_back(fmt::format("{:.2f}", study->lobe.at(i).energy));
    page += row(cells);
    page += numbers(fmt::format("roughness {:.3g}, rms", studies.front()->lobe[i].roughness),
                    valuesOf(studies, [&](const PresetStudy& s) { return s.lobe.at(i).rms; }), 3);
  }
  return page + "</table>\n";
}

std::string sceneTables(const std::vector<const PresetStudy*>& studies, const StudyRequest& request) {
  std::string page;
  for (std::size_t i = 0; i < studies.front()->scenes.size(); ++i) {
    const SceneFigures& first = studies.front()->scenes[i];
    page +=
        fmt::format("<h2>{} under {}</h2>\n<p class=\"note\">Mean FLIP of each material against the high-end path at "
                    "{}x{}; below it the cost of a pixel of the mobile path.</p>\n<table>{}",
                    text(request.scene), text(first.environment), request.size, request.size,
                    row(headOf(studies, "material"), "th"));
    for (std::size_t m = 0; m < first.flip.size(); ++m)
      page += numbers(text(first.flip[m].first),
                      valuesOf(studies, [&](const PresetStudy& s) { return s.scenes.at(i).flip.at(m).second; }), 4);
    page += numbers("<b>mean of the materials</b>",
                    valuesOf(studies, [&](const PresetStudy& s) { return s.scenes.at(i).meanFlip; }), 4);
    const auto cost = [&](const char* name, std::uint64_t SceneFigures::*member) {
      page += numbers(
          name, valuesOf(studies, [&](const PresetStudy& s) { return static_cast<double>(s.scenes.at(i).*member); }),
          0);
    };
    cost("operations", &SceneFigures::operations);
    cost("of them in fp16", &SceneFigures::fp16);
    cost("texture fetches", &SceneFigures::fetches);
    cost("samplers", &SceneFigures::samplers);
    page += "</table>\n";
  }
  return page;
}

std::string stressTable(const PresetStudy& study) {
  std::string page = "<table>" + row({"function", "precision", "points", "NaN", "infinite", "negative", "least",
                                      "greatest", "first input with NaN or infinity"},
                                     "th");
  for (const FunctionStress& s : study.stress) {
    const auto count = [](std::uint64_t n) { return n > 0 ? fmt::format("<b>{}</b>", n) : std::string("0"); };
    page +=
        row({text(s.function), s.half ? "fp16" : "fp32", std::to_string(s.points), count(s.nan), count(s.infinite),
             count(s.negative), fmt::format("{:.4g}", s.least), fmt::format("{:.4g}", s.greatest), text(s.firstBad)});
  }
  return page + "</table>\n";
}

} // namespace

std::string toPage(const std::vector<PresetStudy>& studies, const StudyRequest& request) {
  std::string page = kHead;
  page += "<h1>Presets of the mobile path</h1>\n";
  std::vector<const PresetStudy*> whole;
  for (const PresetStudy& study : studies)
    if (study.failure.empty())
      whole.push_back(&study);
    else
      page += fmt::format("<p><code>{}</code> failed: {}</p>\n", text(study.preset), text(study.failure));
  if (!whole.empty()) page += errorTables(whole) + sceneTables(whole, request);
  for (std::size_t i = 0; i < studies.size(); ++i) {
    const PresetStudy& study = studies[i];
    if (!study.failure.empty()) continue;
    page += fmt::format("<h2><code>{}</code></h2>\n", text(study.preset));
    if (!study.functions.empty())
      page += fmt::format("<p>Starts from {}, defines {}.</p>\n", text(study.base), fmt::join(study.functions, ", "));
    page += stressTable(study);
    if (study.plot)
      page += fmt::format("<p><img src=\"{}\" alt=\"A, B and F0 A + B of the high-end table, of this preset, and the "
                          "difference\"></p>\n",
                          plotFile(i));
  }
  return page + "</body></html>\n";
}

} // namespace parity::presets
