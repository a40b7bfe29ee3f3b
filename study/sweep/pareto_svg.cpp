#include "study/sweep/pareto_svg.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/text/json_writer.h"
#include "base/text/text.h"
#include "report/wording.h"
#include "study/sweep/statistics.h"

namespace parity::sweep {

namespace {

using base::escapeMarkup;

constexpr double kWidth = 760, kHeight = 420, kLeft = 70, kRight = 20, kTop = 34, kBottom = 46;
constexpr double kCharacter = 6, kLine = 12; // of a text, about
constexpr std::array<const char*, 4> kColors = {"#c2410c", "#2563eb", "#7e22ce", "#0f766e"};
constexpr const char* kGrey = "#667";

double widthOf(const std::string& text) { return kCharacter * static_cast<double>(base::displayWidth(text)); }

// Logarithmic, with room at both ends: a scale from values to places.
class LogAxis {
public:
  LogAxis(double least, double most, double from, double to) : m_from(from), m_to(to) {
    const double margin = 0.06 * std::max(std::log10(most / least), 0.3);
    m_low = std::log10(least) - margin;
    m_high = std::log10(most) + margin;
  }
  double at(double value) const { return m_from + (std::log10(value) - m_low) / (m_high - m_low) * (m_to - m_from); }

  // Round numbers that lie on it: of each decade, or, within one decade, multiples of a round step.
  std::vector<double> ticks() const {
    std::vector<double> ticks;
    const double least = std::pow(10, m_low), most = std::pow(10, m_high);
    if (m_high - m_low > 1) {
      for (int decade = static_cast<int>(std::floor(m_low)); decade <= static_cast<int>(m_high); ++decade)
        for (const double digit : {1., 2., 5.})
          if (digit == 1 || m_high - m_low <= 2.5) ticks.push_back(digit * std::pow(10, decade));
    } else {
      const double decade = std::pow(10, std::floor(std::log10((most - least) / 4)));
      const double digits = (most - least) / 4 / decade;
      const double step = decade * (digits < 2 ? 1 : digits < 5 ? 2 : 5);
      for (double i = std::ceil(least / step); i * step <= most; ++i) ticks.push_back(i * step);
    }
    std::erase_if(ticks, [&](double value) { return value < least || value > most; });
    return ticks;
  }

private:
  double m_low, m_high, m_from, m_to;
};

std::string drawAxes(const LogAxis& x, const LogAxis& y, const ParetoPlot& plot) {
  std::string svg;
  for (const double tick : x.ticks())
    svg += fmt::format("<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\" stroke=\"#d8dce6\"/><text x=\"{0:.1f}\" y=\"{3}\" "
                       "text-anchor=\"middle\">{4:g}</text>",
                       x.at(tick), kTop, kHeight - kBottom, kHeight - kBottom + 16, tick);
  for (const double tick : y.ticks())
    svg += fmt::format("<path class=\"grid\" d=\"M{0} {2:.1f}H{1}\" stroke=\"#d8dce6\"/><text x=\"{3}\" y=\"{4:.1f}\" "
                       "text-anchor=\"end\">{5:g}</text>",
                       kLeft, kWidth - kRight, y.at(tick), kLeft - 6, y.at(tick) + 4, tick);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" font-size=\"12\">{}{}</text>",
                     0.5 * (kLeft + kWidth - kRight), kHeight - 10, escapeMarkup(plot.timeTitle),
                     plot.timeUnit.empty() ? "" : ", " + escapeMarkup(plot.timeUnit));
  return svg + fmt::format("<text transform=\"translate(16,{}) rotate(-90)\" text-anchor=\"middle\" "
                           "font-size=\"12\">{}</text>",
                           0.5 * (kTop + kHeight - kBottom), escapeMarkup(plot.errorTitle));
}

// Which colour is which path.
std::string drawKey(const std::vector<std::string>& paths) {
  std::string svg = "<g class=\"key\">";
  double x = kLeft + 6;
  const auto entry = [&](const std::string& text, const char* color, const char* opacity) {
    svg += fmt::format("<circle cx=\"{}\" cy=\"16\" r=\"5\" fill=\"{}\"{}/><text x=\"{}\" y=\"20\">{}</text>", x, color,
                       opacity, x + 10, escapeMarkup(text));
    x += widthOf(text) + 34;
  };
  for (std::size_t p = 0; p < paths.size(); ++p) entry(paths[p], kColors[p % kColors.size()], "");
  entry("dominated", kGrey, " opacity=\".45\"");
  return svg + "</g>";
}

// Puts the names of dots beside them, where they cover neither dots nor one another.
class Labels {
public:
  void addDot(double x, double y) { m_taken.push_back({x - 6, x + 6, y - 6, y + 6}); }

  std::string draw(double x, double y, const std::string& name, std::size_t path) {
    const double width = widthOf(name);
    const auto boxAt = [&](int step) -> Box { // right and left: beside it, then ever farther above and below
      const int lines = (step / 2 + 1) / 2 * (step / 2 % 2 == 1 ? 1 : -1);
      const double left = step % 2 == 1 ? x - 8 - width : x + 8, top = y - 11 + kLine * lines;
      return {left, left + width, top, top + kLine};
    };
    int step = 0;
    while (step < kSteps && !isFree(boxAt(step))) ++step;
    if (step == kSteps) step = boxAt(0).right < kWidth ? 0 : 1;
    const Box box = boxAt(step);
    const bool isLeft = step % 2 == 1;
    m_taken.push_back(box);
    return fmt::format("<text class=\"label path-{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", path,
                       isLeft ? box.right : box.left, box.bottom - 3, isLeft ? "end" : "start", escapeMarkup(name));
  }

private:
  struct Box {
    double left, right, top, bottom;
  };
  static constexpr int kSteps = 40;

  bool isFree(const Box& box) const {
    const auto covers = [&](const Box& other) {
      return other.left < box.right && box.left < other.right && other.top < box.bottom && box.top < other.bottom;
    };
    return box.left > kLeft && box.right < kWidth && box.top > kTop && box.bottom < kHeight - kBottom &&
           std::ranges::none_of(m_taken, covers);
  }

  std::vector<Box> m_taken;
};

std::string tooltip(const ParetoDot& dot, const std::string& unit) {
  return fmt::format("{}: {}\n{:.3g}{}{}, {:.4g}{}{}{}", dot.path, dot.name, dot.time, unit.empty() ? "" : " ", unit,
                     dot.error, dot.dominated ? ", dominated" : "", dot.details.empty() ? "" : "\n", dot.details);
}

std::string detailsOf(const VariantResult& v) {
  const Spread time = spreadOf(v.stage == Stage::shading ? v.times.deviceMs : v.prepareMs);
  std::string text = fmt::format("quartiles {:.3g} to {:.3g} ms\n", time.low, time.high);
  if (v.stage == Stage::shading && v.cost.operations > 0)
    text += fmt::format("{:.0f} operations, {:.1f} fetches, {} samplers a pixel\n", v.cost.operations, v.cost.fetches,
                        v.cost.samplers);
  for (const auto& [knob, value] : v.knobs) text += fmt::format("{}: {}\n", knob, value);
  return text;
}

} // namespace

ParetoPlot plotOf(const SceneSweep& scene, Stage stage, Against against, const std::string& figure) {
  ParetoPlot plot{.timeTitle = stage == Stage::shading ? "device time of shading" : "wall time of preparation",
                  .timeUnit = "ms",
                  .errorTitle = figure + " against " +
                                (against == Against::truth || scene.variants.empty()
                                     ? "the truth"
                                     : fmt::format("the {} default", report::titleOf(scene.variants.front().path))),
                  .dots = {}};
  const std::vector<bool> dominated = findDominated(scene, against, figure);
  for (std::size_t i = 0; i < scene.variants.size(); ++i) {
    const VariantResult& v = scene.variants[i];
    const double error = errorOf(v.whole, against, figure).value_or(0);
    if (v.stage == stage && timeOf(v) > 0 && error > 0 && std::isfinite(error))
      plot.dots.push_back({v.path, v.name, detailsOf(v), timeOf(v), error, dominated[i]});
  }
  return plot;
}

std::string toSvg(ParetoPlot plot) {
  if (plot.dots.size() < 2) return "";
  const auto [leastTime, mostTime] = std::ranges::minmax(plot.dots, {}, &ParetoDot::time);
  const auto [leastError, mostError] = std::ranges::minmax(plot.dots, {}, &ParetoDot::error);
  const LogAxis x(leastTime.time, mostTime.time, kLeft, kWidth - kRight);
  const LogAxis y(leastError.error, mostError.error, kHeight - kBottom, kTop);
  std::vector<std::string> paths;
  for (const ParetoDot& dot : plot.dots)
    if (std::ranges::find(paths, dot.path) == paths.end()) paths.push_back(dot.path);
  std::string svg =
      fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"pareto\" viewBox=\"0 0 {} {}\" role=\"img\" "
                  "aria-label=\"{} settings: {} and {}\" font-family=\"sans-serif\" font-size=\"11\" fill=\"{}\">"
                  "<rect class=\"paper\" width=\"100%\" height=\"100%\" fill=\"#fff\"/>",
                  kWidth, kHeight, plot.dots.size(), escapeMarkup(plot.timeTitle), escapeMarkup(plot.errorTitle),
                  kGrey) +
      drawAxes(x, y, plot) + drawKey(paths);
  std::ranges::sort(plot.dots, {}, [](const ParetoDot& dot) { return std::pair(!dot.dominated, dot.time); });
  std::vector<std::string> fronts(paths.size());
  std::string dots, names;
  Labels labels;
  for (const ParetoDot& dot : plot.dots) labels.addDot(x.at(dot.time), y.at(dot.error));
  for (const ParetoDot& dot : plot.dots) { // grey ones behind
    const auto path = static_cast<std::size_t>(std::ranges::find(paths, dot.path) - paths.begin());
    const char* color = dot.dominated ? kGrey : kColors[path % kColors.size()];
    const double left = x.at(dot.time), top = y.at(dot.error);
    if (!dot.dominated) fronts[path] += fmt::format("{:.1f},{:.1f} ", left, top);
    dots += fmt::format("<circle class=\"dot path-{}{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"{}>"
                        "<title>{}</title></circle>",
                        path, dot.dominated ? " dominated" : "", left, top, dot.name == "default" ? 7 : 5, color,
                        dot.dominated ? " opacity=\".45\"" : "", escapeMarkup(tooltip(dot, plot.timeUnit)));
    if (!dot.dominated || plot.namesDominated) names += labels.draw(left, top, dot.name, path);
  }
  for (std::size_t p = 0; p < paths.size(); ++p)
    svg += fmt::format("<polyline class=\"front path-{}\" points=\"{}\" fill=\"none\" stroke=\"{}\" "
                       "stroke-width=\"1.5\" stroke-dasharray=\"4 3\"/>",
                       p, fronts[p], kColors[p % kColors.size()]);
  return svg + dots + "<g stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\">" + names + "</g></svg>\n";
}

std::string paretoJson(const SweepReport& report, Against against, const std::string& figure) {
  base::JsonWriter json(base::JsonLayout::compact);
  json.beginArray();
  for (const SceneSweep& scene : report.scenes) {
    json.beginArray();
    const auto write = [&](Stage stage, Against held) {
      const std::string svg = toSvg(plotOf(scene, stage, held, figure));
      if (svg.empty()) return;
      json.beginObject();
      json.key("stage").text(stageKinds()[static_cast<std::size_t>(stage)]);
      json.key("against").text(held == Against::truth ? "truth" : scene.variants.front().path);
      json.key("svg").text(svg);
      json.endObject();
    };
    write(Stage::shading, against);
    if (against == Against::truth) write(Stage::shading, Against::first);
    write(Stage::preparation, against);
    json.endArray();
  }
  json.endArray();
  return json.finish();
}

} // namespace parity::sweep
