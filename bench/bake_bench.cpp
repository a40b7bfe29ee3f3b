// What a bake takes: lightmap uvs, texels, light, encodings and the sun's field, of the courtyard at several densities.
//   build/bench_bake                     counters: texels; texels and rays a core's second; how far the field is off;
//                                        the share of texels within 1 % by the default samples, and the median error
//   build/bench_bake --memory            peak memory of whole bakes, each in a process of its own
// Last, exponents k of t = c n^k through the largest three numbers of texels n of each.
#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bake/encode/dilation.h"
#include "bake/encode/distance_field.h"
#include "bake/encode/half_encoding.h"
#include "bake/encode/lq_encoding.h"
#include "bake/encode/sun_pages.h"
#include "bake/light/integrate.h"
#include "bench/exponents.h"
#include "job/bake_run.h"
#include "scenes/builtin/builtin.h"
#include "study/sweep/statistics.h"

namespace parity::bench {
namespace {

// A scene at one density, each step made on first use.
class Yard {
public:
  Yard(const std::string& scene, std::int64_t texelsPerMetre)
      : m_density(static_cast<double>(texelsPerMetre)), m_scene(scenes::makeBuiltinScene(scene)) {
    m_lights.lights = m_scene.lights;
    m_lights.sun = 0;
    m_lights.environment = m_scene.environment;
  }
  const scenes::Scene& scene() const { return m_scene; }
  bake::AtlasOptions atlasOptions() const { return {.texelsPerMetre = m_density}; }
  const bake::Atlas& atlas() {
    if (!m_atlas) m_atlas = bake::makeAtlas(m_scene, atlasOptions());
    return *m_atlas;
  }
  const bake::TexelGrid& grid() {
    if (!m_grid) m_grid.emplace(m_scene, atlas(), 4);
    return *m_grid;
  }
  // So many samples of each texel, whatever its error.
  bake::StaticLight integrate(int bounces, int samples) {
    return integrate({.bounces = bounces, .error = 1e-9, .maxSamples = samples});
  }
  bake::StaticLight integrate(bake::IntegrateOptions options) {
    options.texelsPerMetre = m_density;
    return bake::integrate(m_scene, atlas(), grid(), m_lights, options);
  }
  const bake::StaticLight& light() {
    if (!m_light) m_light = integrate(0, bake::kMinSamples);
    return *m_light;
  }
  std::vector<bake::LightmapPage> pages() {
    std::vector<bake::LightmapPage> pages;
    for (bake::IntegratedPage& page : bake::makePages(m_scene, atlas(), grid(), light(), true))
      pages.push_back(std::move(page.page));
    return pages;
  }
  double texels() { return static_cast<double>(grid().texels().size()); }

private:
  double m_density;
  scenes::Scene m_scene;
  bake::BakeLights m_lights;
  std::optional<bake::Atlas> m_atlas;
  std::optional<bake::TexelGrid> m_grid;
  std::optional<bake::StaticLight> m_light;
};

Yard& yardOf(const benchmark::State& state, const std::string& scene = "courtyard") {
  static std::map<std::pair<std::string, std::int64_t>, Yard> yards;
  return yards.try_emplace({scene, state.range(0)}, scene, state.range(0)).first->second;
}

void countTexels(benchmark::State& state, Yard& yard) {
  state.counters["texels"] = yard.texels();
  state.counters["texels/s"] = benchmark::Counter(yard.texels(), benchmark::Counter::kIsIterationInvariantRate);
}

void lightmapUvs(benchmark::State& state) {
  Yard& yard = yardOf(state);
  for (auto _ : state) benchmark::DoNotOptimize(bake::makeAtlas(yard.scene(), yard.atlasOptions()));
  countTexels(state, yard);
}

void lightmapTexels(benchmark::State& state) {
  Yard& yard = yardOf(state);
  const bake::Atlas& atlas = yard.atlas();
  for (auto _ : state) benchmark::DoNotOptimize(bake::TexelGrid(yard.scene(), atlas, 4));
  countTexels(state, yard);
}

// Two bounces, 512 samples a texel.
void integrateLight(benchmark::State& state) {
  Yard& yard = yardOf(state);
  yard.grid();
  std::uint64_t rays = 0;
  for (auto _ : state) rays += yard.integrate(2, bake::kMinSamples).rays;
  countTexels(state, yard);
  state.counters["rays/s"] = benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}

// As `parity bake` does it by default. Counters: the share of texels that reach the error, and the median error.
void lightToOnePercent(benchmark::State& state, const std::string& scene) {
  Yard& yard = yardOf(state, scene);
  yard.grid();
  const bake::IntegrateOptions options;
  bake::StaticLight light;
  for (auto _ : state) light = yard.integrate(options);
  countTexels(state, yard);
  std::vector<double> errors;
  double within = 0, samples = 0;
  for (std::size_t i = 0; i < light.error.size(); ++i) {
    if (light.valid[i] == 0) continue;
    errors.push_back(light.error[i]);
    within += light.error[i] <= static_cast<float>(options.error);
    samples += light.samples[i];
  }
  const auto count = static_cast<double>(errors.size());
  state.counters["share"] = within / count;
  state.counters["median %"] = 100 * sweep::spreadOf(errors).median;
  state.counters["samples"] = samples / count;
}

void dilatePages(benchmark::State& state) {
  Yard& yard = yardOf(state);
  const std::vector<bake::IntegratedPage> pages =
      bake::makePages(yard.scene(), yard.atlas(), yard.grid(), yard.light(), true);
  for (auto _ : state)
    for (bake::IntegratedPage page : pages) bake::dilate(page.page, 4, page.invalid);
  countTexels(state, yard);
}

void encodeHalves(benchmark::State& state) {
  Yard& yard = yardOf(state);
  const std::vector<bake::LightmapPage> pages = yard.pages();
  for (auto _ : state)
    for (const bake::LightmapPage& page : pages) benchmark::DoNotOptimize(bake::encodeHalves(page));
  countTexels(state, yard);
}

void encodeMobile(benchmark::State& state, base::AstcBlock block) {
  Yard& yard = yardOf(state);
  const std::vector<bake::LightmapPage> pages = yard.pages();
  for (auto _ : state) benchmark::DoNotOptimize(bake::encodeLq(pages, yard.scene().instances.size(), {.block = block}));
  countTexels(state, yard);
}
void encodeMobile8Bits(benchmark::State& state) { encodeMobile(state, base::AstcBlock::none); }
void encodeMobileAstc4x4(benchmark::State& state) { encodeMobile(state, base::AstcBlock::astc4x4); }
void encodeMobileAstc6x6(benchmark::State& state) { encodeMobile(state, base::AstcBlock::astc6x6); }

// Counters: of the mean absolute error of visibility within the transition and outside of it, and the shadow's area
// over the mask's own; of the worst page.
void sunField(benchmark::State& state) {
  Yard& yard = yardOf(state);
  const std::vector<bake::SunMask> masks = bake::makeSunMasks(yard.atlas(), yard.grid(), yard.light());
  const bake::DistanceFieldOptions options;
  for (auto _ : state)
    for (const bake::SunMask& mask : masks) benchmark::DoNotOptimize(bake::makeDistanceField(mask, options));
  countTexels(state, yard);
  for (const bake::SunMask& mask : masks) {
    const bake::DistanceFieldError error =
        bake::measureDistanceField(mask, bake::makeDistanceField(mask, options), options);
    const auto worst = [&](const char* name, double value) {
      state.counters[name] = std::max(static_cast<double>(state.counters[name]), value);
    };
    worst("in band", error.inBand);
    worst("outside", error.outside);
    worst("area off", std::abs(error.shadowArea - 1));
  }
}

// Times are of all threads together, so that neither their number nor what else runs counts for much.
#define PARITY_BAKE(run) BENCHMARK(run)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()
PARITY_BAKE(lightmapUvs)->RangeMultiplier(2)->Range(8, 64);
PARITY_BAKE(lightmapTexels)->RangeMultiplier(2)->Range(8, 64);
PARITY_BAKE(integrateLight)->RangeMultiplier(2)->Range(4, 16)->Iterations(1);
#define PARITY_BAKE_OF(run, scene)                                                                                     \
  BENCHMARK_CAPTURE(run, scene, #scene)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()
PARITY_BAKE_OF(lightToOnePercent, room)->RangeMultiplier(2)->Range(4, 16)->Iterations(1);
PARITY_BAKE_OF(lightToOnePercent, courtyard)->RangeMultiplier(2)->Range(4, 16)->Iterations(1);
PARITY_BAKE(dilatePages)->RangeMultiplier(2)->Range(4, 16);
PARITY_BAKE(encodeHalves)->RangeMultiplier(2)->Range(4, 16);
PARITY_BAKE(encodeMobile8Bits)->RangeMultiplier(2)->Range(4, 16);
PARITY_BAKE(encodeMobileAstc4x4)->RangeMultiplier(2)->Range(4, 16);
PARITY_BAKE(encodeMobileAstc6x6)->RangeMultiplier(2)->Range(4, 16);
PARITY_BAKE(sunField)->RangeMultiplier(2)->Range(4, 16);

// A whole bake but for captures, whose memory has nothing to do with texels: no bounce, fewest samples.
struct Peak {
  double texels = 0, kibibytes = 0;
};
Peak bakeAlone(double texelsPerMetre) {
  job::Settings settings;
  job::Context context(settings);
  job::SceneRequest request;
  request.name = "courtyard";
  request.scene = "builtin:courtyard";
  job::BakeOptions options;
  options.atlas.texelsPerMetre = texelsPerMetre;
  options.integrate = {.bounces = 0, .error = 1, .maxSamples = bake::kMinSamples};
  options.captures = 0;
  const job::BakeResult result = job::bakeScene(context, request, options);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return {static_cast<double>(result.light.figures.texels), static_cast<double>(usage.ru_maxrss)};
}

Peak bakeInAProcess(double texelsPerMetre) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    const Peak peak = bakeAlone(texelsPerMetre);
    _exit(write(ends[1], &peak, sizeof peak) == sizeof peak ? 0 : 1);
  }
  close(ends[1]);
  Peak peak;
  const bool isRead = read(ends[0], &peak, sizeof peak) == sizeof peak;
  close(ends[0]);
  int status = 0;
  if (waitpid(child, &status, 0) != child || status != 0 || !isRead) throw std::runtime_error("a bake has failed");
  return peak;
}

void printMemory() {
  Peak before;
  for (const double density : {8, 16, 32}) {
    const Peak peak = bakeInAProcess(density);
    fmt::print("{:>3} texels a metre: {:>9} texels, peak {:>7.1f} MiB", density, peak.texels, peak.kibibytes / 1024);
    if (before.texels > 0)
      fmt::print(", {:.0f} bytes for each texel more",
                 1024 * (peak.kibibytes - before.kibibytes) / (peak.texels - before.texels));
    fmt::print("\n");
    std::fflush(stdout);
    before = peak;
  }
}

int run(int count, char** arguments) {
  if (count == 2 && std::strcmp(arguments[1], "--memory") == 0) {
    printMemory(); // before there are threads
    return 0;
  }
  runWithExponents(count, arguments, [](const auto& run) {
    return std::pair(run.counters.at("texels").value, run.GetAdjustedCPUTime());
  });
  return 0;
}

} // namespace
} // namespace parity::bench

int main(int count, char** arguments) { return parity::bench::run(count, arguments); }
