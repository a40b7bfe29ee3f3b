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
  Quantity table, approximate;
};

std::vector<Row> rowsOf(const TableBrdf& table, const ApproximateBrdf& approximate) {
  const auto once = [](const auto& brdf, double F0) -> Quantity {
    return [&brdf, F0](double roughness, double NoV) { return brdf.once(roughness, NoV, glm::dvec3(F0)).x; };
  };
  const auto multiple = [](const auto& brdf) -> Quantity {
    return [&brdf](double roughness, double NoV) { return brdf.multiple(roughness, NoV, glm::dvec3(1)).x; };
  };
  const auto describe = [&](double F0) {
    const Deviation d = deviationOf(table, approximate, F0);
    return fmt::format(", max {:.3f}, rms {:.3f}", d.max, d.rms);
  };
  return {{"A", "", [&](double r, double n) { return table.at(r, n).A; },
           [&](double r, double n) { return approximate.at(r, n).A; }},
          {"B", "", [&](double r, double n) { return table.at(r, n).B; },
           [&](double r, double n) { return approximate.at(r, n).B; }},
          {"F0 A + B, F0 = 0.04", describe(0.04), once(table, 0.04), once(approximate, 0.04)},
          {"F0 A + B, F0 = 1", describe(1), once(table, 1), once(approximate, 1)},
          {"multiple, F0 = 1", "", multiple(table), multiple(approximate)}};
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

void drawHead(Canvas& canvas, const TableBrdf& table, const ApproximateBrdf& approximate) {
  const highend::Options& o = table.options();
  const auto nameOf = [](const std::vector<std::string>& names, auto value) {
    return names[static_cast<std::size_t>(value)];
  };
  canvas.text(kLeft, 48,
              fmt::format("Environment BRDF: high-end's table and mobile's {}", approximate.options().preset),
              Font::title, kInk);
  canvas.text(kLeft, 80,
              fmt::format("table: {}, Fresnel {}, 128 x 128        mobile: {}, in double",
                          nameOf(highend::geometryTermNames(), o.model.geometryTerm),
                          nameOf(highend::fresnelNames(), o.model.fresnel), approximate.formula()),
              Font::body, kInk);
  canvas.text(kLeft, 104,
              fmt::format("Light scattered once, but for the last row: what scatters more than once (high-end: {}), "
                          "which is in no other. "
                          "Off-specular reads of the environment are no part of any.",
                          nameOf(highend::compensationNames(), o.compensation)),
              Font::small, kPale);
  const char* const heads[] = {"high-end: table", "mobile: approximation", "difference: mobile - high-end"};
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
  const Quantity difference = [&](double r, double n) { return row.approximate(r, n) - row.table(r, n); };
  const double y = kTop + index * kRow;
  const double most = std::max(greatestOf(row.table), greatestOf(row.approximate));
  // All but the last are shares of the light: 0 to 1.
  const ColorScale values = index < kRows - 1 ? scaleUpTo(1) : scaleUpTo(std::max(most, 1e-3));
  const auto place = [&](int column) { return kLeft + kAxisWidth + column * kColumn; };
  drawPanel(canvas, {.x = place(0),
                     .y = y,
                     .width = kWidth,
                     .height = kHeight,
                     .caption = row.name,
                     .value = row.table,
                     .scale = values,
                     .contours = false,
                     .marks = {}});
  drawPanel(canvas, {.x = place(1),
                     .y = y,
                     .width = kWidth,
                     .height = kHeight,
                     .caption = row.name,
                     .value = row.approximate,
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

void drawMaterials(Canvas& canvas, const std::vector<MaterialDeviation>& listed, std::size_t all,
                   const std::string& scene, double top) {
  struct Column {
    const char* head;
    double x;
    Align align;
  };
  constexpr std::array<Column, 9> kColumns = {{{"", 24, Align::right},
                                               {"material", 40, Align::left},
                                               {"form", 470, Align::left},
                                               {"roughness", 720, Align::right},
                                               {"F0", 900, Align::right},
                                               {"mean |dev|", 1040, Align::right},
                                               {"mean dev", 1170, Align::right},
                                               {"max |dev|, at N.V", 1360, Align::right},
                                               {"multiple: table, mobile", 1580, Align::right}}};
  canvas.text(kLeft, top,
              fmt::format("{}: {} of {} lit materials, by mean deviation of F0 A + F90 B (mean over N.V as a sphere "
                          "shows it; max from N.V = .05)",
                          scene, listed.size(), all),
              Font::bold, kInk);
  for (const Column& column : kColumns)
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
                                              fmt::format("{:.4f}, {:.4f}", m.tableMultiple, m.mobileMultiple)};
    for (std::size_t c = 0; c < cells.size(); ++c)
      canvas.text(kLeft + kColumns[c].x, y, cells[c], Font::body, kInk, kColumns[c].align);
  }
}

} // namespace

base::Image8 drawEnvBrdf(const TableBrdf& table, const ApproximateBrdf& approximate,
                         const std::vector<MaterialDeviation>& materials, const std::string& scene) {
  const std::vector<MaterialDeviation> listed = worstOf(materials);
  const double below = kTop + kRows * kRow;
  const int listHeight = listed.empty() ? 0 : static_cast<int>(listed.size() + 3) * kLine;
  Canvas canvas(static_cast<int>(2 * kLeft + 3 * kColumn), static_cast<int>(below) + listHeight, kPaper);
  drawHead(canvas, table, approximate);
  const std::vector<Row> rows = rowsOf(table, approximate);
  for (int index = 0; index < kRows; ++index) drawRow(canvas, rows[static_cast<std::size_t>(index)], index, listed);
  if (!listed.empty()) drawMaterials(canvas, listed, materials.size(), scene, below + 10);
  return canvas.image();
}

} // namespace parity::plot
