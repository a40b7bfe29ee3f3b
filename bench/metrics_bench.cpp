// Pooling beside a sort; one material beside a hundred, by the material swap; each metric's map. "time/px" is wall time
// per pixel of a pair.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <benchmark/benchmark.h>

#include "base/gathered.h"
#include "base/parallel.h"
#include "bench/noisy_image.h"
#include "compare/metrics/measure.h"
#include "compare/metrics/measure_swaps.h"
#include "compare/pooling/pooling.h"
#include "compare/pooling/region.h"

namespace parity::compare {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;

// The pixels nearest to each of `count` points: materials of uneven shape that tile the image.
std::vector<base::PixelList> makeCells(int count, int width = kWidth, int height = kHeight) {
  std::vector<base::PixelList> lists(static_cast<std::size_t>(count));
  std::vector<std::pair<int, int>> points;
  unsigned state = 9;
  const auto random = [&](int limit) {
    state = state * 1664525u + 1013904223u;
    return static_cast<int>((state >> 8) % static_cast<unsigned>(limit));
  };
  for (int i = 0; i < count; ++i) points.emplace_back(random(width), random(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::size_t nearest = 0;
      int least = std::numeric_limits<int>::max();
      for (std::size_t i = 0; i < points.size(); ++i) {
        const int dx = points[i].first - x, dy = points[i].second - y, distance = dx * dx + dy * dy;
        if (distance < least) least = distance, nearest = i;
      }
      lists[nearest].pixels.push_back(static_cast<std::uint32_t>(y * width + x));
    }
  return lists;
}

void reportPerPixel(benchmark::State& state, double pixels = 1. * kWidth * kHeight) {
  state.counters["time/px"] =
      benchmark::Counter(pixels, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// A map as FLIP's are: many small values, few large ones.
base::Image makeMap() {
  base::Image map(kWidth, kHeight, 1);
  unsigned state = 5;
  for (float& v : map.pixels) {
    state = state * 1664525u + 1013904223u;
    const float unit = static_cast<float>(state >> 8) / 16777216.f;
    v = unit * unit * unit;
  }
  return map;
}

// Arguments: threads.
void poolWholeMap(benchmark::State& state) {
  const base::ThreadLimit limit(static_cast<int>(state.range(0)));
  const base::Image map = makeMap();
  for (auto _ : state) benchmark::DoNotOptimize(poolMap(map).mean);
  reportPerPixel(state);
}
BENCHMARK(poolWholeMap)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

// The same weighted quartiles by std::sort.
void poolWholeMapBySorting(benchmark::State& state) {
  const base::Image map = makeMap();
  for (auto _ : state) {
    std::vector<float> sorted = map.pixels;
    std::sort(sorted.begin(), sorted.end());
    double total = 0, running = 0;
    for (const float v : sorted) total += static_cast<double>(v);
    float found[3] = {};
    std::size_t i = 0;
    for (int quartile = 0; quartile < 3; ++quartile)
      for (; i < sorted.size(); ++i) {
        running += static_cast<double>(sorted[i]);
        found[quartile] = sorted[i];
        if (running > 0.25 * (quartile + 1) * total) break;
      }
    benchmark::DoNotOptimize(found[1]);
  }
  reportPerPixel(state);
}
BENCHMARK(poolWholeMapBySorting)->UseRealTime()->Unit(benchmark::kMillisecond);

// A picture that is `reference` but for one material, which is as in `test`.
Swap makeSwap(const base::PixelList& list, const base::Image8& test) {
  Swap swap;
  swap.list = &list;
  swap.displayed = base::makeGathered<std::uint8_t>(list.pixels.size(), 3);
  for (std::size_t i = 0; i < list.pixels.size(); ++i)
    std::copy_n(&test.pixels[3 * std::size_t{list.pixels[i]}], 3, &swap.displayed.pixels[3 * i]);
  return swap;
}

// The materials of a run without a budget file, which tile the picture: what each more of them costs.
void measureMaterials(benchmark::State& state) {
  const base::ThreadLimit limit(static_cast<int>(state.range(1)));
  const int width = static_cast<int>(state.range(2)), height = width * 9 / 16;
  const base::Image8 reference = makeNoisyImage(width, height, 1), test = makeNoisyImage(width, height, 2);
  const std::vector<base::PixelList> lists = makeCells(static_cast<int>(state.range(0)), width, height);
  std::vector<Swap> swaps;
  for (const base::PixelList& list : lists) swaps.push_back(makeSwap(list, test));
  const MeasureRequest request{.metrics = defaultMetrics()};
  for (auto _ : state)
    benchmark::DoNotOptimize(measureSwaps({.displayed = reference}, swaps, request).figures[0].values.data());
  reportPerPixel(state, 1. * width * height);
}
BENCHMARK(measureMaterials)
    ->ArgNames({"materials", "threads", "width"})
    ->ArgsProduct({{1, 10, 100}, {1, 2}, {1920, 3840}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// A whole image: what all of its pixels cost in one region.
void measureWholeImage(benchmark::State& state) {
  const base::ThreadLimit limit(static_cast<int>(state.range(0)));
  const base::Image8 reference = makeNoisyImage(kWidth, kHeight, 1), test = makeNoisyImage(kWidth, kHeight, 2);
  const std::vector<base::PixelList> whole = {wholeImage(kWidth, kHeight)};
  const MeasureRequest request{.metrics = defaultMetrics()};
  for (auto _ : state)
    benchmark::DoNotOptimize(measureRegions({reference, test}, whole, request).regions[0].values.data());
  reportPerPixel(state);
}
BENCHMARK(measureWholeImage)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

// What comes after the maps alone: FLIP's five figures of each region.
void poolRegions(benchmark::State& state) {
  const base::ThreadLimit limit(static_cast<int>(state.range(1)));
  const std::vector<base::PixelList> lists = makeCells(static_cast<int>(state.range(0)));
  const Metric& flip = requireMetric("flip", "bench");
  MetricMaps maps;
  maps.planes.push_back(makeMap());
  for (auto _ : state)
    base::parallelFor(lists.size(), 1, [&](std::size_t i, std::size_t) {
      benchmark::DoNotOptimize(flip.pool(maps, runsOf(lists[i], kWidth, kHeight), flip.statistics).data());
    });
  reportPerPixel(state);
}
BENCHMARK(poolRegions)
    ->ArgNames({"regions", "threads"})
    ->ArgsProduct({{1, 100}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// Each metric's maps by one thread, of bytes; the HDR one's of linear images.
void makeMaps(benchmark::State& state, const std::string& name) {
  const base::ThreadLimit limit(1);
  const base::Image8 reference = makeNoisyImage(kWidth, kHeight, 1), test = makeNoisyImage(kWidth, kHeight, 2);
  base::Image linear[2] = {base::Image(kWidth, kHeight, 3), base::Image(kWidth, kHeight, 3)};
  for (int i = 0; i < 2; ++i)
    std::transform((i == 0 ? reference : test).pixels.begin(), (i == 0 ? reference : test).pixels.end(),
                   linear[i].pixels.begin(),
                   [](std::uint8_t v) { return std::exp2(static_cast<float>(v) / 32.f - 5.f); });
  const Metric& metric = requireMetric(name, "bench");
  const MetricInput input(metric.needsLinear ? ImagePair{reference, test, &linear[0], &linear[1]}
                                             : ImagePair{reference, test});
  for (auto _ : state) benchmark::DoNotOptimize(metric.makeMaps(input, {}).planes.data());
  reportPerPixel(state);
}

void registerMaps() {
  for (const Metric& metric : metricRegistry())
    benchmark::RegisterBenchmark(("makeMaps/" + metric.name).c_str(), makeMaps, metric.name)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
}

} // namespace
} // namespace parity::compare

int main(int argc, char** argv) {
  parity::compare::registerMaps();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
