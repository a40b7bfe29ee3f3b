// The high-end path's own error against its cost, setting by setting: five scenes under three environments against the
// ground truth. build/highend_evidence [FOLDER] writes highend-error.md and highend-pareto.svg there (default: docs).
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/file.h"
#include "compare/metrics/measure.h"
#include "highend/knobs.h"
#include "job/scene/scene_renderer.h"
#include "job/view/displayed.h"
#include "scenes/view.h"
#include "shading/terms.h"
#include "study/sweep/pareto_svg.h"

namespace {

using namespace parity;
using highend::Compensation;
using highend::OffSpecular;

constexpr int kErrorSize = 96, kTimeSize = 384, kTimeRounds = 5;
constexpr double kTruthError = 0.005;

struct Setting {
  std::string name;
  highend::Options options;
};

std::vector<Setting> settings() {
  const highend::Options chosen;
  std::vector<Setting> all = {{"default", chosen}};
  for (const char* id : {"off-specular", "compensation", "geometry-term", "fresnel", "diffuse"}) {
    const base::KnobRow<highend::Options>& row = *highend::knobs().find(id);
    for (const std::string& choice : row.knob.choices) {
      Setting setting{fmt::format("{} {}", id, choice), chosen};
      row.set(setting.options, {choice});
      if (row.text(setting.options) != row.text(chosen)) all.push_back(std::move(setting));
    }
  }
  all.push_back({"off-specular none, compensation turquin (Karis 2013 and Turquin)", chosen});
  all.back().options.offSpecular = OffSpecular::none;
  all.back().options.compensation = Compensation::turquin;
  all.push_back({"off-specular none, compensation none (Karis 2013)", chosen});
  all.back().options.offSpecular = OffSpecular::none;
  all.back().options.compensation = Compensation::none;
  return all;
}

struct Lit {
  std::string scene, environment;
  std::string label() const {
    const auto stem = [](const std::string& s) {
      return s.starts_with("builtin:") ? s : std::filesystem::path(s).stem().string();
    };
    return stem(scene) + ", " + stem(environment);
  }
};

// Real assets where they are, else built-in ones.
std::vector<Lit> scenesToTry() {
  const char* variable = std::getenv("PARITY_SHARED");
  const std::filesystem::path assets = std::filesystem::path(variable ? variable : "../shared") / "assets";
  std::vector<std::string> scenes = {"builtin:spheres", "builtin:materials"}, environments;
  if (std::filesystem::exists(assets / "env")) {
    for (const char* name : {"WaterBottle/WaterBottle.gltf", "ToyCar/ToyCar.gltf",
                             "MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb"})
      scenes.push_back((assets / name).string());
    for (const char* name : {"studio_small_05_1k", "chinese_garden_1k", "st_peters_square_night_1k"})
      environments.push_back((assets / "env" / (std::string(name) + ".hdr")).string());
  } else {
    environments = {"builtin:studio", "builtin:sky", "builtin:night"};
  }
  std::vector<Lit> all;
  for (const std::string& scene : scenes)
    for (const std::string& environment : environments) all.push_back({scene, environment});
  return all;
}

job::Settings jobSettings(const highend::Options& options, int size) {
  job::Settings s;
  s.width = s.height = size;
  s.terms = size == kErrorSize;
  s.of<highend::Options>() = options;
  s.reference.model.surface = options.model;
  s.reference.integral.relativeError = kTruthError;
  s.cacheFolder = base::defaultCacheFolder();
  return s;
}

job::SceneRequest requestOf(const Lit& lit) {
  job::SceneRequest request;
  request.scene = lit.scene;
  request.settings.scene.environment = lit.environment;
  request.views = {{}};
  return request;
}

// What the truth depends on.
std::string modelOf(const highend::Options& o) {
  return fmt::format("{}{}{}", static_cast<int>(o.model.geometryTerm), static_cast<int>(o.model.fresnel),
                     static_cast<int>(o.model.diffuse));
}

struct Errors {
  double relMse = 0, relMseSpecular = 0, flip = 0;
};

// One setting over all pairs of scene and environment: time over the default's, errors (median, worst).
struct Row {
  std::string name;
  double ratio, relMse, worstRelMse, relMseSpecular, worstSpecular, flip, worstFlip;
};

struct Outcome {
  Errors errors;
  double timeMs = 0;
};

base::PixelList coveredPixels(const std::vector<base::PixelList>& coverage) {
  base::PixelList all;
  for (const base::PixelList& list : coverage)
    all.pixels.insert(all.pixels.end(), list.pixels.begin(), list.pixels.end());
  std::sort(all.pixels.begin(), all.pixels.end());
  all.pixels.erase(std::unique(all.pixels.begin(), all.pixels.end()), all.pixels.end());
  return all;
}

Errors errorsOf(const base::Frame& truth, const base::Frame& test, const base::PixelList& where,
                const base::DisplayTransform& display) {
  const auto figure = [&](const base::Image& r, const base::Image& t, const char* metric, const char* name) {
    const job::Displayed a = job::displayImage(r, display, 0), b = job::displayImage(t, display, 0);
    compare::MeasureRequest request;
    request.metrics = {metric};
    return compare::measureRegions({a.pixels, b.pixels, &r, &t, {}}, {where}, request).regions[0].find(name).value();
  };
  const auto specular = static_cast<std::size_t>(shading::Term::skySpecular);
  return {figure(truth.color, test.color, "relmse", "relmse"),
          figure(truth.terms[specular], test.terms[specular], "relmse", "relmse"),
          figure(truth.color, test.color, "flip", "flip.mean")};
}

double shadingTimeMs(const base::Timings& timings) {
  for (const auto& [stage, timeMs] : timings.stages())
    if (stage == "device: shade highend") return timeMs;
  throw std::runtime_error("no stage 'device: shade highend' was timed");
}

// A scene under an environment by every setting.
class Trial {
public:
  Trial(const Lit& lit, const std::vector<Setting>& all)
      : m_all(all), m_context(jobSettings({}, kErrorSize)),
        m_prepared(job::prepareScene(m_context, requestOf(lit), {.chosen = job::allPaths(), .truth = true})) {}

  std::vector<Outcome> run() {
    std::vector<Outcome> outcomes(m_all.size());
    measureErrors(outcomes);
    measureTimes(outcomes);
    return outcomes;
  }

private:
  struct Renderer {
    job::Context context;
    std::unique_ptr<job::SceneRenderer> renderer;
    scenes::Camera camera;
    Renderer(const job::PreparedScene& prepared, const job::Settings& settings, const job::PathChoice& paths)
        : context(settings),
          renderer(std::make_unique<job::SceneRenderer>(context, prepared, context.settings(), paths, 1)),
          camera(scenes::makeCamera(prepared.scene, {}, 1)) {}
  };

  void measureErrors(std::vector<Outcome>& outcomes) {
    std::map<std::string, base::Frame> truths;
    base::PixelList where;
    for (std::size_t i = 0; i < m_all.size(); ++i) {
      const highend::Options& options = m_all[i].options;
      base::Frame& truth = truths[modelOf(options)];
      job::Settings settings = jobSettings(options, kErrorSize);
      settings.coverage = where.pixels.empty();
      Renderer r(m_prepared, settings, {.chosen = {job::allPaths().front()}, .truth = truth.color.empty()});
      job::ViewFrames frames = r.renderer->render(r.camera);
      if (where.pixels.empty()) where = coveredPixels(frames.coverage);
      if (truth.color.empty()) truth = std::move(frames.truth);
      outcomes[i].errors = errorsOf(truth, frames.first().frame, where, r.context.display());
    }
  }

  // Rounds in random order, so that drift cancels; the median of each.
  void measureTimes(std::vector<Outcome>& outcomes) {
    std::vector<std::unique_ptr<Renderer>> renderers;
    std::vector<double> last(m_all.size(), 0);
    std::vector<std::vector<double>> times(m_all.size());
    std::vector<std::size_t> order;
    for (const Setting& setting : m_all) {
      order.push_back(renderers.size());
      renderers.push_back(std::make_unique<Renderer>(m_prepared, jobSettings(setting.options, kTimeSize),
                                                     job::PathChoice{.chosen = {job::allPaths().front()}}));
    }
    std::mt19937 random(1);
    for (int round = 0; round <= kTimeRounds; ++round) {
      std::shuffle(order.begin(), order.end(), random);
      for (const std::size_t i : order) {
        renderers[i]->renderer->render(renderers[i]->camera);
        const double now = shadingTimeMs(renderers[i]->context.timings());
        if (round > 0) times[i].push_back(now - last[i]); // the first one compiles
        last[i] = now;
      }
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
      std::nth_element(times[i].begin(), times[i].begin() + kTimeRounds / 2, times[i].end());
      outcomes[i].timeMs = times[i][kTimeRounds / 2];
    }
  }

  const std::vector<Setting>& m_all;
  job::Context m_context;
  const job::PreparedScene m_prepared;
};

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

std::vector<Row> summarise(const std::vector<Setting>& all, const std::vector<std::vector<Outcome>>& trials) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto values = [&](auto of) {
      std::vector<double> v;
      for (const auto& trial : trials) v.push_back(of(trial[i], trial[0]));
      return v;
    };
    const auto ratio = values([](const Outcome& o, const Outcome& base) { return o.timeMs / base.timeMs; });
    const auto relMse = values([](const Outcome& o, const Outcome&) { return o.errors.relMse; });
    const auto specular = values([](const Outcome& o, const Outcome&) { return o.errors.relMseSpecular; });
    const auto flip = values([](const Outcome& o, const Outcome&) { return o.errors.flip; });
    const auto worst = [](const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); };
    rows.push_back({all[i].name, medianOf(ratio), medianOf(relMse), worst(relMse), medianOf(specular), worst(specular),
                    medianOf(flip), worst(flip)});
  }
  return rows;
}

std::string picture(const std::vector<Row>& rows) {
  sweep::SceneSweep all;
  for (const Row& row : rows) {
    sweep::VariantResult& v = all.variants.emplace_back();
    v.path = "highend";
    v.name = row.name;
    v.times.deviceMs = {row.ratio};
    v.whole.truth = sweep::Errors{.relMse = row.relMse};
  }
  sweep::ParetoPlot plot = sweep::plotOf(all, sweep::Stage::shading, sweep::Against::truth, "relmse");
  plot.timeTitle = "time of shading over the default's";
  plot.timeUnit = "";
  plot.errorTitle = "relMSE against the truth, median";
  plot.namesDominated = true;
  for (sweep::ParetoDot& dot : plot.dots) dot.details.clear();
  return sweep::toSvg(std::move(plot));
}

std::string table(const std::vector<Row>& rows, const std::vector<Lit>& lits, const std::vector<Setting>& all,
                  const std::vector<std::vector<Outcome>>& trials) {
  std::string text = fmt::format(
      "# What the high-end path's settings cost, and how far they are from the truth\n\n"
      "Made by `build/highend_evidence`: {} pairs of a scene and an environment, each setting against the reference "
      "path\n"
      "(multiple scattering, standard error {:.1f} %, {}x{} pixels; settings of the material model against a truth of "
      "the "
      "same model).\n"
      "Time: shading alone at {}x{}, median of {} interleaved rounds, over that of the default. relMSE and FLIP over "
      "the\n"
      "covered pixels: median and worst of the pairs. The truth's own noise adds about {:.0e} to relMSE; FLIP between "
      "a "
      "truth\n"
      "of 1 % and one of 0.5 % is .006 to .013 (three pairs): an error of 1 % in luminance is a FLIP of some .02.\n"
      "What the environment's parts (levels, irradiance, cells, lamps) cost in time and memory: "
      "[environments.md](environments.md).\n\n"
      "![Pareto front](highend-pareto.svg)\n\n"
      "| setting | time | relMSE median | worst | relMSE of skySpecular | worst | FLIP mean | worst |\n"
      "|---|---|---|---|---|---|---|---|\n",
      lits.size(), 100 * kTruthError, kErrorSize, kErrorSize, kTimeSize, kTimeSize, kTimeRounds,
      kTruthError * kTruthError);
  for (const Row& row : rows)
    text += fmt::format("| {} | {:.2f} | {:.2e} | {:.2e} | {:.2e} | {:.2e} | {:.4f} | {:.4f} |\n", row.name, row.ratio,
                        row.relMse, row.worstRelMse, row.relMseSpecular, row.worstSpecular, row.flip, row.worstFlip);
  text += "\n## Each pair: FLIP of the default\n\n| pair | FLIP mean | relMSE | relMSE of skySpecular "
          "|\n|---|---|---|---|\n";
  for (std::size_t k = 0; k < lits.size(); ++k)
    text += fmt::format("| {} | {:.4f} | {:.1e} | {:.1e} |\n", lits[k].label(), trials[k][0].errors.flip,
                        trials[k][0].errors.relMse, trials[k][0].errors.relMseSpecular);
  text += "\n## Each pair: relMSE\n\n| setting |";
  for (const Lit& lit : lits) text += " " + lit.label() + " |";
  text += "\n|---|";
  for (std::size_t i = 0; i < lits.size(); ++i) text += "---|";
  text += "\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += "| " + all[i].name + " |";
    for (const auto& trial : trials) text += fmt::format(" {:.1e} |", trial[i].errors.relMse);
    text += "\n";
  }
  return text;
}

} // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "docs";
  const std::vector<Setting> all = settings();
  const std::vector<Lit> lits = scenesToTry();
  std::vector<std::vector<Outcome>> trials;
  for (const Lit& lit : lits) {
    trials.push_back(Trial(lit, all).run());
    fmt::print(stderr, "{}: default relMSE {:.2e}, FLIP {:.4f}, {:.1f} ms\n", lit.label(),
               trials.back()[0].errors.relMse, trials.back()[0].errors.flip, trials.back()[0].timeMs);
    // After each pair: a long run that is broken off leaves what it has.
    const std::vector<Lit> done(lits.begin(), lits.begin() + static_cast<std::ptrdiff_t>(trials.size()));
    const std::vector<Row> rows = summarise(all, trials);
    base::writeText(folder / "highend-error.md", table(rows, done, all, trials));
    base::writeText(folder / "highend-pareto.svg", picture(rows));
  }
  return 0;
}
