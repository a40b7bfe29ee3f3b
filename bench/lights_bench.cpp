// What local lights cost the high-end path: many of them, of which a pixel sees eight, against ten of which it sees
// eight; more pixels; with shadow maps, and drawing those.
//   build/bench_lights
// Shading of 640 x 480 pixels, the lists of lights included; counters: pixels, lights that reach one on average, maps.
// Last, exponents k of t = c n^k through the largest three n of each.
#include <cmath>
#include <random>

#include <benchmark/benchmark.h>
#include <glm/gtc/matrix_transform.hpp>

#include "bench/exponents.h"
#include "gpu/surface/surface_pass.h"
#include "highend/renderer.h"
#include "scenes/builtin/shapes.h"

namespace parity::bench {
namespace {

constexpr std::uint32_t kWidth = 640, kHeight = 480;

// A field of spheres seen from above so that it fills the picture; one material.
scenes::Scene makeField() {
  scenes::Scene scene;
  scene.name = "field";
  scene.meshes = {scenes::makeFloor(16, 1, 64), scenes::makeSphere(0.4, 32, 16)};
  scene.materials.resize(1);
  scene.materials[0].roughness = 0.4f;
  scene.instances.push_back({0, glm::mat4(1.f), "floor"});
  for (int i = 0; i < 24 * 18; ++i)
    scene.instances.push_back(
        {1, glm::translate(glm::mat4(1.f), glm::vec3(i % 24 - 11.5f, 0.4f, static_cast<float>(i / 24) - 8.5f)),
         "sphere"});
  return scene;
}

scenes::Camera makeCamera() {
  scenes::Camera camera;
  camera.toWorld = glm::inverse(glm::lookAt(glm::vec3(0, 20, 6), glm::vec3(0, 0, 0), glm::vec3(0, 1, 0)));
  camera.fovYDeg = 42;
  camera.zNear = 0.1f;
  camera.zFar = 100;
  return camera;
}

struct Stage {
  gpu::Device device{gpu::DeviceOptions{}};
  scenes::Scene scene = makeField();
  scenes::Camera camera = makeCamera();
  gpu::SceneBuffers buffers{device, scene};
};
Stage& stage() {
  static Stage stage;
  return stage;
}

// The field through so many pixels, 4 to 3.
struct Picture {
  gpu::SurfacePass pass;
  gpu::Surface surface;
  explicit Picture(std::uint32_t width)
      : pass(stage().device, stage().buffers, width, width * 3 / 4),
        surface(std::move(pass.render(stage().camera, {0, width * 3 / 4}, glm::vec2(0.5f)).front())) {}
};
const Picture& picture() {
  static const Picture picture(640);
  return picture;
}

// How many of the lights reach a pixel.
double meanReaching(const std::vector<scenes::Light>& lights) {
  const gpu::Surface& surface = picture().surface;
  const auto positions = surface.position.downloadAs<glm::vec4>(surface.size());
  std::size_t reaching = 0, pixels = 0;
  for (std::size_t i = 0; i < positions.size(); i += 997, ++pixels)
    for (const scenes::Light& light : lights)
      reaching += glm::distance(glm::vec3(positions[i]), light.position) < light.range;
  return static_cast<double>(reaching) / static_cast<double>(pixels);
}

// Points over the visible field, all of a range such that so many of them reach a pixel on average.
std::vector<scenes::Light> makeLights(int count, double reaching) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> x(-11, 11), z(-8.5f, 8.5f), unit(0.2f, 1);
  std::vector<scenes::Light> lights(static_cast<std::size_t>(count));
  for (scenes::Light& light : lights) {
    light.position = {x(random), 0.6f, z(random)};
    light.color = glm::vec3(unit(random), unit(random), unit(random)) * 3.f;
  }
  float nearest = 0, farthest = 100;
  for (int step = 0; step < 24; ++step) {
    const float range = 0.5f * (nearest + farthest);
    for (scenes::Light& light : lights) light.range = range;
    (meanReaching(lights) < reaching ? nearest : farthest) = range;
  }
  return lights;
}

void shade(benchmark::State& state, const Picture& seen, highend::Inputs inputs) {
  const highend::Renderer renderer(
      stage().device, stage().buffers, seen.pass.binKinds(), inputs,
      {.model = {.diffuse = highend::DiffuseLobe::lambert}, .compensation = highend::Compensation::none});
  renderer.shade(seen.surface, stage().camera); // compiles
  for (auto _ : state) benchmark::DoNotOptimize(renderer.shade(seen.surface, stage().camera).color.size());
  state.counters["pixels"] = static_cast<double>(seen.surface.size());
  state.counters["reaching"] = meanReaching(inputs.lights);
}

// Eight reach a pixel of each.
highend::Inputs lit(std::int64_t count) {
  highend::Inputs inputs;
  inputs.lights = makeLights(static_cast<int>(count), 8);
  return inputs;
}
void manyLights(benchmark::State& state) { shade(state, picture(), lit(state.range(0))); }
void manyLightsForEveryPixel(benchmark::State& state) {
  highend::Inputs inputs = lit(state.range(0));
  inputs.cullLights = false;
  shade(state, picture(), inputs);
}
void pixelsOfAThousandLights(benchmark::State& state) {
  const Picture seen(static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(state.range(0)) / 0.75))));
  shade(state, seen, lit(1000));
}
void shadowedLights(benchmark::State& state) {
  highend::Inputs inputs = lit(state.range(0));
  gpu::ShadowMaps maps(stage().device, stage().buffers, inputs.lights, {});
  inputs.shadows = &maps;
  shade(state, picture(), inputs);
  state.counters["maps"] = static_cast<double>(maps.mapCount());
}
void drawnShadowMaps(benchmark::State& state) {
  const std::vector<scenes::Light> lights = lit(state.range(0)).lights;
  for (auto _ : state) {
    const gpu::ShadowMaps maps(stage().device, stage().buffers, lights, {});
    state.counters["maps"] = static_cast<double>(maps.mapCount());
    state.counters["draws"] = static_cast<double>(maps.drawCount());
  }
}

#define PARITY_LIGHTS(run) BENCHMARK(run)->Unit(benchmark::kMillisecond)->UseRealTime()
PARITY_LIGHTS(manyLights)->RangeMultiplier(10)->Range(10, 10000);
PARITY_LIGHTS(manyLightsForEveryPixel)->RangeMultiplier(10)->Range(10, 1000);
PARITY_LIGHTS(pixelsOfAThousandLights)->Arg(12288)->Arg(49152)->Arg(196608)->Arg(786432);
PARITY_LIGHTS(shadowedLights)->RangeMultiplier(10)->Range(10, 1000);
PARITY_LIGHTS(drawnShadowMaps)->RangeMultiplier(10)->Range(10, 1000);

int run(int count, char** arguments) {
  runWithExponents(count, arguments,
                   [](const auto& run) { return std::pair(std::stod(run.run_name.args), run.GetAdjustedRealTime()); });
  return 0;
}

} // namespace
} // namespace parity::bench

int main(int count, char** arguments) { return parity::bench::run(count, arguments); }
