// Prefiltering an environment and tabulating the environment BRDF: what a first run pays.
#include <benchmark/benchmark.h>

#include "highend/env_brdf_lut.h"
#include "lighting/environment/environment_light.h"
#include "scenes/builtin/builtin.h"

namespace {

using namespace parity;

void prefilterEnvironment(benchmark::State& state) {
  const scenes::Environment environment = scenes::makeBuiltinEnvironment("studio");
  const lighting::PrefilterOptions options{.faceSize = static_cast<int>(state.range(0)),
                                           .sampleCount = static_cast<int>(state.range(1))};
  for (auto _ : state) benchmark::DoNotOptimize(lighting::makeEnvironmentLight(environment, options));
}
BENCHMARK(prefilterEnvironment)
    ->Args({128, 128})
    ->Args({256, 64})
    ->Args({256, 128})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// What a path's first run pays for its environment.
void prepareEnvironment(benchmark::State& state, const lighting::PrefilterOptions& options) {
  const scenes::Environment environment = scenes::makeBuiltinEnvironment("studio");
  for (auto _ : state) benchmark::DoNotOptimize(lighting::makeEnvironmentLight(environment, options));
}
BENCHMARK_CAPTURE(prepareEnvironment, mobile, lighting::PrefilterOptions{.levels = lighting::PrefilterLevels::first})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(prepareEnvironment, highend, lighting::kFinePrefilter)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

void tabulateEnvironmentBrdf(benchmark::State& state) {
  const auto term = state.range(0) == 0 ? highend::GeometryTerm::heightCorrelated : highend::GeometryTerm::schlickSmith;
  for (auto _ : state) benchmark::DoNotOptimize(highend::makeEnvBrdfLut(term));
}
BENCHMARK(tabulateEnvironmentBrdf)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace

BENCHMARK_MAIN();
