// The high-end path's own error against its cost, setting by setting: five scenes under three environments against the
// ground truth. build/highend_evidence [FOLDER] writes highend-error.md and highend-pareto.svg there (default: docs).
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/file.h"
#include "base/image_io.h"
#include "compare/measure.h"
#include "job/displayed.h"
#include "job/scene_renderer.h"
#include "scenes/view.h"
#include "shading/terms.h"

namespace {

using namespace parity;
using highend::Compensation;
using highend::DiffuseLobe;
using highend::FresnelCurve;
using highend::GeometryTerm;
using highend::OffSpecular;

constexpr int kErrorSize = 144, kTimeSize = 512, kTimeRounds = 9;
constexpr double kTruthError = 0.02;

struct Setting {
  std::string name;
  highend::Options options;
};

std::vector<Setting> settings() {
  const highend::Options chosen;
  std::vector<Setting> all = {{"default", chosen}};
  const auto add = [&](const std::string& name, auto member, auto value) {
    if (chosen.*member == value) return;
    all.push_back({name, chosen});
    all.back().options.*member = value;
  };
  const auto addAll = [&](const std::string& option, auto member, const std::vector<std::string>& names) {
    using Enum = std::remove_cvref_t<decltype(chosen.*member)>;
    for (std::size_t i = 0; i < names.size(); ++i)
      add(fmt::format("{} {}", option, names[i]), member, static_cast<Enum>(i));
  };
  addAll("off-specular", &highend::Options::offSpecular, highend::offSpecularNames());
  addAll("compensation", &highend::Options::compensation, highend::compensationNames());
  addAll("geometry-term", &highend::Options::geometryTerm, highend::geometryTermNames());
  addAll("fresnel", &highend::Options::fresnel, highend::fresnelNames());
  addAll("diffuse", &highend::Options::diffuse, highend::diffuseNames());
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
    for (const char* name : {"WaterBottle", "MetalRoughSpheresNoTextures", "ToyCar"})
      scenes.push_back((assets / name / (std::string(name) + ".gltf")).string());
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
  s.highend = options;
  s.reference.model.geometryTerm = options.geometryTerm;
  s.reference.model.fresnel = options.fresnel;
  s.reference.model.diffuse = options.diffuse;
  s.reference.integral.relativeError = kTruthError;
  s.cacheFolder = base::defaultCacheFolder();
  return s;
}

job::SceneRequest requestOf(const Lit& lit) {
  job::SceneRequest request;
  request.scene = lit.scene;
  request.environment = lit.environment;
  request.views = {{}};
  return request;
}

// What the truth depends on.
std::string modelOf(const highend::Options& o) {
  return fmt::format("{}{}{}", static_cast<int>(o.geometryTerm), static_cast<int>(o.fresnel),
                     static_cast<int>(o.diffuse));
}

struct Errors {
  double relMse = 0, relMseSpecular = 0, flip = 0;
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
    return compare::measureRegions({a.pixels, b.pixels, &r, &t, {}}, {where}, request)
        .regions[0]
        .all.find(name)
        .value();
  };
  const auto specular = static_cast<std::size_t>(shading::Term::skySpecular);
  return {figure(truth.color, test.color, "relmse", "relmse"),
          figure(truth.terms[specular], test.terms[specular], "relmse", "relmse"),
          figure(truth.color, test.color, "flip", "flip.mean")};
}

double shadingTimeMs(const base::Timings& timings) {
  for (const auto& [stage, timeMs] : timings.stages())
    if (stage == "device: shade highend") return timeMs;
  return 0;
}

// A scene under an environment by every setting.
class Trial {
public:
  Trial(const Lit& lit, const std::vector<Setting>& all) : m_lit(lit), m_all(all) {}

  std::vector<Outcome> run() {
    std::vector<Outcome> outcomes(m_all.size());
    measureErrors(outcomes);
    measureTimes(outcomes);
    return outcomes;
  }

private:
  struct Renderer {
    job::Context context;
    job::PreparedScene prepared;
    std::unique_ptr<job::SceneRenderer> renderer;
    scenes::Camera camera;
    Renderer(const Lit& lit, const job::Settings& settings, const job::Paths& paths)
        : context(settings), prepared(job::prepareScene(context, requestOf(lit), paths)),
          renderer(std::make_unique<job::SceneRenderer>(context, prepared, paths, 1)),
          camera(scenes::makeCamera(prepared.scene, {}, 1)) {}
  };

  void measureErrors(std::vector<Outcome>& outcomes) {
    std::map<std::string, base::Frame> truths;
    base::PixelList where;
    for (std::size_t i = 0; i < m_all.size(); ++i) {
      const highend::Options& options = m_all[i].options;
      base::Frame& truth = truths[modelOf(options)];
      Renderer r(m_lit, jobSettings(options, kErrorSize),
                 {.highend = true, .mobile = where.pixels.empty(), .reference = truth.color.empty()});
      job::ViewFrames frames = r.renderer->render(r.camera);
      if (where.pixels.empty()) where = coveredPixels(frames.coverage);
      if (truth.color.empty()) truth = std::move(frames.reference);
      outcomes[i].errors = errorsOf(truth, frames.highend, where, r.context.display());
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
      renderers.push_back(std::make_unique<Renderer>(m_lit, jobSettings(setting.options, kTimeSize),
                                                     job::Paths{.highend = true, .mobile = false}));
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

  const Lit& m_lit;
  const std::vector<Setting>& m_all;
};

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

struct Row {
  std::string name;
  double ratio, relMse, worstRelMse, relMseSpecular, worstSpecular, flip, worstFlip;
};

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

// Cheaper or as cheap, and nearer to the truth.
bool isDominated(const Row& row, const std::vector<Row>& rows) {
  return std::any_of(rows.begin(), rows.end(),
                     [&](const Row& other) { return other.ratio < row.ratio && other.relMse < row.relMse; });
}

std::string paretoPicture(const std::vector<Row>& rows) {
  constexpr double kLeft = 70, kTop = 20, kWidth = 560, kHeight = 360;
  double least = 1e9, most = 0, fastest = 1e9, slowest = 0;
  for (const Row& row : rows) {
    least = std::min(least, row.relMse);
    most = std::max(most, row.relMse);
    fastest = std::min(fastest, row.ratio);
    slowest = std::max(slowest, row.ratio);
  }
  least /= 1.3, most *= 1.3, fastest -= 0.03, slowest += 0.03;
  const auto x = [&](double ratio) { return kLeft + (ratio - fastest) / (slowest - fastest) * kWidth; };
  const auto y = [&](double error) { return kTop + std::log(most / error) / std::log(most / least) * kHeight; };
  std::string svg =
      fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 980 {}\" font-family=\"sans-serif\" "
                  "font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                  kTop + kHeight + 50);
  for (double tick = 1e-6; tick < 10; tick *= std::sqrt(10.0))
    if (tick > least && tick < most)
      svg += fmt::format("<path d=\"M{} {:.1f}h{}\" stroke=\"#ddd\"/><text x=\"{}\" y=\"{:.1f}\" "
                         "text-anchor=\"end\">{:.1e}</text>\n",
                         kLeft, y(tick), kWidth, kLeft - 6, y(tick) + 4, tick);
  for (double tick = std::ceil(fastest * 10) / 10; tick < slowest; tick += 0.1)
    svg += fmt::format("<path d=\"M{:.1f} {}v{}\" stroke=\"#ddd\"/><text x=\"{:.1f}\" y=\"{}\" "
                       "text-anchor=\"middle\">{:.1f}</text>\n",
                       x(tick), kTop, kHeight, x(tick), kTop + kHeight + 16, tick);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">time of shading over the default's</text>\n",
                     kLeft + kWidth / 2, kTop + kHeight + 36);
  svg +=
      fmt::format("<text x=\"14\" y=\"{0}\" text-anchor=\"middle\" transform=\"rotate(-90 14 {0})\">relMSE against the "
                  "truth, median</text>\n",
                  kTop + kHeight / 2);
  std::vector<const Row*> sorted;
  for (const Row& row : rows) sorted.push_back(&row);
  std::sort(sorted.begin(), sorted.end(), [](const Row* a, const Row* b) { return a->relMse > b->relMse; });
  double lastLabel = 0; // labels stand in a column of their own, in the order of the points
  for (const Row* row : sorted) {
    const bool dominated = isDominated(*row, rows);
    const char* colour = row == &rows[0] ? "#c03020" : dominated ? "#999" : "#2060b0";
    const double label = std::max(lastLabel + 17, y(row->relMse) + 4);
    lastLabel = label;
    svg += fmt::format(
        "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"5\" fill=\"{2}\"/><path d=\"M{0:.1f} {1:.1f}L{3} {4:.1f}\" "
        "stroke=\"{2}\" stroke-width=\".4\"/><text x=\"{5}\" y=\"{6:.1f}\" fill=\"{2}\">{7}</text>\n",
        x(row->ratio), y(row->relMse), colour, kLeft + kWidth + 8, label - 4, kLeft + kWidth + 12, label, row->name);
  }
  return svg + "</svg>\n";
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
      "covered pixels: median and worst of the pairs. The truth's own noise adds about {:.0e} to relMSE.\n\n"
      "![Pareto front](highend-pareto.svg)\n\n"
      "| setting | time | relMSE median | worst | relMSE of skySpecular | worst | FLIP mean | worst |\n"
      "|---|---|---|---|---|---|---|---|\n",
      lits.size(), 100 * kTruthError, kErrorSize, kErrorSize, kTimeSize, kTimeSize, kTimeRounds,
      kTruthError * kTruthError);
  for (const Row& row : rows)
    text += fmt::format("| {} | {:.2f} | {:.2e} | {:.2e} | {:.2e} | {:.2e} | {:.4f} | {:.4f} |\n", row.name, row.ratio,
                        row.relMse, row.worstRelMse, row.relMseSpecular, row.worstSpecular, row.flip, row.worstFlip);
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
  }
  const std::vector<Row> rows = summarise(all, trials);
  base::writeText(folder / "highend-error.md", table(rows, lits, all, trials));
  base::writeText(folder / "highend-pareto.svg", paretoPicture(rows));
  return 0;
}
