// Time of LDR-FLIP and of the figures per region, per pixel of a pair, sRGB decode included. "time/px" is
// wall time; CPU (of all threads) is what counts on a busy machine.
#include <cmath>
#include <cstdint>

#include <benchmark/benchmark.h>

#include "base/parallel.h"
#include "compare/flip.h"
#include "compare/metrics.h"
#include "compare/region.h"

namespace parity::compare {
namespace {

// Smooth waves with noise on them; eightBit: whole 255ths, as from a PNG.
base::Image makeImage(int width, int height, std::uint32_t seed, bool eightBit) {
  base::Image image(width, height, 3);
  std::uint32_t state = seed;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        state = state * 1664525u + 1013904223u;
        const float noise = static_cast<float>(state >> 8) / 16777216.f;
        const float wave =
            0.5f + 0.4f * std::sin(0.02f * static_cast<float>(x * (c + 1)) + 0.03f * static_cast<float>(y));
        const float value = 0.9f * wave + 0.1f * noise;
        image.at(x, y)[c] = eightBit ? std::round(255.f * value) / 255.f : value;
      }
  return image;
}

void reportPerPixel(benchmark::State& state, double pixels) {
  state.counters["time/px"] =
      benchmark::Counter(pixels, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Arguments: width, height, threads, whether the images are of 8 bit.
void flip(benchmark::State& state) {
  const int width = static_cast<int>(state.range(0)), height = static_cast<int>(state.range(1));
  const base::ThreadLimit limit(static_cast<int>(state.range(2)));
  const base::Image reference = makeImage(width, height, 1, state.range(3) != 0);
  const base::Image test = makeImage(width, height, 2, state.range(3) != 0);
  for (auto _ : state) benchmark::DoNotOptimize(flipMap(reference, test).pixels.data());
  reportPerPixel(state, static_cast<double>(width) * height);
}
BENCHMARK(flip)
    ->ArgNames({"w", "h", "threads", "8bit"})
    ->ArgsProduct({{512}, {512}, {1, 2}, {1, 0}})
    ->ArgsProduct({{1920}, {1080}, {1, 2}, {1, 0}})
    ->ArgsProduct({{3840}, {2160}, {1, 2}, {1, 0}})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// A hundred materials in blocks that tile a 1920x1080 image: the cost of all their figures together, per image pixel.
void hundredRegions(benchmark::State& state) {
  constexpr int kWidth = 1920, kHeight = 1080;
  const base::Image reference = makeImage(kWidth, kHeight, 1, true), test = makeImage(kWidth, kHeight, 2, true);
  const base::Image map = flipMap(reference, test);
  std::vector<base::PixelList> lists(100);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      lists[static_cast<std::size_t>(y / 108 * 10 + x / 192)].pixels.push_back(
          static_cast<std::uint32_t>(y * kWidth + x));
  for (auto _ : state)
    for (const base::PixelList& list : lists)
      benchmark::DoNotOptimize(measureRegion(reference, test, map, list).interior.flip.mean);
  reportPerPixel(state, static_cast<double>(kWidth) * kHeight);
}
BENCHMARK(hundredRegions)->Unit(benchmark::kMillisecond);

void pooling(benchmark::State& state) {
  base::Image map(1920, 1080, 1);
  const base::Image noise = makeImage(1920, 1080, 3, false);
  for (std::size_t i = 0; i < map.pixels.size(); ++i) map.pixels[i] = noise.pixels[3 * i];
  for (auto _ : state) benchmark::DoNotOptimize(poolMap(map).mean);
  reportPerPixel(state, 1920. * 1080.);
}
BENCHMARK(pooling)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace parity::compare

BENCHMARK_MAIN();
