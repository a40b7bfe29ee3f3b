#include "report/sample_report.h"

#include <algorithm>
#include <cmath>

#include "compare/verdict/budget.h"
#include "report/baseline.h"
#include "report/judge.h"

namespace parity::report {
namespace {

// Hands out the given names, then "plain 1", "plain 2", ...
class Namer {
public:
  explicit Namer(std::vector<std::string> names) : m_names(std::move(names)) {}
  std::string next(const std::string& fallback) { return m_next < m_names.size() ? m_names[m_next++] : fallback; }

private:
  std::vector<std::string> m_names;
  std::size_t m_next = 0;
};

MaterialResult makeJudged(const std::string& name, double mean, std::uint64_t pixels, double gain,
                          const std::string& scene, const std::string& file) {
  MaterialResult material = makeMaterial(name, mean, pixels, gain);
  if (pixels > 0)
    material.crops = {"images/" + file + "_ref.png", "images/" + file + "_test.png", "images/" + file + "_flip.png"};
  judgeMaterial(material, compare::defaultBudgets(), scene);
  return material;
}

// What no budget judges: a material too small for it, and one that is mostly white in both pictures.
void addUnjudged(ViewResult& view, const std::string& small, const std::string& clipped, const std::string& scene) {
  view.materials.push_back(makeJudged(small, 0.3, 12, 0.9, scene, "rivet"));
  MaterialResult white = makeJudged(clipped, 0.01, 5000, 1, scene, "panel");
  white.figures.clippedWhite = 0.8;
  judgeMaterial(white, compare::defaultBudgets(), scene);
  view.materials.push_back(std::move(white));
}

compare::Truth makeTruth(const compare::Figures& figures) {
  compare::Truth truth;
  if (figures.pixels == 0) return truth;
  compare::TruthFigures& held = truth.figures;
  held.test = figures;
  setFigure(held.test, "relmse", 0.04);
  held.reference = held.test;
  for (compare::Figure& figure : held.reference.values) figure.value /= 3;
  held.error = {0.011, 0.02, 1e-4, 420};
  return truth;
}

compare::TruthTerm makeTerm(const std::string& name, double truth) {
  const auto figures = [](double mean) {
    compare::Figures of;
    of.pixels = 90000;
    of.values = {{"flip.mean", mean}, {"relmse", mean / 10}};
    return of;
  };
  return {name, truth, 0.9 * truth, 0.5 * truth, figures(0.12), figures(0.34)};
}

} // namespace

compare::Figures makeFigures(double mean, std::uint64_t pixels, double gain) {
  compare::Figures figures;
  figures.pixels = pixels;
  if (pixels == 0) return figures;
  const double rmse = 0.3 * mean;
  figures.values = {{"flip.mean", mean},
                    {"flip.p50", 0.8 * mean},
                    {"flip.p95", std::min(1.0, 2.5 * mean)},
                    {"flip.max", std::min(1.0, 4 * mean)},
                    {"rmse", rmse},
                    {"psnr", mean > 0 ? -20 * std::log10(rmse) : INFINITY},
                    {"bias.ev", std::log2(gain)}};
  figures.clippedBlack = 0.01;
  figures.clippedWhite = 0.02;
  figures.referenceLuma = 0.42;
  figures.testLuma = 0.42 * gain;
  figures.referenceLuminance = 0.15;
  figures.testLuminance = 0.15 * gain;
  return figures;
}

void setFigure(compare::Figures& figures, const std::string& name, double value) {
  for (compare::Figure& figure : figures.values)
    if (figure.name == name) return void(figure.value = value);
  figures.values.push_back({name, value});
}

MaterialResult makeMaterial(const std::string& name, double mean, std::uint64_t pixels, double gain) {
  MaterialResult material;
  material.test = ViewResult().test;
  material.name = name;
  material.figures = makeFigures(mean, pixels, gain);
  return material;
}

Report makeSampleReport(const std::vector<std::string>& names) {
  Namer namer(names);
  Report report;
  report.version = "0.1.0";
  report.device = "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6";
  report.settings = {{"size", "1024x1024"}, {"samples", "1"},     {"preset", "ue4-2020"}, {"precision", "fp32"},
                     {"display", "sRGB"},   {"exposure", "0 EV"}, {"budgets", "built-in"}};

  report.conditions = {{"size", "1024x1024"},
                       {"materials", "all", compare::ActsOn::wholes},
                       {"mobile sky", "4", compare::ActsOn::figures, "4 SH coefficients"}};

  SceneResult lamp;
  lamp.name = namer.next("Lamp");
  lamp.source = "assets/Lamp.gltf";
  lamp.environment = "studio_small_05_1k.hdr";
  lamp.sun = "30,50,4";
  lamp.light = "sky light x 1,1,0.5";
  lamp.conditions = {{"environment", "0f3a", compare::ActsOn::figures, "studio_small_05_1k.hdr (content 0f3a)"},
                     {"environment rotation", "0"}};
  lamp.inputs = {"52c1f0a9b3de", "0f3a77c2e81b", "9d04be6617aa", ""};
  lamp.warnings = {"KHR_materials_subsurface is not supported: drawn opaque"};
  ViewResult front;
  front.name = "front";
  front.width = front.height = 1024;
  front.conditions = {{"camera", "automatic"}, {"field of view", "45"}};
  front.whole = makeFigures(0.06, 400000, 0.97);
  front.images = {"images/lamp_ref.png", "images/lamp_test.png", "images/lamp_flip.png"};
  lamp.passes = {{"surface", "samples", 800000, ""}, {"local lights", "lights", 0, "no local lights"}};
  front.materials.push_back(makeJudged(namer.next("Glass"), 0.03, 90000, 0.999, lamp.name, "glass"));
  front.materials.push_back(makeJudged(namer.next("Rough metal"), 0.27, 120000, 0.71, lamp.name, "metal"));
  front.materials.back().notes = {"fully rough", "9 samplers: one more than mobile has"};
  front.materials.back().terms = {{"sunDiffuse", 0, 0}, {"sunSpecular", 0.21, 0.11}, {"skySpecular", 0.34, 0.28}};
  front.materials.back().attribution = {0.27, {{"sunSpecular", 0.264}, {"skySpecular", 0.061}}};
  front.materials.push_back(makeJudged(namer.next("Shade, cloth"), 0.14, 60000, 1.08, lamp.name, "cloth"));
  front.materials.back().notes = {"nonmetal"};
  front.materials.back().notModelled = {"sheen"};
  settleMaterial(front.materials.back(), false);
  front.materials.push_back(makeJudged(namer.next("Screw"), 0, 0, 1, lamp.name, "screw"));
  front.materials.push_back(makeJudged(namer.next("Bulb"), 0, 900, 1, lamp.name, "bulb"));
  judgeWhole(front, compare::defaultBudgets(), lamp.name);
  lamp.views.push_back(front);

  ViewResult back = front;
  back.name = namer.next("back");
  back.materials[4].figures = {};
  back.materials[4].crops = {};
  judgeMaterial(back.materials[4], compare::defaultBudgets(), lamp.name);
  lamp.views.push_back(back);
  const PermutationCost dear{900, 0, 20, 11, 0}, cheap{100, 200, 10, 4, 0}, wide{400, 200, 30, 6, 1};
  lamp.permutations = {{"highend", "base colour", "none", 400000, 5, dear},
                       {"mobile", "base colour", "none", 300000, 4, cheap},
                       {"mobile", "base colour, normal", "some nonmetal", 100000, 6, wide}};
  report.scenes.push_back(lamp);

  SceneResult broken;
  broken.name = namer.next("Broken");
  broken.source = "assets/Broken.glb";
  broken.error = "assets/Broken.glb: chunk 0: length 4096 runs past the end of the file";
  broken.errorExitCode = 4;
  report.scenes.push_back(broken);
  const std::string rivet = namer.next("Rivet"), panel = namer.next("Lit panel");
  for (ViewResult& view : report.scenes[0].views) addUnjudged(view, rivet, panel, lamp.name);
  settleVerdicts(report);
  return report;
}

Report makeSampleReportSince(const std::vector<std::string>& names, const std::string& gone) {
  Report now = makeSampleReport(names), before = now;
  before.scenes[0].views[1].conditions[1].value = "44";
  ViewResult& front = before.scenes[0].views[0];
  front.materials[1].figures = makeFigures(0.20, 120000);
  for (ViewResult& view : before.scenes[0].views) view.materials.erase(view.materials.begin() + 4);
  front.materials.push_back(makeMaterial(gone, 0.1, 4000));

  compare::Budgets regressions = compare::defaultBudgets();
  regressions.materials[0].regress = {{compare::requireStatistic("flip.mean", "test"), 0.01, 0.03}};
  for (const std::size_t i : {2, 4}) judgeMaterial(now.scenes[0].views[0].materials[i], regressions, "Lamp");
  compareWithBaseline(now, before, {"old/report.json", {}, false});
  return now;
}

Report makeSampleReportWithTruth(const std::vector<std::string>& names) {
  Report report = makeSampleReport(names);
  report.settings.emplace_back("truth", "exact integrals, multiple scattering");
  report.conditions.push_back(
      {"truth", "multiple scattering", compare::ActsOn::truth, "exact integrals, multiple scattering"});
  for (ViewResult& view : report.scenes[0].views) {
    view.truth = makeTruth(view.whole);
    view.truth->images = {"images/lamp_truth.png", "images/lamp_hi.png", "images/lamp_mo.png"};
    for (MaterialResult& material : view.materials) {
      material.truth = makeTruth(material.figures);
      if (material.figures.pixels > 0) material.truth->images = {"images/t.png", "images/h.png", "images/m.png"};
    }
    compare::Truth& glass = *view.materials[0].truth;
    glass.figures.error.relmse = *glass.figures.reference.find("relmse") / 3; // of 4 that are within two errors
    glass.notes = {"high-end: within 2 standard errors"};
    view.materials[1].truth->terms = {makeTerm("sunSpecular", 0.2), makeTerm("skySpecular", 0.3)};
  }
  settleVerdicts(report);
  return report;
}

RunInfo makeSampleRun() {
  return {"2024-05-01T12:00:00Z", "parity report Lamp.gltf -o out", {{"load", 120.5}, {"render", 830}}, 0, {}};
}

MaterialCard makeCard(const std::string& material, const std::string& texture) {
  MaterialCard card;
  card.name = material;
  card.inputs = {{"baseColor", {0.8, 0.2, 0.1}, std::nullopt}, {"metallic", {1}, std::nullopt}};
  card.inputs.push_back(
      {"roughness", {0.5}, CardTexture{texture, texture, "g", 8, 4, 1, texture, {0.1}, {0.5}, {0.2}}});
  std::swap(card.inputs[0], card.inputs[2]);
  card.alphaMode = "mask";
  card.alphaCutoff = 0.5;
  card.f0 = {0.04, 0.04, 0.04};
  card.notModelled = {texture};
  return card;
}

WhatIf makeWhatIf(const std::string& preset, double mean) {
  WhatIf whatIf;
  whatIf.preset = preset;
  whatIf.figures = makeFigures(mean, 120000, 0.99);
  return whatIf;
}

DroppedLights makeDroppedLights(const std::string& light, const std::string& material, const std::string& more) {
  DroppedLights dropped{.lights = 5, .measured = {}, .notMeasured = {light + " 3", light + " 4"}};
  dropped.measured = {{light + " 1", "spot", 0, 2, {{material, 0.02}, {more, 0.031}}},
                      {light + " 2", "point", 3, 1, {{material, 0.25}}}};
  return dropped;
}

std::vector<std::string> hostileNames() {
  return {"<script>alert(1)</script>",
          "\"' onmouseover='alert(1)\" x=\"",
          "</script><img src=x onerror=alert(1)>",
          "javascript:alert(1)",
          "line\nbreak\tand\rreturn",
          "]]> &amp; & <!-- -->",
          std::string("bell\a zero\0 escape\x1b[31m", 23),
          "bad \xff\xc3 utf-8 \xed\xa0\x80",
          "日本語 Ünïcödé \xE2\x80\xAEreversed",
          "</style></title><svg onload=alert(1)>"};
}

} // namespace parity::report
