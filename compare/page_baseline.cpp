// What the page says of the baseline as a whole: what it is, what changed most since then, and what is gone.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "compare/page_parts.h"
#include "compare/text.h"
#include "compare/wording.h"

namespace parity::compare {
namespace {

constexpr const char* kFigure = "flip.mean"; // by which changes are ranked
constexpr double kLeastChange = 0.0005;      // what its three digits show
constexpr std::size_t kMostLines = 5;

struct Line {
  double change;
  std::string text;
};

// One line for each material of each view whose mean FLIP both reports have, and how many have none in the baseline.
struct Changes {
  std::vector<Line> lines;
  std::size_t newOnes = 0;
};

Changes collectChanges(const Report& report) {
  Changes changes;
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views)
      for (const MaterialResult& material : view.materials) {
        if (!material.baseline) continue;
        if (material.baseline->isNew) ++changes.newOnes;
        const auto& list = material.figures.interior.pixels > 0 ? material.baseline->interior : material.baseline->all;
        const auto found = std::ranges::find(list, kFigure, &FigureChange::metric);
        if (found == list.end() || std::isnan(found->change())) continue;
        changes.lines.push_back(
            {found->change(), fmt::format("{} (scene {}, view {}): {} to {}, {}", material.name, scene.name, view.name,
                                          formatFigure(kFigure, found->before), formatFigure(kFigure, found->now),
                                          formatChange(kFigure, found->change()))});
      }
  return changes;
}

// The largest changes towards the worse (sign 1) or the better (-1), the largest first.
std::string changeList(std::vector<Line> lines, int sign, const char* title) {
  std::erase_if(lines, [&](const Line& line) { return sign * line.change < kLeastChange; });
  if (lines.empty()) return {};
  std::ranges::stable_sort(lines, [&](const Line& a, const Line& b) { return sign * a.change > sign * b.change; });
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min(lines.size(), kMostLines); ++i) texts.push_back(lines[i].text);
  const std::string more = lines.size() > kMostLines ? fmt::format(", the {} largest", kMostLines) : "";
  return fmt::format("<h3>{}: {}{}</h3>\n{}\n", title, lines.size(), more, textList(texts, "changes"));
}

} // namespace

std::string baselineSection(const Report& report) {
  if (!report.baseline) return {};
  const BaselineSummary& baseline = *report.baseline;
  std::string html = "<section class=\"since\"><h2>Since the baseline</h2>\n<dl class=\"inline\">";
  html += definition("Baseline", baseline.source) + definition("Version", baseline.version) +
          definition("Device", baseline.device) + definition("In common", std::to_string(baseline.common));
  const Changes changes = collectChanges(report);
  if (changes.newOnes > 0) html += definition("New", std::to_string(changes.newOnes));
  html += "</dl>\n";
  if (!baseline.error.empty())
    html += fmt::format("<p class=\"error-box\"><b>Not used:</b> {}</p>\n", escapeMarkup(baseline.error));
  const std::string lists =
      changeList(changes.lines, 1, "Worse by mean FLIP") + changeList(changes.lines, -1, "Better by mean FLIP");
  html += lists;
  if (lists.empty() && !changes.lines.empty()) html += "<p>No material has another mean FLIP than then.</p>\n";
  std::vector<std::string> gone;
  for (const GoneRow& row : baseline.gone) gone.push_back(describeGone(row));
  return html + textList(gone, "warnings") + "</section>\n";
}

} // namespace parity::compare
