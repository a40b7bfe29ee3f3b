#include "bench/synthetic_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/version.h"
#include "compare/verdict/budget.h"
#include "report/judge.h"
#include "report/trim.h"

namespace parity::bench {
namespace {

constexpr std::array kNouns = {"Chair", "Lamp", "Sofa", "Car", "Helmet", "Bottle", "Desk", "Robot", "Tree", "Tower"};
constexpr std::array kSurfaces = {"Chrome",  "Brushed steel", "Leather", "Oak",   "Red paint", "Rubber", "Glass",
                                  "Ceramic", "Linen",         "Gold",    "Stone", "Plastic",   "Skin",   "Asphalt"};
constexpr std::array kTerms = {"sunDiffuse",  "sunSpecular", "localDiffuse", "localSpecular", "lightmap", "skyDiffuse",
                               "skySpecular", "emissive",    "fog"};

// Numbers from 0 to 1 by a seed, the same on every machine (SplitMix64: Steele, Lea, Flood 2014).
class Numbers {
public:
  explicit Numbers(std::uint64_t seed)
      : m_state(mix(seed)) {} // mixed: else seeds that follow one another share numbers
  double next() { return static_cast<double>(mix(m_state += 0x9e3779b97f4a7c15u) >> 11) * 0x1p-53; }

private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t m_state;
};

std::string sceneName(int scene) {
  return fmt::format("{} {:05}", kNouns[static_cast<std::size_t>(scene) % kNouns.size()], scene);
}
std::string viewName(int view) { return fmt::format("view {}", view + 1); }

compare::Figures makeFigures(double mean, double ev, Numbers& numbers) {
  compare::Figures figures;
  figures.pixels = 2000 + static_cast<std::uint64_t>(60000 * numbers.next());
  const double rmse = 0.3 * mean * (0.9 + 0.2 * numbers.next());
  figures.values = {{"flip.mean", mean},
                    {"flip.p50", mean * (0.7 + 0.2 * numbers.next())},
                    {"flip.p95", std::min(1.0, mean * (1.8 + 0.6 * numbers.next()))},
                    {"flip.p99", std::min(1.0, mean * (2.4 + 0.6 * numbers.next()))},
                    {"flip.max", std::min(1.0, mean * (3 + numbers.next()))},
                    {"rmse", rmse},
                    {"psnr", -20 * std::log10(rmse)},
                    {"bias.ev", ev},
                    {"bias.dl", 10 * ev},
                    {"bias.da", numbers.next() - 0.5},
                    {"bias.db", numbers.next() - 0.5}};
  figures.referenceLuma = 0.3 + 0.4 * numbers.next();
  figures.testLuma = figures.referenceLuma * std::exp2(ev / 2.2);
  figures.referenceLuminance = 0.1 + 0.6 * numbers.next();
  figures.testLuminance = figures.referenceLuminance * std::exp2(ev);
  return figures;
}

report::StageResult makeEncoding(const compare::Figures& figures, Numbers& numbers) {
  report::StageResult stage{"encoding", "rgba8-gamma2", {}};
  stage.figures = figures;
  stage.figures.values = {{"flip.mean", 0.004 * numbers.next()},
                          {"flip.p95", 0.01},
                          {"flip.max", 0.02},
                          {"bias.ev", 0.001 * numbers.next()},
                          {"bias.dl", 0.01},
                          {"bias.da", 0.01},
                          {"bias.db", 0.01}};
  return stage;
}

report::ImageSet makeImages(const std::string& prefix) {
  return {prefix + "_highend.png", prefix + "_mobile.png", prefix + "_flip.png"};
}

report::MaterialResult makeMaterial(const std::string& name, const std::string& scene, const std::string& prefix,
                                    Numbers& numbers) {
  const double luck = numbers.next(); // a tenth is over .2, a fifth between .1 and .2
  const double mean = luck < 0.1 ? 0.2 + luck * 3 : luck < 0.3 ? 0.1 + (luck - 0.1) / 2 : 0.09 * numbers.next() + 0.002;
  report::MaterialResult material;
  material.name = name;
  material.test = "mobile";
  material.figures = makeFigures(mean, 0.6 * (numbers.next() - 0.5), numbers);
  material.crops = makeImages(prefix);
  material.stages = {makeEncoding(material.figures, numbers)};
  for (const char* term : kTerms) {
    const double light = std::max(0.0, numbers.next() - 0.5);
    material.terms.push_back({term, light, light * (0.7 + 0.3 * numbers.next())});
  }
  report::judgeMaterial(material, compare::defaultBudgets(), scene);
  if (material.verdict < compare::Verdict::fail) return material;
  material.notes = {"nonmetal: mobile uses EnvBRDFApproxNonmetal"};
  compare::Attribution& attribution = material.attribution.emplace();
  attribution.flip = mean;
  for (const char* term : {"sunSpecular", "skyDiffuse", "skySpecular"})
    attribution.terms.push_back({term, mean * numbers.next()});
  return material;
}

report::MaterialCard makeCard(const std::string& name) {
  report::MaterialCard card;
  card.name = name;
  report::CardTexture texture;
  texture.name = texture.file = "textures/" + name + "_basecolor.png";
  texture.channels = "rgb";
  texture.width = texture.height = 2048;
  texture.picture = "images/texture-0123456789abcdef.png";
  texture.least = {0.01, 0.01, 0.01};
  texture.most = texture.mean = {0.8, 0.7, 0.6};
  card.inputs.push_back({"baseColor", {1, 1, 1}, texture});
  card.inputs.push_back({"metallic", {0}, std::nullopt});
  card.inputs.push_back({"roughness", {0.4}, std::nullopt});
  card.alphaMode = "opaque";
  card.f0 = {0.04, 0.04, 0.04};
  return card;
}

report::ViewResult makeView(int scene, int view, const std::vector<std::string>& materials, Numbers& numbers) {
  const std::string name = sceneName(scene),
                    prefix = fmt::format("images/{}-{}_{}-view_{}", scene, name, view, view + 1);
  report::ViewResult result;
  result.name = viewName(view);
  result.width = result.height = 512;
  result.whole = makeFigures(0.08 * numbers.next() + 0.002, 0.3 * (numbers.next() - 0.5), numbers);
  result.stages = {makeEncoding(result.whole, numbers)};
  result.images = makeImages(prefix);
  result.conditions = {{"camera", "automatic"}, {"field of view", "45"}};
  report::judgeWhole(result, compare::defaultBudgets(), name);
  for (std::size_t m = 0; m < materials.size(); ++m)
    result.materials.push_back(makeMaterial(materials[m], name, fmt::format("{}_m{}", prefix, m), numbers));
  return result;
}

report::SceneResult makeScene(int scene, const ReportSize& size) {
  Numbers numbers(static_cast<std::uint64_t>(scene) + 1);
  report::SceneResult result;
  result.name = sceneName(scene);
  result.source = "assets/" + result.name + ".glb";
  result.environment = "studio_small_05_1k.hdr";
  result.sun = "30,50,4";
  result.conditions = {{"environment", "0f3a", compare::ActsOn::figures, "studio_small_05_1k.hdr (content 0f3a)"},
                       {"environment rotation", "0"}};
  if (scene % 50 == 0) result.warnings = {"KHR_materials_subsurface is not supported: drawn opaque"};
  for (int pass = 0; pass < 29; ++pass) {
    const bool isSkipped = pass % 2 == 1;
    result.passes.push_back({fmt::format("pass {}", pass), "samples", isSkipped ? 0u : 100000u,
                             isSkipped ? "the scene has none of it" : ""});
  }
  result.permutations = {{"highend", "base colour", "none", 400000, 5, std::nullopt},
                         {"mobile", "base colour", "none", 400000, 4, std::nullopt}};
  std::vector<std::string> materials;
  for (int m = 0; m < size.materials; ++m)
    materials.push_back(
        fmt::format("{} {}", kSurfaces[static_cast<std::size_t>(scene * 3 + m * 5) % kSurfaces.size()], scene % 40));
  for (const std::string& material : materials) result.materials.push_back(makeCard(material));
  for (int view = 0; view < size.views; ++view) result.views.push_back(makeView(scene, view, materials, numbers));
  report::trim(result); // as a run does
  return result;
}

} // namespace

report::Report makeSyntheticReport(const ReportSize& size) {
  report::Report report;
  report.version = base::kVersion;
  report.suite = "nightly";
  report.device = "a made-up device";
  for (const char* name : {"size", "samples", "preset", "precision", "exposure", "budgets", "attribution"})
    report.settings.emplace_back(name, "as by default");
  report.settings.emplace_back("display", "sRGB");
  report.conditions = {{"size", "512x512"}, {"materials", "all", compare::ActsOn::wholes}};
  report.scenes.reserve(static_cast<std::size_t>(size.scenes));
  for (int scene = 0; scene < size.scenes; ++scene) report.scenes.push_back(makeScene(scene, size));
  report::settleVerdicts(report);
  return report;
}

report::RunInfo makeSyntheticRun(const ReportSize& size) {
  report::RunInfo run;
  run.startedAt = "2026-01-02T03:04:05Z";
  run.commandLine = "parity report --suite nightly.toml -o out";
  run.timings = {{"total", 3.6e6}};
  for (int scene = 0; scene < size.scenes; ++scene) {
    run.sceneTimes.push_back({sceneName(scene), 1 + scene % 7 * 0.25});
    for (int view = 0; view < size.views; ++view)
      run.again.push_back(
          {sceneName(scene), viewName(view),
           fmt::format("parity diff --suite nightly.toml --only '{}/{}'", sceneName(scene), viewName(view))});
  }
  return run;
}

} // namespace parity::bench
