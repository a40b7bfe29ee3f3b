// The pages of a sweep and of a stress run for the page's tests in a browser, without rendering; names try to break
// out.
//   make_studies FOLDER: FOLDER/sweep, stress
#include <cmath>
#include <filesystem>
#include <iostream>

#include "base/error.h"
#include "base/file.h"
#include "study/stress/planted.h"
#include "study/stress/stress_run.h"
#include "study/sweep/samples.h"
#include "study/sweep/sweep_page.h"

namespace {

using namespace parity;
namespace fs = std::filesystem;

const std::string kAttack = "<img src=x onerror=\"window.broken = 1\"></script></svg>";

sweep::SweepReport makeSweep(double scale) {
  sweep::SweepReport report;
  report.version = "0.1.0";
  report.startedAt = "2026-01-02T03:04:05Z";
  report.commandLine = "parity bench " + kAttack;
  report.machine = {"a processor", kAttack, "a driver", "cpu", "AVX2", 2};
  report.rounds = 9;
  for (const std::string& name : {std::string("spheres"), kAttack}) {
    std::vector<sweep::VariantResult> variants;
    for (int i = 0; i < 14; ++i) {
      const std::string knob = i == 0 ? "default" : i == 3 ? kAttack : "knob " + std::to_string(i);
      variants.push_back(sweep::makeVariant("highend", knob, scale * (8 + i % 5), 0.07 + 0.01 * (i % 7)));
      variants.push_back(sweep::makeVariant("mobile", knob, scale * (5 + i % 4), 0.1 + 0.02 * (i % 6)));
    }
    for (const int size : {16, 32}) {
      variants.push_back(sweep::makeVariant("highend", "lut-size " + std::to_string(size), 0, 0.2 - 0.001 * size));
      variants.back().stage = sweep::Stage::preparation;
      variants.back().times = {};
      variants.back().prepareMs = {0.9 * size, 1.0 * size, 1.1 * size};
    }
    variants.back().whole.first.flipMean = std::nan("");
    variants.push_back(sweep::makeVariant("mobile", "stored", 0, 0.3));
    variants.back().stage = sweep::Stage::storage;
    report.scenes.push_back(sweep::makeSceneSweep(name, std::move(variants)));
  }
  report.scenes.emplace_back();
  report.scenes.back().scene = "broken";
  report.scenes.back().failure = kAttack;
  return report;
}

void writeSweep(const fs::path& folder) {
  const sweep::SweepReport report = makeSweep(1);
  sweep::Conclusions conclusions = sweep::conclude(report, sweep::ErrorBudget{"flip.mean", 0.12});
  conclusions.ratios = sweep::compareSweeps(makeSweep(0.9), report);
  base::writeText(folder / "bench.json", sweep::toJson(report, conclusions));
  base::writeText(folder / "index.html", sweep::toPage(report, conclusions));
}

void writeStress(const fs::path& folder) {
  stress::Report report;
  report.version = "0.1.0";
  report.deviceName = kAttack;
  report.halfSkipped = "a device without shaderFloat16";
  report.points = 20000;
  report.functionsMs = 12345;
  for (const bool isHostile : {false, true}) {
    stress::FunctionCase function = tests::makePlanted();
    function.mapped(0, 1);
    if (isHostile) function.name = kAttack;
    report.functions.push_back(tests::run(function, [](double r, double c) { return r < 0.5 ? std::nan("") : r * c; }));
    report.functions.back().columns.push_back({.precision = stress::Precision::f16,
                                               .onDevice = true,
                                               .skipped = report.halfSkipped,
                                               .tally = stress::Tally(function)});
    for (const stress::Finding& finding : stress::findingsOf(report.functions.back()))
      report.findings.push_back(finding);
  }
  stress::Finding known;
  known.subject = "scene";
  known.place = "mobile fp16";
  known.fault = "not finite";
  known.expected = true;
  known.count = 3;
  known.region = known.reason = known.example = known.reproduce = kAttack;
  report.findings.push_back(known);
  report.scenes.push_back({.name = "scene", .wants = kAttack, .paths = {"highend"}, .findings = {}});
  base::writeText(folder / "stress.json", stress::formatJson(report));
  base::writeText(folder / "index.html", stress::formatPage(report));
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "make_studies FOLDER\n";
    return 64;
  }
  try {
    writeSweep(fs::path(argv[1]) / "sweep");
    writeStress(fs::path(argv[1]) / "stress");
  } catch (const base::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
