// The truth's speed: core minutes a million covered pixels at 0.5 % standard error, and its error against the points
// taken, under built-in environments and those of $PARITY_SHARED/assets/env.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "base/parallel.h"
#include "lighting/environment/sun_extraction.h"
#include "reference/shade.h"
#include "scenes/load.h"

namespace {

using namespace parity;
using reference::SurfaceSample;

// One environment as the truth is given it: without the suns that are lights of their own.
struct Sky {
  reference::EnvironmentSampler sampler;
  std::vector<scenes::Light> suns;
};
const Sky& skyOf(const std::string& file) {
  static std::map<std::string, Sky> skies;
  if (const auto known = skies.find(file); known != skies.end()) return known->second;
  std::vector<std::string> warnings;
  lighting::SunExtraction extraction = lighting::extractSuns(scenes::loadEnvironment(file, 0, warnings));
  Sky sky{reference::EnvironmentSampler(extraction.environment), {}};
  for (const lighting::ExtractedSun& sun : extraction.suns) sky.suns.push_back(sun.light);
  return skies.emplace(file, std::move(sky)).first->second;
}

enum Kind { kAll, kMetal, kPlastic, kCoated, kCloth, kLayered, kBrushed, kFilm, kKinds };
constexpr const char* kKindNames[kKinds] = {"all", "metal", "plastic", "coated", "cloth", "layered", "brushed", "film"};

// Pixels of balls seen from +Z: the visible half evenly as it covers the picture, roughness 0.05 .. 1.
std::vector<SurfaceSample> makePixels(Kind kind, int count) {
  std::vector<SurfaceSample> pixels;
  for (int i = 0; i < count; ++i) {
    SurfaceSample s;
    const double r = std::sqrt((i + 0.5) / count), phi = 2.399963229728653 * i; // the golden angle
    s.pixel = static_cast<std::uint32_t>(i);
    s.normal = {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r * r)};
    s.geometricNormal = s.normal;
    s.roughness = 0.05f + 0.95f * static_cast<float>(i * 7 % 20) / 19.f;
    s.metallic = kind != kPlastic && (kind == kMetal || i % 2 == 0) ? 1.f : 0.f;
    s.coatNormal = s.normal;
    s.coatRoughness = 0.05f + 0.95f * static_cast<float>(i * 3 % 20) / 19.f;
    s.sheenRoughness = 0.07f + 0.93f * static_cast<float>(i * 9 % 20) / 19.f;
    if (kind == kCoated || kind == kLayered) s.coat = 1;
    if (kind == kCloth || kind == kLayered) s.sheenColor = {0.8f, 0.5f, 0.3f};
    if (kind == kBrushed) {
      s.anisotropy = 0.2f + 0.8f * static_cast<float>(i * 11 % 20) / 19.f;
      s.tangent = glm::normalize(glm::cross(glm::vec3(0, 1, 0), s.normal));
    }
    if (kind == kFilm) {
      s.iridescence = 1;
      s.filmThickness = 100 + 500 * static_cast<float>(i * 11 % 20) / 19.f;
    }
    s.baseColor = s.metallic > 0 ? glm::vec3(1.f, 0.77f, 0.34f) : glm::vec3(0.5f, 0.5f, 0.6f);
    pixels.push_back(s);
  }
  return pixels;
}

const reference::DirectionalAlbedo& albedo() {
  static const reference::DirectionalAlbedo table(reference::Model{}.surface.geometryTerm,
                                                  reference::Model{}.surface.fresnel);
  return table;
}

const reference::SheenAlbedo& sheenAlbedo() {
  static const reference::SheenAlbedo table;
  return table;
}

// Time of one thread; the points that were taken for each way of sampling.
void atHalfAPercent(benchmark::State& state, const std::string& file, Kind kind) {
  const base::ThreadLimit limit(1);
  const Sky& sky = skyOf(file);
  const std::vector<SurfaceSample> pixels = makePixels(kind, 400);
  const reference::Inputs inputs{
      .environment = &sky.sampler, .albedo = &albedo(), .lights = sky.suns, .sheenAlbedo = &sheenAlbedo()};
  std::vector<reference::ShadedSample> shaded;
  for (auto _ : state) shaded = reference::shade(pixels, inputs, {});
  double points = 0, worst = 0;
  for (const reference::ShadedSample& s : shaded) {
    points += s.samples;
    worst = std::max<double>(worst, s.relativeError);
  }
  const auto count = static_cast<double>(pixels.size());
  state.counters["points"] = points / count;
  state.counters["worst%"] = 100 * worst;
  // Seconds a pixel times 1e6 / 60: by CPU time, as the benchmark measures it.
  state.counters["core_min/Mpx"] =
      benchmark::Counter(count * 60e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// At a number of points for each way: the root mean square of the relative standard error over the pixels, and the rate
// at which it fell since a quarter of the points.
double errorAt(const std::string& file, Kind kind, int points) {
  const Sky& sky = skyOf(file);
  const reference::Inputs inputs{
      .environment = &sky.sampler, .albedo = &albedo(), .lights = sky.suns, .sheenAlbedo = &sheenAlbedo()};
  reference::Options options;
  options.integral = {.relativeError = 0, .minSamples = points, .maxSamples = points};
  double squares = 0;
  const auto shaded = reference::shade(makePixels(kind, 200), inputs, options);
  for (const reference::ShadedSample& s : shaded) squares += static_cast<double>(s.relativeError) * s.relativeError;
  return std::sqrt(squares / static_cast<double>(shaded.size()));
}
void errorAgainstPoints(benchmark::State& state, const std::string& file, Kind kind) {
  const auto points = static_cast<int>(state.range(0));
  double error = 0;
  for (auto _ : state) error = errorAt(file, kind, points);
  state.counters["error%"] = 100 * error;
  state.counters["rate"] = std::log(error / errorAt(file, kind, points / 4)) / std::log(4.0);
}

std::vector<std::string> environments() {
  std::vector<std::string> files = {"builtin:studio", "builtin:sky"};
  if (const char* shared = std::getenv("PARITY_SHARED"))
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(shared) / "assets/env"))
      if (entry.path().extension() == ".hdr") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace

int main(int argc, char** argv) {
  for (const std::string& file : environments()) {
    const std::string name = std::filesystem::path(file).stem().string();
    for (int k = 0; k < kKinds; ++k) {
      const auto kind = static_cast<Kind>(k);
      benchmark::RegisterBenchmark(fmt::format("atHalfAPercent/{}/{}", name, kKindNames[kind]).c_str(),
                                   [=](benchmark::State& state) { atHalfAPercent(state, file, kind); })
          ->Unit(benchmark::kMillisecond);
      benchmark::RegisterBenchmark(fmt::format("errorAgainstPoints/{}/{}", name, kKindNames[kind]).c_str(),
                                   [=](benchmark::State& state) { errorAgainstPoints(state, file, kind); })
          ->Arg(256)
          ->Arg(1024)
          ->Arg(4096)
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
