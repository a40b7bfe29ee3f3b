#include "study/plot/env_brdf_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "study/plot/panel.h"

namespace parity::plot {

namespace {

constexpr Rgb kInk{30, 32, 38}, kPale{110, 114, 122}, kPaper{255, 255, 255}, kStripe{244, 246, 249};
constexpr int kLeft = 40, kTop = 178, kRows = 5;
constexpr double kWidth = 372, kHeight = 268, kColumn = kAxisWidth + kWidth + kScaleWidth + 26,
                 kRow = kHeight + kAxisHeight + 40;
constexpr std::size_t kMostListed = 12;
constexpr int kLine = 26;

using Quantity = std::function<double(double roughness, double NoV)>;

struct Row {
  std::string name, note;
  Quantity reference, test;
};

std::vector<Row> rowsOf(const PlottedPair& pair) {
  const auto row = [&](const std::string& name, const std::string& note, const auto& valueOf) -> Row {
    const auto of = [&](const Plotted& path) -> Quantity {
      return [&brdf = *path.brdf, valueOf](double roughness, double NoV) { return valueOf(brdf, roughness, NoV); };
    };
    return {name, note, of(pair.reference), of(pair.test)};
  };
  using Brdf = paths::EnvBrdf;
  const auto once = [&](double F0) {
    const Deviation d = deviationOf(pair, F0);
    return row(fmt::format("F0 A + B, F0 = {:g}", F0), fmt::format(", max {:.3f}, rms {:.3f}", d.max, d.rms),
               [F0](const Brdf& brdf, double r, double n) { return brdf.once(r, n, glm::dvec3(F0)).x; });
  };
  return {row("A", "", [](const Brdf& brdf, double r, double n) { return brdf.at(r, n).A; }),
          row("B", "", [](const Brdf& brdf, double r, double n) { return brdf.at(r, n).B; }), once(0.04), once(1),
          row("multiple, F0 = 1", "",
              [](const Brdf& brdf, double r, double n) { return brdf.multiple(r, n, glm::dvec3(1)).x; })};
}

// Over the core, roughness and N.V from .05: a corner beyond it sets no scale.
double greatestOf(const Quantity& quantity) {
  double most = 0;
  for (int j = 0; j <= 48; ++j)
    for (int i = 0; i <= 48; ++i) most = std::max(most, std::abs(quantity(0.05 + 0.95 * j / 48, 0.05 + 0.95 * i / 48)));
  return most;
}

double meanF0(const MaterialDeviation& m) { return (m.F0.x + m.F0.y + m.F0.z) / 3; }

// By the greatest mean deviation, no more than are listed.
std::vector<MaterialDeviation> worstOf(std::vector<MaterialDeviation> materials) {
  std::ranges::stable_sort(materials, std::greater(), &MaterialDeviation::mean);
  if (materials.size() > kMostListed) materials.resize(kMostListed);
  return materials;
}

void drawHead(Canvas& canvas, const PlottedPair& pair) {
  const auto& [reference, test] = pair;
  const auto describe = [](const paths::EnvBrdfWords& words) {
    return fmt::format("{}: {}, {}", words.label, words.formula, words.numbers);
  };
  canvas.text(kLeft, 48,
              fmt::format("Environment BRDF: {}'s {} and {}'s {}", reference.title, reference.words.variant, test.title,
                          test.words.variant),
              Font::title, kInk);
  canvas.text(kLeft, 80, describe(reference.words) + "        " + describe(test.words), Font::body, kInk);
  canvas.text(kLeft, 104,
              fmt::format("All rows but the last: single scattering. Last row: only multiple scattering ({}: {}). "
                          "Off-specular reads of the environment are not included.",
                          reference.title, reference.words.multiple),
              Font::small, kPale);
  const std::string heads[] = {reference.title + ": " + reference.words.kind, test.title + ": " + test.words.kind,
                               fmt::format("difference: {} - {}", test.title, reference.title)};
  for (int c = 0; c < 3; ++c) canvas.text(kLeft + kAxisWidth + c * kColumn, kTop - 34, heads[c], Font::bold, kInk);
}

// Marks of the materials that the row is about: nonmetals at F0 = .04, metals at 1.
std::vector<std::pair<double, std::string>> marksOf(const std::vector<MaterialDeviation>& listed, int row) {
  std::vector<std::pair<double, std::string>> marks;
  for (std::size_t k = 0; k < listed.size(); ++k)
    if ((row == 2 && meanF0(listed[k]) < 0.2) || (row == 3 && meanF0(listed[k]) >= 0.2))
      marks.emplace_back(listed[k].roughness, std::to_string(k + 1));
  return marks;
}

void drawRow(Canvas& canvas, const Row& row, int index, const std::vector<MaterialDeviation>& listed) {
  const Quantity difference = [&](double r, double n) { return row.test(r, n) - row.reference(r, n); };
  const double y = kTop + index * kRow;
  const double most = std::max(greatestOf(row.reference), greatestOf(row.test));
  // All but the last are shares of the light: 0 to 1.
  const ColorScale values = index < kRows - 1 ? scaleUpTo(1) : scaleUpTo(std::max(most, 1e-3));
  const auto place = [&](int column) { return kLeft + kAxisWidth + column * kColumn; };
  drawPanel(canvas, {.x = place(0),
                     .y = y,
                     .width = kWidth,
                     .height = kHeight,
                     .caption = row.name,
                     .value = row.reference,
                     .scale = values,
                     .contours = false,
                     .marks = {}});
  drawPanel(canvas, {.x = place(1),
                     .y = y,
                     .width = kWidth,
                     .height = kHeight,
                     .caption = row.name,
                     .value = row.test,
                     .scale = values,
                     .contours = false,
                     .marks = {}});
  drawPanel(canvas, {.x = place(2),
                     .y = y,
                     .width = kWidth,
                     .height = kHeight,
                     .caption = row.name + row.note,
                     .value = difference,
                     .scale = scaleAbout0(std::max(greatestOf(difference), 1e-3)),
                     .contours = true,
                     .marks = marksOf(listed, index)});
}

void drawMaterials(Canvas& canvas, const PlottedPair& pair, const std::vector<MaterialDeviation>& listed,
                   std::size_t all, const std::string& scene, double top) {
  struct Column {
    std::string head;
    double x;
    Align align;
  };
  const std::array<Column, 9> columns = {
      {{"", 24, Align::right},
       {"material", 40, Align::left},
       {"form", 470, Align::left},
       {"roughness", 720, Align::right},
       {"F0", 900, Align::right},
       {"mean |dev|", 1040, Align::right},
       {"mean dev", 1170, Align::right},
       {"max |dev|, at N.V", 1360, Align::right},
       {fmt::format("multiple: {}, {}", pair.reference.words.label, pair.test.words.label), 1580, Align::right}}};
  canvas.text(kLeft, top,
              fmt::format("{}: {} of {} lit materials, by mean deviation of F0 A + F90 B (mean: N.V weighted as on a "
                          "sphere; max: from N.V = .05)",
                          scene, listed.size(), all),
              Font::bold, kInk);
  for (const Column& column : columns)
    canvas.text(kLeft + column.x, top + kLine + 4, column.head, Font::small, kPale, column.align);
  for (std::size_t k = 0; k < listed.size(); ++k) {
    const MaterialDeviation& m = listed[k];
    const double y = top + kLine * (static_cast<double>(k) + 2) + 4;
    if (k % 2 == 0) canvas.fill(kLeft - 8, static_cast<int>(y) - 18, 1604, kLine, kStripe);
    std::string name = m.name;
    while (name.size() > 4 && Canvas::widthOf(name, Font::body) > 410) name = name.substr(0, name.size() - 4) + "...";
    const std::string range = m.greatest - m.least > 5e-3
                                  ? fmt::format("{:.2f} ({:.2f} - {:.2f})", m.roughness, m.least, m.greatest)
                                  : fmt::format("{:.2f}", m.roughness);
    const std::array<std::string, 9> cells = {std::to_string(k + 1),
                                              name,
                                              m.form,
                                              range,
                                              fmt::format("{:.2f} {:.2f} {:.2f}", m.F0.x, m.F0.y, m.F0.z),
                                              fmt::format("{:.4f}", m.mean),
                                              fmt::format("{:+.4f}", m.bias),
                                              fmt::format("{:.4f} at {:.2f}", m.max, m.NoVOfMax),
                                              fmt::format("{:.4f}, {:.4f}", m.referenceMultiple, m.testMultiple)};
    for (std::size_t c = 0; c < cells.size(); ++c)
      canvas.text(kLeft + columns[c].x, y, cells[c], Font::body, kInk, columns[c].align);
  }
}

} // namespace

base::Image8 drawEnvBrdf(const PlottedPair& pair, const std::vector<MaterialDeviation>& materials,
                         const std::string& scene) {
  const std::vector<MaterialDeviation> listed = worstOf(materials);
  const double below = kTop + kRows * kRow;
  const int listHeight = listed.empty() ? 0 : static_cast<int>(listed.size() + 3) * kLine;
  Canvas canvas(static_cast<int>(2 * kLeft + 3 * kColumn), static_cast<int>(below) + listHeight, kPaper);
  drawHead(canvas, pair);
  const std::vector<Row> rows = rowsOf(pair);
  for (int index = 0; index < kRows; ++index) drawRow(canvas, rows[static_cast<std::size_t>(index)], index, listed);
  if (!listed.empty()) drawMaterials(canvas, pair, listed, materials.size(), scene, below + 10);
  return canvas.image();
}

} // namespace parity::plot
