// Report folders for the page's tests in a browser: large ones, empty ones, and names that try to break out.
//   make_reports FOLDER: FOLDER/many, huge, evil, broken, states, empty
#include <cmath>
#include <filesystem>
#include <iostream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/image/image_io.h"
#include "compare/verdict/budget.h"
#include "job/report_folder.h"
#include "report/judge.h"
#include "report/sample_report.h"

namespace {

using namespace parity;
namespace fs = std::filesystem;

constexpr int kSide = 128;

// A disc, so that pictures of different tints are told apart.
base::Image8 disc(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  base::Image8 image(kSide, kSide, 3);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool inside = std::hypot(x - kSide / 2, y - kSide / 2) < kSide * 0.4;
      std::uint8_t* pixel = image.at(x, y);
      pixel[0] = inside ? red : 118;
      pixel[1] = inside ? green : 118;
      pixel[2] = inside ? blue : 118;
    }
  return image;
}

report::ImageSet writePictures(const fs::path& folder, const std::string& prefix, int tint) {
  const report::ImageSet images = {"images/" + prefix + "_highend.png", "images/" + prefix + "_mobile.png",
                                   "images/" + prefix + "_flip.png"};
  const auto shade = [&](int base) { return static_cast<std::uint8_t>(base + 37 * tint % 60); };
  base::writeImage8(folder / images.reference, disc(shade(180), 140, shade(60)));
  base::writeImage8(folder / images.test, disc(shade(150), 120, shade(50)));
  base::writeImage8(folder / images.flip, disc(shade(90), 20, 90));
  return images;
}

report::Report emptyReport() {
  report::Report report;
  report.version = "0.1.0";
  report.device = "a test's device";
  report.settings = {{"size", "128x128"}, {"display", "sRGB"}};
  return report;
}

report::ViewResult makeView(const std::string& name) {
  report::ViewResult view;
  view.name = name;
  view.width = view.height = kSide;
  view.whole = report::makeFigures(0.05, kSide * kSide / 2, 0.95);
  return view;
}

// As many terms, notes and causes as a real report of materials over budget has.
void addEvidence(report::MaterialResult& material) {
  for (const char* term : {"sunDiffuse", "sunSpecular", "localDiffuse", "localSpecular", "skyDiffuse", "skySpecular"})
    material.terms.push_back({term, 0.2, 0.15});
  material.notes = {"nonmetal: mobile uses EnvBRDFApproxNonmetal"};
  const double flip = material.figures.find("flip.mean").value_or(0);
  if (material.verdict == compare::Verdict::fail || flip > 0.2)
    material.attribution = {flip, {{"skySpecular", flip / 4}, {"sunDiffuse", flip * 0.97}}};
}

void write(const fs::path& folder, report::Report& report, const std::string& commandLine,
           std::vector<std::string> incidents = {}) {
  report::settleVerdicts(report);
  report::RunInfo run;
  run.startedAt = "2026-01-02T03:04:05Z";
  run.commandLine = commandLine;
  run.incidents = std::move(incidents);
  run.timings = {{"surface", 12.5}, {"total", 1234}};
  job::writeReport(folder, report, run, {.bench = {}, .pictures = {}});
}

void writeGrid(const fs::path& folder, int scenes, int viewsEach, int materialsEach) {
  job::prepareReportFolder(folder, false);
  report::Report report = emptyReport();
  int number = 0;
  for (int s = 0; s < scenes; ++s) {
    report::SceneResult scene;
    scene.name = fmt::format("Scene {}", s + 1);
    scene.source = fmt::format("scene{}.glb", s + 1);
    scene.environment = scene.sun = "none";
    scene.passes = {{"surface", "samples", 1000, ""}, {"local lights", "lights", 0, "no local lights"}};
    for (int v = 0; v < viewsEach; ++v) {
      report::ViewResult view = makeView(fmt::format("view {}", v + 1));
      view.images = writePictures(folder, fmt::format("{}-s_{}-v", s, v), s * viewsEach + v);
      report::judgeWhole(view, compare::defaultBudgets(), scene.name);
      for (int m = 0; m < materialsEach; ++m, ++number) {
        const double mean = 0.3 * std::abs(std::sin(number * 0.7));
        report::MaterialResult material =
            report::makeMaterial(fmt::format("Material {}", number + 1), mean, 500 + number, 1 - mean);
        material.crops = view.images;
        if (number % 10 == 3) material.notModelled = {"clearcoat", "sheen"};
        report::judgeMaterial(material, compare::defaultBudgets(), scene.name);
        addEvidence(material);
        view.materials.push_back(std::move(material));
      }
      view.droppedLights = report::makeDroppedLights("lamp", view.materials[0].name, view.materials[1].name);
      report::rankByEffect(*view.droppedLights);
      scene.views.push_back(std::move(view));
    }
    report.scenes.push_back(std::move(scene));
  }
  write(folder, report, "parity report scene1.glb -o out");
}

// As a browser may misread them; and those that break naive writers.
std::vector<std::string> evilNames() {
  std::vector<std::string> names = {"<script>window.broken = 1</script>",
                                    "</script><script>window.broken = 2</script>",
                                    "\"><img src=x onerror=\"window.broken = 3\">",
                                    "' onmouseover='window.broken = 4' x='",
                                    "${window.broken = 5} {{window.broken = 5}}",
                                    "javascript:window.broken = 6",
                                    "<!-- --><![CDATA[ ]]> &lt; &amp;#60;",
                                    "🎨🧑‍🎨 emoji",
                                    "خشب لامع",
                                    "\u202Etfel ot thgir\u202C",
                                    "line\nbreak\ttab \u2028 separator",
                                    std::string(10000, 'x'),
                                    "",
                                    "twice",
                                    "twice"};
  for (std::string& name : report::hostileNames()) names.push_back(std::move(name));
  return names;
}

void writeEvil(const fs::path& folder) {
  job::prepareReportFolder(folder, false);
  report::Report report = emptyReport();
  const std::string attack = "<img src=x onerror=\"window.broken = 7\"></script>";
  report.device = report.version = attack;
  report.warnings = {attack};
  report.settings.emplace_back(attack, attack);
  report::SceneResult scene;
  scene.name = scene.source = scene.environment = scene.sun = scene.light = attack;
  scene.warnings = {attack};
  scene.passes = {{attack, attack, 0, attack}};
  scene.permutations = {{attack, attack, attack, 1, 1, std::nullopt}};
  report::ViewResult view = makeView(attack);
  view.images = {"images/none_highend.png", "images/none_mobile.png", "images/none_flip.png"}; // none of them is there
  view.pixels = {"pixels/none.js", "pixels/none_terms.js"};
  report::judgeWhole(view, compare::defaultBudgets(), scene.name);
  for (const std::string& name : evilNames()) {
    report::MaterialResult material = report::makeMaterial(name, 0.3, 100, 0.8);
    material.crops = view.images;
    material.notes = {attack};
    report::judgeMaterial(material, compare::defaultBudgets(), scene.name);
    addEvidence(material);
    material.rule.reason = material.rule.owner = attack;
    view.materials.push_back(std::move(material));
  }
  view.droppedLights = report::makeDroppedLights(attack, view.materials[0].name, attack);
  scene.views.push_back(std::move(view));
  report::SceneResult failed;
  failed.name = failed.source = attack;
  failed.error = attack;
  failed.errorExitCode = 4;
  report.scenes = {std::move(scene), std::move(failed)};
  write(folder, report, "parity report '" + attack + "' -o out",
        {"a scene: flaky crash: a worker crashed with " + attack});
}

// Figures that are not finite, materials that nothing shows, files that are missing.
void writeBroken(const fs::path& folder) {
  job::prepareReportFolder(folder, false);
  report::Report report = emptyReport();
  report::SceneResult scene;
  scene.name = "Broken";
  scene.source = "broken.glb";
  scene.environment = scene.sun = "none";
  report::ViewResult view = makeView("auto");
  view.images = {"images/none_highend.png", "images/none_mobile.png", "images/none_flip.png"};
  view.pixels = {"pixels/none.js", ""};
  report::judgeWhole(view, compare::defaultBudgets(), scene.name);
  report::MaterialResult nan = report::makeMaterial("not a number", 0.1, 500, 1);
  for (compare::Figure& figure : nan.figures.values) figure.value = std::nan("");
  nan.figures.nonFinite = 50;
  nan.figures.referenceLuma = nan.figures.referenceLuminance = INFINITY;
  nan.figures.clippedBlack = nan.figures.clippedWhite = std::nan("");
  report::MaterialResult same = report::makeMaterial("identical", 0, 500, 1);
  report::MaterialResult unseen = report::makeMaterial("not seen", 0, 0, 1);
  for (report::MaterialResult* material : {&nan, &same, &unseen}) {
    report::judgeMaterial(*material, compare::defaultBudgets(), scene.name);
    view.materials.push_back(*material);
  }
  scene.views.push_back(std::move(view));
  report.scenes.push_back(std::move(scene));
  write(folder, report, "");
}

// What is neither a plain pass nor a plain failure: a material too small, one clipped almost everywhere and one in
// part, one of which no path models every part, one too dark for its exposure to be judged.
void writeStates(const fs::path& folder) {
  job::prepareReportFolder(folder, false);
  report::Report report = emptyReport();
  report::SceneResult scene;
  scene.name = "States";
  scene.source = "states.glb";
  scene.environment = scene.sun = "none";
  report::ViewResult view = makeView("auto");
  view.images = writePictures(folder, "0-s_0-v", 0);
  view.whole.clippedBlack = 0.3;
  report::judgeWhole(view, compare::defaultBudgets(), scene.name);
  report::MaterialResult alike = report::makeMaterial("alike", 0.01, 500, 1);
  report::MaterialResult speck = report::makeMaterial("speck", 0.3, 12, 0.7);
  report::MaterialResult panel = report::makeMaterial("panel", 0.01, 500, 1);
  panel.figures.clippedWhite = 0.8;
  panel.figures.clippedBlack = 0;
  report::MaterialResult shade = report::makeMaterial("shade", 0.02, 500, 1);
  shade.figures.clippedWhite = 0.125;
  report::MaterialResult paint = report::makeMaterial("paint", 0.03, 500, 1);
  paint.notModelled = {"clearcoat", "sheen"};
  report::MaterialResult soot = report::makeMaterial("soot", 0.01, 500, 0.5); // 1 EV darker
  soot.figures.referenceLuminance = 0.001;
  soot.figures.testLuminance = 0.0005;
  for (report::MaterialResult* material : {&alike, &speck, &panel, &shade, &paint, &soot}) {
    material->crops = view.images;
    report::judgeMaterial(*material, compare::defaultBudgets(), scene.name);
    view.materials.push_back(*material);
  }
  scene.views.push_back(std::move(view));
  report.scenes.push_back(std::move(scene));
  write(folder, report, "parity report states.glb -o out");
}

void writeEmpty(const fs::path& folder) {
  job::prepareReportFolder(folder, false);
  report::Report report = emptyReport();
  write(folder, report, "parity report -o out");
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "make_reports FOLDER\n";
    return 64;
  }
  const fs::path folder = argv[1];
  try {
    writeGrid(folder / "many", 10, 5, 10);
    writeGrid(folder / "huge", 10, 5, 100);
    writeEvil(folder / "evil");
    writeBroken(folder / "broken");
    writeStates(folder / "states");
    writeEmpty(folder / "empty");
  } catch (const base::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
