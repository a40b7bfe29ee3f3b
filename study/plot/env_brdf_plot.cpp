#include "study/plot/env_brdf_plot.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/text/shown_text.h"

namespace parity::plot {

namespace {

constexpr int kSteps = 64;
constexpr double kF0s[] = {0.04, 1};

// Two of them and their difference.
std::string triple(double reference, double test) {
  return fmt::format(",{:.7g},{:.7g},{:.7g}", reference, test, test - reference);
}

} // namespace

std::string envBrdfCsv(const PlottedPair& pair) {
  const auto& [reference, test] = pair;
  std::string text = "roughness,NoV";
  for (const std::string name : {"A", "B", "once_F0_0.04", "multiple_F0_0.04", "once_F0_1", "multiple_F0_1"})
    text += fmt::format(",{1}_{0},{2}_{0},difference_{0}", name, reference.words.label, test.words.label);
  text += "\n";
  for (int j = 0; j <= kSteps; ++j)
    for (int i = 0; i <= kSteps; ++i) {
      const double roughness = static_cast<double>(j) / kSteps, NoV = static_cast<double>(i) / kSteps;
      const auto of = reference.brdf->at(roughness, NoV), by = test.brdf->at(roughness, NoV);
      text += fmt::format("{:.7g},{:.7g}", roughness, NoV) + triple(of.A, by.A) + triple(of.B, by.B);
      for (const double F0 : kF0s) {
        const glm::dvec3 color(F0);
        text += triple(reference.brdf->once(roughness, NoV, color).x, test.brdf->once(roughness, NoV, color).x);
        text += triple(reference.brdf->multiple(roughness, NoV, color).x, test.brdf->multiple(roughness, NoV, color).x);
      }
      text += "\n";
    }
  return text;
}

std::string materialsCsv(const PlottedPair& pair, const std::vector<MaterialDeviation>& materials) {
  std::string text =
      fmt::format("material,form,points,roughness,roughness_least,roughness_greatest,F0_r,F0_g,F0_b,mean_absolute_"
                  "deviation,mean_deviation,max_absolute_deviation,NoV_of_max,{}_multiple,{}_multiple\n",
                  pair.reference.words.label, pair.test.words.label);
  for (const MaterialDeviation& m : materials)
    text +=
        fmt::format("{},{},{},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g}\n",
                    base::csvCell(m.name), m.form, m.points, m.roughness, m.least, m.greatest, m.F0.x, m.F0.y, m.F0.z,
                    m.mean, m.bias, m.max, m.NoVOfMax, m.referenceMultiple, m.testMultiple);
  return text;
}

std::string describe(const PlottedPair& pair, const std::vector<MaterialDeviation>& materials) {
  const paths::EnvBrdfWords &reference = pair.reference.words, &test = pair.test.words;
  std::string text =
      fmt::format("{} against the {}, single scattering, roughness and N.V from .05:\n", test.formula, reference.kind);
  for (const double F0 : kF0s) {
    const Deviation d = deviationOf(pair, F0);
    text += fmt::format("  F0 = {:<4g}  max {:.4f}  rms {:.4f}\n", F0, d.max, d.rms);
  }
  if (materials.empty()) return text;
  std::size_t width = 8;
  for (const MaterialDeviation& m : materials) width = std::max(width, std::min<std::size_t>(m.name.size(), 40));
  text += fmt::format("\n{:<{}}  {:<11} {:>9} {:>6} {:>10} {:>9} {:>9} {:>6}  {:>15} {:>8}\n", "material", width,
                      "form", "roughness", "F0.g", "mean |dev|", "mean dev", "max |dev|", "at N.V",
                      "multiple: " + reference.label, test.label);
  for (const MaterialDeviation& m : materials)
    text += fmt::format("{:<{}}  {:<11} {:>9.3f} {:>6.3f} {:>10.4f} {:>+9.4f} {:>9.4f} {:>6.2f}  {:>15.4f} {:>8.4f}\n",
                        m.name, width, m.form, m.roughness, m.F0.y, m.mean, m.bias, m.max, m.NoVOfMax,
                        m.referenceMultiple, m.testMultiple);
  return text;
}

} // namespace parity::plot
