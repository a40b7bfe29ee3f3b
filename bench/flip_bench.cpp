// FLIP's speed: LDR and HDR, sizes, threads, instruction sets, and pairs that differ in parts only. Beside each time
// per pixel stands the share of the roofline: the time that the arithmetic alone would take at the best rate measured
// here.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <sys/resource.h>

#include <benchmark/benchmark.h>

#include "base/parallel.h"
#include "base/simd_level.h"
#include "bench/noisy_image.h"
#include "compare/flip/flip.h"
#include "compare/flip/flip_filters.h"
#include "compare/flip/flip_hdr.h"
#include "compare/flip/flip_simd.h"

namespace parity::compare {
namespace {

base::Image toFloats(const base::Image8& bytes, bool hdr) {
  base::Image image(bytes.width, bytes.height, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float v = static_cast<float>(bytes.pixels[i]) / 255.f;
    image.pixels[i] = hdr ? std::exp2(12.f * v - 8.f) : v;
  }
  return image;
}

// Multiplications, additions and fused pairs of them that the filters alone take for a pixel of a pair, symmetric taps
// being added before they are multiplied.
double filterOperations() {
  const FlipFilters f = makeFlipFilters(kDefaultPixelsPerDegree);
  const auto taps = [](const std::vector<float>& half) { return static_cast<double>(half.size()) - 1; };
  const double color = 2 * (taps(f.luma) + taps(f.redGreen)) + 3 * taps(f.blueYellowA);
  const double acrossRows = color + 6 * taps(f.gauss);
  const double alongRow =
      2 * (taps(f.luma) + taps(f.redGreen) + taps(f.blueYellowA) + taps(f.blueYellowB)) + 9 * taps(f.gauss);
  return 2 * (acrossRows + alongRow);
}

// Operations a second of one core, measured as FLIP's filter along rows over data in the first-level cache, which can
// do no better: what the roofline stands for here. (For the instruction set in use.)
double operationsPerSecond() {
  const FlipFilters filters = makeFlipFilters(kDefaultPixelsPerDegree);
  constexpr std::size_t kStride = 48, kColumns = 16, kValues = kColumns * kBatchRows;
  std::vector<float> planes(kFilteredPlanes * kBatchRows * kStride, 0.5f), out(5 * kValues);
  const FilteredColumns columns = {out.data(), out.data() + kValues, out.data() + 2 * kValues, out.data() + 3 * kValues,
                                   out.data() + 4 * kValues};
  const auto taps = [](const std::vector<float>& half) { return static_cast<double>(half.size()) - 1; };
  const double operations =
      kValues *
      (2 * (taps(filters.luma) + taps(filters.redGreen) + taps(filters.blueYellowA) + taps(filters.blueYellowB)) +
       9 * taps(filters.gauss));
  double best = 0;
  for (int round = 0; round < 20; ++round) {
    constexpr int kCalls = 200;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kCalls; ++i) {
      filterAlongRows(filters, planes.data(), kStride, 16, kColumns, kBatchRows, columns);
      benchmark::ClobberMemory();
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best = std::max(best, kCalls * operations / seconds);
  }
  return best;
}

// Runs the benchmark's loop. time/px; roofline: the share of the time that the filters' arithmetic alone would need on
// the threads in use. maps: exposures.
template <typename Body> void measure(benchmark::State& state, double pixels, int threads, double maps, Body body) {
  const double rate = operationsPerSecond();
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state) body();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double each = seconds / static_cast<double>(state.iterations());
  state.counters["ns/px"] = 1e9 * each / pixels;
  state.counters["roofline"] = pixels * maps * filterOperations() / rate / threads / each;
  state.SetLabel(base::simdLevels().front());
}

const std::vector<std::vector<std::int64_t>> kSizes = {{512, 512}, {1920, 1080}, {3840, 2160}, {7680, 4320}};

void addSizes(benchmark::internal::Benchmark* bench) {
  for (const auto& size : kSizes)
    for (int threads : {1, 2}) bench->Args({size[0], size[1], threads});
}

// 8-bit sRGB in, map out.
void ldr(benchmark::State& state) {
  const int width = static_cast<int>(state.range(0)), height = static_cast<int>(state.range(1));
  const int threads = static_cast<int>(state.range(2));
  const base::ThreadLimit limit(threads);
  const base::Image8 reference = makeNoisyImage(width, height, 1), test = makeNoisyImage(width, height, 2);
  measure(state, static_cast<double>(width) * height, threads, 1,
          [&] { benchmark::DoNotOptimize(flipMap(reference, test).pixels.data()); });
}
BENCHMARK(ldr)->ArgNames({"w", "h", "threads"})->Apply(addSizes)->UseRealTime()->Unit(benchmark::kMillisecond);

// The same from floats.
void ldrFloats(benchmark::State& state) {
  const int width = static_cast<int>(state.range(0)), height = static_cast<int>(state.range(1));
  const base::ThreadLimit limit(1);
  const base::Image reference = toFloats(makeNoisyImage(width, height, 1), false);
  const base::Image test = toFloats(makeNoisyImage(width, height, 2), false);
  measure(state, static_cast<double>(width) * height, 1, 1,
          [&] { benchmark::DoNotOptimize(flipMap(reference, test).pixels.data()); });
}
BENCHMARK(ldrFloats)->ArgNames({"w", "h"})->Args({1920, 1080})->UseRealTime()->Unit(benchmark::kMillisecond);

// Linear floats in; the number of exposures is the pair's own.
void hdr(benchmark::State& state) {
  const int width = static_cast<int>(state.range(0)), height = static_cast<int>(state.range(1));
  const int threads = static_cast<int>(state.range(2));
  const base::ThreadLimit limit(threads);
  const base::Image reference = toFloats(makeNoisyImage(width, height, 1), true);
  const base::Image test = toFloats(makeNoisyImage(width, height, 2), true);
  const int exposures = exposureRange(reference, test, {}).count;
  measure(state, static_cast<double>(width) * height, threads, exposures,
          [&] { benchmark::DoNotOptimize(flipHdr(reference, test).flip.pixels.data()); });
  state.counters["exposures"] = exposures;
  state.counters["ns/px/exposure"] = state.counters["ns/px"].value / exposures;
}
BENCHMARK(hdr)->ArgNames({"w", "h", "threads"})->Apply(addSizes)->UseRealTime()->Unit(benchmark::kMillisecond);

// One instruction set after another, 1080p.
void ldrBySimdLevel(benchmark::State& state) {
  const std::vector<std::string> levels = base::simdLevels();
  const auto index = static_cast<std::size_t>(state.range(0));
  if (index >= levels.size()) {
    state.SkipWithError("this processor has no further instruction set");
    return;
  }
  const base::ThreadLimit limit(1);
  const base::Image8 reference = makeNoisyImage(1920, 1080, 1), test = makeNoisyImage(1920, 1080, 2);
  base::useSimdLevel(levels[index]);
  measure(state, 1920. * 1080., 1, 1, [&] { benchmark::DoNotOptimize(flipMap(reference, test).pixels.data()); });
  base::useSimdLevel("");
  state.SetLabel(levels[index]);
}
BENCHMARK(ldrBySimdLevel)->DenseRange(0, 3)->UseRealTime()->Unit(benchmark::kMillisecond);

// 4K pairs that differ everywhere, in one block of 5 % of the area, in one pixel of 10,000 (scattered), nowhere.
enum class Differing { everywhere, block, scattered, nowhere };
void partlyEqual(benchmark::State& state) {
  constexpr int kWidth = 3840, kHeight = 2160;
  const base::ThreadLimit limit(1);
  const base::Image8 reference = makeNoisyImage(kWidth, kHeight, 1), other = makeNoisyImage(kWidth, kHeight, 2);
  base::Image8 test = reference;
  const auto take = [&](int x, int y) { std::copy_n(other.at(x, y), 3, test.at(x, y)); };
  switch (static_cast<Differing>(state.range(0))) {
  case Differing::everywhere:
    test = other;
    break;
  case Differing::block: // 5 % of the area, 0.2236 of each side
    for (int y = 700; y < 700 + 483; ++y)
      for (int x = 1500; x < 1500 + 859; ++x) take(x, y);
    break;
  case Differing::scattered:
    for (unsigned i = 0, state32 = 1; i < kWidth * kHeight / 10000; ++i) {
      state32 = state32 * 1664525u + 1013904223u;
      const unsigned pixel = (state32 >> 8) % (kWidth * kHeight);
      take(static_cast<int>(pixel % kWidth), static_cast<int>(pixel / kWidth));
    }
    break;
  case Differing::nowhere:
    break;
  }
  constexpr double kPixels = static_cast<double>(kWidth) * kHeight;
  const double filtered = static_cast<double>(flipMaps(reference, test).filteredPixels) / kPixels;
  measure(state, kPixels, 1, filtered, [&] { benchmark::DoNotOptimize(flipMap(reference, test).pixels.data()); });
  state.counters["filtered"] = filtered;
  constexpr const char* kNames[] = {"everywhere", "a block of 5 %", "scattered, 1 in 10,000", "nowhere"};
  state.SetLabel(kNames[state.range(0)]);
}
BENCHMARK(partlyEqual)->DenseRange(0, 3)->UseRealTime()->Unit(benchmark::kMillisecond);

// What the process holds at most while it compares a 4K pair, beyond what it held with the inputs: bytes a pixel.
void memory(benchmark::State& state) {
  constexpr int kWidth = 3840, kHeight = 2160;
  const bool isHdr = state.range(0) != 0;
  const auto peakBytes = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024. * static_cast<double>(usage.ru_maxrss);
  };
  const base::Image8 bytes = makeNoisyImage(kWidth, kHeight, 1), otherBytes = makeNoisyImage(kWidth, kHeight, 2);
  const base::Image reference = isHdr ? toFloats(bytes, true) : base::Image();
  const base::Image test = isHdr ? toFloats(otherBytes, true) : base::Image();
  const double before = peakBytes();
  for (auto _ : state) {
    if (isHdr)
      benchmark::DoNotOptimize(flipHdr(reference, test, {.start = 0.f, .stop = 2.f}).flip.pixels.data());
    else
      benchmark::DoNotOptimize(flipMap(bytes, otherBytes).pixels.data());
  }
  state.counters["bytes/px"] = (peakBytes() - before) / (static_cast<double>(kWidth) * kHeight);
  state.SetLabel(isHdr ? "HDR: run it alone, the peak is the process's"
                       : "LDR: run it alone, the peak is the process's");
}
BENCHMARK(memory)->Arg(0)->Arg(1)->Iterations(1)->UseRealTime()->Unit(benchmark::kMillisecond);

} // namespace
} // namespace parity::compare

BENCHMARK_MAIN();
