#include "bench/pareto_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace parity::bench {

namespace {

// Cheaper or as cheap, and nearer to the truth.
bool isDominated(const Row& row, const std::vector<Row>& rows) {
  return std::any_of(rows.begin(), rows.end(),
                     [&](const Row& other) { return other.ratio <= row.ratio && other.relMse < row.relMse; });
}

} // namespace

std::string paretoPicture(const std::vector<Row>& rows) {
  constexpr double kLeft = 70, kTop = 20, kWidth = 560, kHeight = 360;
  double least = 1e9, most = 0, fastest = 1e9, slowest = 0;
  for (const Row& row : rows) {
    least = std::min(least, row.relMse);
    most = std::max(most, row.relMse);
    fastest = std::min(fastest, row.ratio);
    slowest = std::max(slowest, row.ratio);
  }
  least /= 1.3, most *= 1.3, fastest -= 0.03, slowest += 0.03;
  const auto x = [&](double ratio) { return kLeft + (ratio - fastest) / (slowest - fastest) * kWidth; };
  const auto y = [&](double error) { return kTop + std::log(most / error) / std::log(most / least) * kHeight; };
  std::string svg =
      fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1160 {}\" font-family=\"sans-serif\" "
                  "font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                  kTop + kHeight + 50);
  for (double tick = 1e-6; tick < 10; tick *= std::sqrt(10.0))
    if (tick > least && tick < most)
      svg += fmt::format("<path d=\"M{} {:.1f}h{}\" stroke=\"#ddd\"/><text x=\"{}\" y=\"{:.1f}\" "
                         "text-anchor=\"end\">{:.1e}</text>\n",
                         kLeft, y(tick), kWidth, kLeft - 6, y(tick) + 4, tick);
  for (double tick = std::ceil(fastest * 10) / 10; tick < slowest; tick += 0.1)
    svg += fmt::format("<path d=\"M{:.1f} {}v{}\" stroke=\"#ddd\"/><text x=\"{:.1f}\" y=\"{}\" "
                       "text-anchor=\"middle\">{:.1f}</text>\n",
                       x(tick), kTop, kHeight, x(tick), kTop + kHeight + 16, tick);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">time of shading over the default's</text>\n",
                     kLeft + kWidth / 2, kTop + kHeight + 36);
  svg +=
      fmt::format("<text x=\"14\" y=\"{0}\" text-anchor=\"middle\" transform=\"rotate(-90 14 {0})\">relMSE against the "
                  "truth, median</text>\n",
                  kTop + kHeight / 2);
  std::vector<const Row*> sorted;
  for (const Row& row : rows) sorted.push_back(&row);
  std::sort(sorted.begin(), sorted.end(), [](const Row* a, const Row* b) { return a->relMse > b->relMse; });
  double lastLabel = 0; // labels stand in a column of their own, in the order of the points
  for (const Row* row : sorted) {
    const bool dominated = isDominated(*row, rows);
    const char* colour = row == &rows[0] ? "#c03020" : dominated ? "#999" : "#2060b0";
    const double label = std::max(lastLabel + 17, y(row->relMse) + 4);
    lastLabel = label;
    svg += fmt::format(
        "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"5\" fill=\"{2}\"/><path d=\"M{0:.1f} {1:.1f}L{3} {4:.1f}\" "
        "stroke=\"{2}\" stroke-width=\".4\"/><text x=\"{5}\" y=\"{6:.1f}\" fill=\"{2}\">{7}</text>\n",
        x(row->ratio), y(row->relMse), colour, kLeft + kWidth + 8, label - 4, kLeft + kWidth + 12, label, row->name);
  }
  return svg + "</svg>\n";
}

} // namespace parity::bench
