#include "sweep/pareto_svg.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "compare/text.h"
#include "sweep/statistics.h"

namespace parity::sweep {

namespace {

using compare::escapeMarkup;

constexpr double kWidth = 760, kHeight = 420, kLeft = 70, kRight = 20, kTop = 16, kBottom = 46;

struct Dot {
  const VariantResult* variant;
  double time, error;
  bool dominated;
};

// Decades with room at both ends, as a scale from values to places.
class LogAxis {
public:
  LogAxis(double least, double most, double from, double to) : m_from(from), m_to(to) {
    const double margin = 0.06 * std::max(std::log10(most / least), 0.3);
    m_low = std::log10(least) - margin;
    m_high = std::log10(most) + margin;
  }
  double at(double value) const { return m_from + (std::log10(value) - m_low) / (m_high - m_low) * (m_to - m_from); }
  // Round numbers of each decade that lie on it; of many decades only 1.
  std::vector<double> ticks() const {
    std::vector<double> ticks;
    for (int decade = static_cast<int>(std::floor(m_low)); decade <= static_cast<int>(std::ceil(m_high)); ++decade)
      for (const double digit : {1., 1.5, 2., 3., 5., 7.}) {
        if (digit > 1 && m_high - m_low > 2.5) continue;
        if ((digit == 1.5 || digit == 7) && m_high - m_low > 1) continue;
        const double value = digit * std::pow(10, decade);
        if (std::log10(value) >= m_low && std::log10(value) <= m_high) ticks.push_back(value);
      }
    return ticks;
  }

private:
  double m_low, m_high, m_from, m_to;
};

std::string axes(const LogAxis& x, const LogAxis& y, Stage stage, Against against, const std::string& figure) {
  std::string svg;
  for (const double tick : x.ticks())
    svg += fmt::format("<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text x=\"{0:.1f}\" "
                       "y=\"{3}\" text-anchor=\"middle\">{4:g}</text>",
                       x.at(tick), kTop, kHeight - kBottom, kHeight - kBottom + 16, tick);
  for (const double tick : y.ticks())
    svg += fmt::format("<line class=\"grid\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/><text x=\"{3}\" "
                       "y=\"{4:.1f}\" text-anchor=\"end\">{5:g}</text>",
                       kLeft, kWidth - kRight, y.at(tick), kLeft - 6, y.at(tick) + 4, tick);
  svg += fmt::format("<text class=\"title\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                     0.5 * (kLeft + kWidth - kRight), kHeight - 10,
                     stage == Stage::shading ? "device time of shading, ms" : "wall time of preparation, ms");
  svg +=
      fmt::format("<text class=\"title\" transform=\"translate(16,{}) rotate(-90)\" text-anchor=\"middle\">{} against "
                  "{}</text>",
                  0.5 * (kTop + kHeight - kBottom), escapeMarkup(figure),
                  against == Against::truth ? "the reference" : "the high-end default");
  return svg;
}

// Puts labels below those that they would cover.
class Labels {
public:
  double place(double x, double y, const std::string& text) {
    constexpr double kCharacter = 6, kLine = 12;
    Box box{x, x + kCharacter * static_cast<double>(text.size()), y};
    const auto covers = [&](const Box& other) {
      return other.left < box.right && box.left < other.right && std::abs(other.y - box.y) < kLine;
    };
    while (std::ranges::any_of(m_boxes, covers)) box.y += kLine;
    m_boxes.push_back(box);
    return box.y;
  }

private:
  struct Box {
    double left, right, y;
  };
  std::vector<Box> m_boxes;
};

std::string tooltip(const Dot& dot) {
  const VariantResult& v = *dot.variant;
  std::string text =
      fmt::format("{}\n{:.3g} ms, {:.4g}{}\n", v.id(), dot.time, dot.error, dot.dominated ? ", dominated" : "");
  if (v.stage == Stage::shading)
    text += fmt::format("{:.0f} operations, {:.1f} fetches, {} samplers a pixel\n", v.cost.operations, v.cost.fetches,
                        v.cost.samplers);
  for (const auto& [knob, value] : v.knobs) text += fmt::format("{}: {}\n", knob, value);
  return text;
}

constexpr const char* kFileStyle =
    "<style>svg{background:#fff}text{font:11px sans-serif;fill:#667}.title{font-size:12px}.grid{stroke:#d8dce6}"
    "circle.highend{fill:#c2410c}circle.mobile{fill:#2563eb}circle.dominated{fill:#667;opacity:.45}"
    ".front{fill:none;stroke-width:1.5;stroke-dasharray:4 3}.front.highend{stroke:#c2410c}"
    ".front.mobile{stroke:#2563eb}</style>";

} // namespace

std::string paretoFile(const SceneSweep& scene, Stage stage, Against against, const std::string& figure) {
  std::string svg = paretoSvg(scene, stage, against, figure);
  if (svg.empty()) return svg;
  svg.insert(svg.find('>') + 1, kFileStyle);
  return svg.insert(4, " xmlns=\"http://www.w3.org/2000/svg\"");
}

std::string paretoSvg(const SceneSweep& scene, Stage stage, Against against, const std::string& figure) {
  const std::vector<bool> dominated = findDominated(scene, against, figure);
  std::vector<Dot> dots;
  for (std::size_t i = 0; i < scene.variants.size(); ++i) {
    const VariantResult& v = scene.variants[i];
    const double error = errorOf(v.whole, against, figure).value_or(0);
    if (v.stage == stage && timeOf(v) > 0 && error > 0 && std::isfinite(error))
      dots.push_back({&v, timeOf(v), error, dominated[i]});
  }
  if (dots.size() < 2) return "";
  const auto [leastTime, mostTime] = std::ranges::minmax(dots, {}, &Dot::time);
  const auto [leastError, mostError] = std::ranges::minmax(dots, {}, &Dot::error);
  const LogAxis x(leastTime.time, mostTime.time, kLeft, kWidth - kRight);
  const LogAxis y(leastError.error, mostError.error, kHeight - kBottom, kTop);
  std::string svg = fmt::format("<svg class=\"pareto\" viewBox=\"0 0 {} {}\" role=\"img\">", kWidth, kHeight) +
                    axes(x, y, stage, against, figure);
  std::ranges::sort(dots, [](const Dot& a, const Dot& b) { return a.time < b.time; });
  for (const char* path : {"highend", "mobile"}) {
    std::string line;
    for (const Dot& dot : dots)
      if (dot.variant->path == path && !dot.dominated)
        line += fmt::format("{:.1f},{:.1f} ", x.at(dot.time), y.at(dot.error));
    svg += fmt::format("<polyline class=\"front {}\" points=\"{}\"/>", path, line);
  }
  Labels labels;
  for (const bool grey : {true, false}) // grey ones behind
    for (const Dot& dot : dots) {
      if (dot.dominated != grey) continue;
      svg += fmt::format("<circle class=\"{}{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"><title>{}</title></circle>",
                         dot.variant->path, grey ? " dominated" : "", x.at(dot.time), y.at(dot.error),
                         dot.variant->name == "default" ? 7 : 5, escapeMarkup(tooltip(dot)));
      if (!grey)
        svg += fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x.at(dot.time) + 8,
                           labels.place(x.at(dot.time) + 8, y.at(dot.error) - 5, dot.variant->name),
                           escapeMarkup(dot.variant->name));
    }
  return svg + "</svg>\n";
}

} // namespace parity::sweep
