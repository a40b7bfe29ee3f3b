#include "study/sweep/trial.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <random>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/glob.h"
#include "compare/metrics/measure.h"
#include "job/scene/permutation_costs.h"
#include "job/scene/reference_path.h"
#include "job/scene/scene_content.h"
#include "job/view/displayed.h"
#include "job/view/view_surfaces.h"
#include "scenes/view.h"
#include "study/sweep/device_timings.h"
#include "study/sweep/statistics.h"

namespace parity::sweep {

namespace {

// Of all threads of this process: a software device's are among them.
double processCpuMs() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double sumOf(const base::Timings& timings, std::string_view prefix) {
  double sum = 0;
  for (const auto& [stage, timeMs] : timings.stages())
    if (stage.starts_with(prefix)) sum += timeMs;
  return sum;
}

base::PixelList coveredPixels(const std::vector<base::PixelList>& coverage) {
  base::PixelList all{"", {}, {}};
  for (const base::PixelList& list : coverage)
    all.pixels.insert(all.pixels.end(), list.pixels.begin(), list.pixels.end());
  std::ranges::sort(all.pixels);
  const auto repeated = std::ranges::unique(all.pixels);
  all.pixels.erase(repeated.begin(), repeated.end());
  return all;
}

// A picture as the screen shows it, and as exposed light.
struct Shown {
  job::Displayed displayed;
  base::Image linear;
  Shown(const base::Image& color, const job::Context& context, float exposureEv)
      : displayed(job::displayImage(color, context.display(), exposureEv)), linear(job::expose(color, exposureEv)) {}
};

std::vector<Errors> errorsOf(const Shown& right, const Shown& test, const std::vector<base::PixelList>& regions) {
  compare::MeasureRequest request;
  request.metrics = {"flip", "relmse"};
  request.statistics = {"flip.p95"};
  std::vector<std::uint32_t> nonFinite = right.displayed.nonFinite;
  nonFinite.insert(nonFinite.end(), test.displayed.nonFinite.begin(), test.displayed.nonFinite.end());
  std::ranges::sort(nonFinite);
  const auto repeated = std::ranges::unique(nonFinite);
  nonFinite.erase(repeated.begin(), repeated.end());
  const compare::Measurement measured = compare::measureRegions(
      {right.displayed.pixels, test.displayed.pixels, &right.linear, &test.linear, nonFinite}, regions, request);
  std::vector<Errors> errors;
  for (const compare::Figures& f : measured.regions) {
    errors.push_back({f.find("flip.mean").value(), f.find("flip.p95").value(), f.find("relmse").value(), f.nonFinite});
  }
  return errors;
}

class Trial {
public:
  Trial(job::Context& context, const job::SceneRequest& request, const TrialOptions& options,
        const job::Progress& progress)
      : m_context(context), m_options(options), m_progress(progress), m_paths(pathsFor(request.settings)),
        m_prepared(job::prepareScene(context, request, m_paths)),
        m_scene(context, m_prepared, m_prepared.settings, m_paths),
        m_surfaces(context.device(), m_scene, m_prepared.settings,
                   scenes::makeCamera(m_prepared.scene, request.views.front(),
                                      static_cast<float>(m_prepared.settings.width) /
                                          static_cast<float>(m_prepared.settings.height))) {
    m_sweep.scene = m_prepared.scene.name;
    m_sweep.environment = m_prepared.environmentName;
    m_sweep.sun = m_prepared.sunText;
    m_sweep.width = m_prepared.settings.width;
    m_sweep.height = m_prepared.settings.height;
    m_sweep.pixels = m_surfaces.size();
    if (m_sweep.pixels == 0) throw base::fileError(request.scene, "view", "no pixel shows a part of it");
  }

  SceneSweep run() {
    choose();
    warmUp();
    measureErrors();
    measureTimes();
    measurePreparation();
    return std::move(m_sweep);
  }

private:
  struct Live {
    Variant variant;
    std::unique_ptr<paths::Renderer> renderer;
  };

  // With the truth also for its panorama, which other prefilters are made from. It knows of no baked light.
  static job::PathChoice pathsFor(const job::Settings& settings) {
    job::PathChoice choice = job::pathsOf(settings);
    choice.truth = settings.scene.baked.empty();
    return choice;
  }

  bool isWanted(const Variant& v) const {
    return v.name == "default" || m_options.settings.empty() ||
           std::ranges::any_of(m_options.settings,
                               [&](const std::string& glob) { return base::matchesGlob(glob, v.id()); });
  }

  // Live settings, but for those that the scene does not need.
  void choose() {
    const std::set<std::string> has = job::contentOf(m_prepared);
    std::set<std::string> skipped;
    const std::vector<Variant> all = makeVariants(m_prepared.settings);
    for (const std::string& glob : m_options.settings)
      if (std::ranges::none_of(all, [&](const Variant& v) { return base::matchesGlob(glob, v.id()); }))
        m_sweep.skipped.push_back(glob + ": this scene's options allow no such setting");
    for (const Variant& v : all) {
      if (!isWanted(v)) continue;
      if (!v.sameAs.empty()) { // the default's own values are told of only where the user named them
        if (!m_options.settings.empty()) m_sweep.skipped.push_back(fmt::format("{}: the same as {}", v.id(), v.sameAs));
        continue;
      }
      if (!has.contains(v.needs)) {
        const std::string what = v.path->name() + " " + (v.knob.empty() ? v.name : v.knob);
        if (skipped.insert(what).second) m_sweep.skipped.push_back(fmt::format("{}: no {}", what, v.needs));
        continue;
      }
      if (v.stage == Stage::preparation && !m_prepared.panorama) {
        if (skipped.insert(v.knob).second)
          m_sweep.skipped.push_back(
              fmt::format("{} {}: baked light keeps no panorama to prepare again", v.path->name(), v.knob));
        continue;
      }
      // As many as if it were shaded often: each setting gets the permutations that suit it.
      constexpr std::uint64_t kMany = std::uint64_t{1} << 40;
      m_live.push_back({v, m_scene.makeRenderer(*v.path, v.settings.options, {.expectedPixels = kMany})});
      VariantResult& result = m_sweep.variants.emplace_back();
      result.path = v.path->name();
      result.name = v.name;
      result.knob = v.knob;
      result.stage = v.stage;
      result.knobs = v.knobs();
    }
  }

  // Shades once, which compiles (the driver at the first dispatch), and keeps the pictures.
  void warmUp() {
    for (std::size_t i = 0; i < m_live.size(); ++i) {
      tell("compiling and first pictures", i, m_live.size());
      const base::Stopwatch watch(nullptr, "");
      const auto shaded = m_surfaces.shade(*m_live[i].renderer);
      m_firstMs.push_back(watch.elapsedMs());
      const Variant& v = m_live[i].variant;
      m_pictures.push_back(m_surfaces.compose(
          shaded, v.path->target(v.settings.options, m_context.deviceReport(), m_prepared.settings.exposureEv)));
      if (i == 0) m_coverage = m_surfaces.coverage(shaded);
    }
    for (std::size_t i = 0; i < m_live.size(); ++i) {
      const std::vector<report::PathCost> costs =
          report::costsByPath(job::describePermutations(m_context, m_sweep.variants[i].path, *m_live[i].renderer));
      if (!costs.empty()) m_sweep.variants[i].cost = {costs[0].operations, costs[0].fetches, costs[0].samplers};
    }
  }

  std::optional<base::Image> renderTruth() {
    if (!m_options.truth || !m_paths.truth) return std::nullopt;
    job::ReferencePath truth(m_context, m_prepared, m_prepared.settings, m_scene.buffers(),
                             m_scene.surfacePass().binKinds(), m_sweep.pixels, {});
    std::vector<job::ViewSurfaces::Shaded> shaded;
    std::vector<double> errors;
    std::uint32_t stream = 0;
    for (const job::ViewSurfaces::Part& part : m_surfaces.parts()) {
      const auto told = [&](double done) {
        if (m_progress) m_progress(m_sweep.scene + ": truth", done);
      };
      const auto keep = [&](const job::ReferenceSurface& surface) {
        for (std::size_t k = 0; k < surface.standardErrors.size(); ++k) {
          const glm::vec4& c = surface.shaded.color[k];
          if (const float most = std::max({c.x, c.y, c.z}); most > 0)
            errors.push_back(surface.standardErrors[k] / most);
        }
      };
      job::ViewSurfaces::Shaded& layers = shaded.emplace_back();
      for (const gpu::Surface& layer : part.layers) {
        job::ReferenceSurface exact = truth.shade(layer, m_surfaces.camera(), stream++, told);
        keep(exact);
        layers.push_back(std::move(exact.shaded));
      }
    }
    m_sweep.truthError = errors.empty() ? 0 : quantileOf(errors, 0.5);
    return m_surfaces.compose(shaded, std::nullopt);
  }

  void measureErrors() {
    std::vector<base::PixelList> regions = {coveredPixels(m_coverage)};
    for (base::PixelList& list : m_coverage)
      if (!list.pixels.empty()) regions.push_back(std::move(list));
    const std::optional<base::Image> picture = renderTruth();
    const float exposure = m_prepared.settings.exposureEv;
    std::optional<Shown> truth;
    if (picture) truth.emplace(*picture, m_context, exposure);
    const Shown first(m_pictures.front(), m_context, exposure);
    for (std::size_t i = 0; i < m_pictures.size(); ++i) {
      tell("errors", i, m_pictures.size());
      const Shown test(m_pictures[i], m_context, exposure);
      const std::vector<Errors> toFirst = errorsOf(first, test, regions);
      const std::vector<Errors> toTruth = truth ? errorsOf(*truth, test, regions) : std::vector<Errors>();
      for (std::size_t r = 0; r < regions.size(); ++r) {
        RegionErrors region{regions[r].name, regions[r].pixels.size(), std::nullopt, toFirst[r]};
        if (truth) region.truth = toTruth[r];
        if (r == 0)
          m_sweep.variants[i].whole = region;
        else
          m_sweep.variants[i].materials.push_back(region);
      }
      m_pictures[i] = {};
    }
  }

  void measureTimes() {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < m_live.size(); ++i)
      if (m_live[i].variant.stage == Stage::shading) order.push_back(i);
    std::mt19937 random(1);
    for (int round = 0; round < m_options.rounds; ++round) {
      tell("timing", static_cast<std::size_t>(round), static_cast<std::size_t>(m_options.rounds));
      std::shuffle(order.begin(), order.end(), random);
      for (const std::size_t i : order) {
        base::Timings timings;
        const DeviceTimings redirected(m_context.device(), timings, m_context.timings());
        const double cpu = processCpuMs();
        const base::Stopwatch watch(nullptr, "");
        m_surfaces.shade(*m_live[i].renderer);
        Times& times = m_sweep.variants[i].times;
        times.wallMs.push_back(watch.elapsedMs());
        times.cpuMs.push_back(processCpuMs() - cpu);
        times.deviceMs.push_back(sumOf(timings, "device: shade"));
      }
    }
    for (const std::size_t i : order) {
      Times& times = m_sweep.variants[i].times;
      times.compileMs = std::max(0.0, m_firstMs[i] - spreadOf(times.wallMs).median);
    }
  }

  void measurePreparation() {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < m_live.size(); ++i)
      if (m_live[i].variant.stage == Stage::preparation) order.push_back(i);
    std::mt19937 random(2);
    for (int round = 0; round < m_options.preparationRounds; ++round) {
      tell("timing preparation", static_cast<std::size_t>(round),
           static_cast<std::size_t>(m_options.preparationRounds));
      std::shuffle(order.begin(), order.end(), random);
      for (const std::size_t i : order) {
        const base::Stopwatch watch(nullptr, "");
        const Variant& v = m_live[i].variant;
        v.path->prepareAgain(v.knob, v.settings.options, *m_prepared.panorama);
        m_sweep.variants[i].prepareMs.push_back(watch.elapsedMs());
      }
    }
  }

  void tell(const char* what, std::size_t done, std::size_t of) const {
    if (m_progress) m_progress(m_sweep.scene + ": " + what, static_cast<double>(done) / static_cast<double>(of));
  }

  job::Context& m_context;
  const TrialOptions& m_options;
  const job::Progress& m_progress;
  job::PathChoice m_paths;
  job::PreparedScene m_prepared;
  job::SceneOnDevice m_scene;
  job::ViewSurfaces m_surfaces;
  std::vector<Live> m_live;
  std::vector<base::Image> m_pictures;
  std::vector<base::PixelList> m_coverage;
  std::vector<double> m_firstMs; // with compiling
  SceneSweep m_sweep;
};

} // namespace

SceneSweep runTrial(job::Context& context, const job::SceneRequest& request, const TrialOptions& options,
                    const job::Progress& progress) {
  return Trial(context, request, options, progress).run();
}

} // namespace parity::sweep
