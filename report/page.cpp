#include "report/page.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/text/text.h"
#include "compare/verdict/wording.h"
#include "report/overview.h"
#include "report/scene_file.h"

namespace parity::report {
namespace {

constexpr std::size_t kMostRows = 50;

std::string tableRow(compare::Verdict verdict, const SceneResult& scene, std::string_view view,
                     std::string_view material, std::string_view reason) {
  return fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", nameOf(verdict),
                     base::escapeMarkup(scene.name), base::escapeMarkup(view), base::escapeMarkup(material),
                     base::escapeMarkup(reason));
}

// What failed or could not be judged, in the order of the report.
std::vector<std::string> rowsOverBudget(const Report& report) {
  std::vector<std::string> rows;
  for (const SceneResult& scene : report.scenes) {
    if (!scene.error.empty()) rows.push_back(tableRow(ownVerdict(scene), scene, "", "", scene.error));
    for (const ViewResult& view : scene.views) {
      if (view.wholeVerdict >= compare::Verdict::fail)
        rows.push_back(tableRow(view.wholeVerdict, scene, view.name, "whole image", view.reason));
      for (const MaterialResult& material : view.materials)
        if (material.verdict >= compare::Verdict::fail)
          rows.push_back(tableRow(material.verdict, scene, view.name, material.name, material.reason));
    }
  }
  return rows;
}

// For readers without scripts.
std::string plainPage(const Report& report) {
  std::string html = "<p>This page needs JavaScript; report.json holds all of its data.</p>\n";
  if (report.baseline && !report.baseline->error.empty())
    html += fmt::format("<p>{}</p>\n", base::escapeMarkup(report.baseline->error));
  if (const std::vector<std::string> rows = rowsOverBudget(report); !rows.empty()) {
    html += "<table>\n<thead><tr><th>verdict</th><th>scene</th><th>view</th><th>material</th><th>why</th></tr></thead>"
            "\n<tbody>\n";
    for (std::size_t i = 0; i < std::min(rows.size(), kMostRows); ++i) html += rows[i];
    html += "</tbody>\n</table>\n";
    if (rows.size() > kMostRows) html += fmt::format("<p>and {} more</p>\n", rows.size() - kMostRows);
  }
  return html;
}

} // namespace

void writeHtml(const Report& report, const RunInfo& run, const PageRequest& request, const base::TextSink& sink) {
  const std::string head = headJson(report), runJson = headJson(run);
  std::string overview;
  writeOverview(report, standingBy(request.earlier), [&](std::string_view piece) { overview += piece; });
  DataPage page{.tool = report.tool,
                .title = (report.suite.empty() ? "" : report.suite + ": ") + headline(report),
                .verdict = nameOf(report.verdict),
                .sub = report.device,
                .plain = plainPage(report),
                .blocks = {{"report", head}, {"overview", overview}, {"run", runJson}},
                .singleFile = request.singleFile,
                .files = request.files};
  if (!request.bench.json.empty()) page.blocks.push_back({"bench", request.bench.json});
  if (!request.bench.plots.empty()) page.blocks.push_back({"bench-plots", request.bench.plots});
  const std::string history = request.earlier && request.earlier->knowsAny() ? request.earlier->runsJson() : "";
  if (!history.empty()) page.blocks.push_back({"history", history});
  const SceneFiles scenes(report, run, request.earlier);
  if (request.singleFile)
    for (std::size_t i = 0; i < report.scenes.size(); ++i)
      page.made.push_back({SceneFiles::nameOf(i), [&scenes, i] { return scenes.object(i); }});
  writeHtml(page, sink);
}

std::string toHtml(const Report& report, const RunInfo& run, const PageRequest& request) {
  std::string html;
  writeHtml(report, run, request, [&](std::string_view piece) { html += piece; });
  return html;
}

} // namespace parity::report
