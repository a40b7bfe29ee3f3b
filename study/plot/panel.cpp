#include "study/plot/panel.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace parity::plot {

namespace {

constexpr Rgb kPanelInk{40, 42, 48}, kPanelPale{120, 124, 132}, kContour{70, 74, 82}, kMark{20, 110, 60},
    kPanelPaper{255, 255, 255};

void drawMap(Canvas& canvas, const Panel& p) {
  const auto left = static_cast<int>(p.x), top = static_cast<int>(p.y), width = static_cast<int>(p.width),
             height = static_cast<int>(p.height);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      canvas.fill(left + i, top + j, 1, 1, p.scale.of(p.value(1 - (j + 0.5) / height, (i + 0.5) / width)));
}

// Marching squares over a grid of cells, each crossed by one straight line at most (of a saddle, two corners' own).
void drawContour(Canvas& canvas, const Panel& p, const std::vector<double>& grid, int cells, double level,
                 double thickness) {
  // What is the level but for rounding lies on one side of it: a plain of zeros has no line around each cell.
  const double least = 1e-6 * (p.scale.high - p.scale.low);
  const auto at = [&](int i, int j) {
    const double above = grid[static_cast<std::size_t>(j * (cells + 1) + i)] - level;
    return std::abs(above) < least ? least : above;
  };
  const double sx = p.width / cells, sy = p.height / cells;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const double corner[4] = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      constexpr double kX[] = {0, 1, 1, 0}, kY[] = {0, 0, 1, 1};
      std::vector<std::pair<double, double>> ends;
      for (int k = 0; k < 4; ++k) {
        const int next = (k + 1) % 4;
        if ((corner[k] < 0) == (corner[next] < 0)) continue;
        const double t = corner[k] / (corner[k] - corner[next]);
        ends.emplace_back(p.x + (i + kX[k] + t * (kX[next] - kX[k])) * sx,
                          p.y + p.height - (j + kY[k] + t * (kY[next] - kY[k])) * sy);
      }
      for (std::size_t k = 0; k + 1 < ends.size(); k += 2)
        canvas.line(ends[k].first, ends[k].second, ends[k + 1].first, ends[k + 1].second, thickness, kContour);
    }
}

void drawContours(Canvas& canvas, const Panel& p) {
  constexpr int kCells = 96;
  std::vector<double> grid;
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i)
      grid.push_back(p.value(static_cast<double>(j) / kCells, static_cast<double>(i) / kCells));
  for (const double level : p.scale.ticks())
    drawContour(canvas, p, grid, kCells, level, std::abs(level) < 1e-12 ? 1.4 : 0.7);
}

void drawAxes(Canvas& canvas, const Panel& p) {
  const double bottom = p.y + p.height, right = p.x + p.width;
  canvas.frame(p.x, p.y, p.width, p.height, kPanelInk);
  for (int k = 0; k <= 4; ++k) {
    const double x = p.x + k * p.width / 4, y = bottom - k * p.height / 4;
    canvas.line(x, bottom, x, bottom + 5, 1, kPanelInk);
    canvas.text(x, bottom + 20, fmt::format("{:g}", k / 4.0), Font::small, kPanelInk, Align::middle);
    canvas.line(p.x - 5, y, p.x, y, 1, kPanelInk);
    canvas.text(p.x - 9, y + 5, fmt::format("{:g}", k / 4.0), Font::small, kPanelInk, Align::right);
  }
  canvas.text(0.5 * (p.x + right), bottom + 38, "N.V", Font::small, kPanelPale, Align::middle);
  canvas.textUpwards(p.x - 44, 0.5 * (p.y + bottom), "roughness", Font::small, kPanelPale, Align::middle);
  canvas.text(p.x, p.y - 10, p.caption, Font::body, kPanelInk);
}

void drawScale(Canvas& canvas, const Panel& p) {
  constexpr int kScaleBarWidth = 14;
  const auto left = static_cast<int>(p.x + p.width + 16), top = static_cast<int>(p.y),
             height = static_cast<int>(p.height);
  for (int j = 0; j < height; ++j)
    canvas.fill(left, top + j, kScaleBarWidth, 1,
                p.scale.of(p.scale.high - (j + 0.5) / height * (p.scale.high - p.scale.low)));
  canvas.frame(left, top, kScaleBarWidth, height, kPanelInk);
  for (const double tick : p.scale.ticks()) {
    const double y = p.y + p.height * (p.scale.high - tick) / (p.scale.high - p.scale.low);
    canvas.line(left + kScaleBarWidth, y, left + kScaleBarWidth + 4, y, 1, kPanelInk);
    const std::string sign = p.scale.isSigned && tick > 1e-12 ? "+" : "";
    canvas.text(left + kScaleBarWidth + 8, y + 5, sign + fmt::format("{:.4g}", std::abs(tick) < 1e-12 ? 0 : tick),
                Font::small, kPanelInk);
  }
}

// Marks of about the same height share their letters.
void drawMarks(Canvas& canvas, const Panel& p) {
  constexpr double kLineHeight = 17;
  std::vector<std::pair<double, std::string>> marks = p.marks;
  std::ranges::stable_sort(marks, {}, &std::pair<double, std::string>::first);
  std::vector<std::pair<double, std::string>> labels;
  for (const auto& [roughness, letters] : marks) {
    const double y = p.y + p.height * (1 - roughness);
    for (int dash = 0; 9 * dash < p.width; ++dash) {
      const double x = p.x + 9 * dash;
      canvas.line(x, y, std::min(x + 4, p.x + p.width), y, 1.3, kMark);
    }
    if (!labels.empty() && labels.back().first - y < kLineHeight)
      labels.back().second += " " + letters;
    else
      labels.emplace_back(y, letters);
  }
  for (const auto& [y, letters] : labels) {
    const double width = Canvas::widthOf(letters, Font::small), right = p.x + p.width - 4;
    canvas.fill(static_cast<int>(right - width - 6), static_cast<int>(y - 9), static_cast<int>(width + 8), 18,
                kPanelPaper);
    canvas.text(right - 2, y + 5, letters, Font::small, kMark, Align::right);
  }
}

} // namespace

void drawPanel(Canvas& canvas, const Panel& panel) {
  drawMap(canvas, panel);
  if (panel.contours) drawContours(canvas, panel);
  drawMarks(canvas, panel);
  drawAxes(canvas, panel);
  drawScale(canvas, panel);
}

} // namespace parity::plot
