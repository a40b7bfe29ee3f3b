// What local lights cost the high-end path: many of them, of which a pixel sees eight, against ten of which it sees
// eight.
//   build/bench_lights
// Shading of 640 x 480 pixels, the lists of lights included; counters: pixels, lights that reach one on average.
#include <cmath>
#include <map>
#include <memory>
#include <random>

#include <benchmark/benchmark.h>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/surface_pass.h"
#include "highend/renderer.h"
#include "scenes/shapes.h"

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
  gpu::SurfacePass pass{device, buffers, kWidth, kHeight};
  gpu::Surface surface = std::move(pass.render(camera, {0, kHeight}, glm::vec2(0.5f)).front());
};
Stage& stage() {
  static Stage stage;
  return stage;
}

// How many of the lights reach a pixel.
double meanReaching(const std::vector<scenes::Light>& lights) {
  const auto positions = stage().surface.position.downloadAs<glm::vec4>(stage().surface.size());
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

void shade(benchmark::State& state, int count, double reaching, bool cull) {
  Stage& s = stage();
  highend::Inputs inputs;
  inputs.lights = makeLights(count, reaching);
  inputs.cullLights = cull;
  const highend::Renderer renderer(
      s.device, s.buffers, s.pass.binKinds(), inputs,
      {.diffuse = highend::DiffuseLobe::lambert, .compensation = highend::Compensation::none});
  renderer.shade(s.surface, s.camera); // compiles
  for (auto _ : state) benchmark::DoNotOptimize(renderer.shade(s.surface, s.camera).color.data());
  state.counters["pixels"] = static_cast<double>(s.surface.size());
  state.counters["reaching"] = meanReaching(inputs.lights);
}

// Eight reach a pixel of each.
void tenLights(benchmark::State& state) { shade(state, 10, 8, true); }
void manyLights(benchmark::State& state) { shade(state, static_cast<int>(state.range(0)), 8, true); }
void manyLightsForEveryPixel(benchmark::State& state) { shade(state, static_cast<int>(state.range(0)), 8, false); }

BENCHMARK(tenLights)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(manyLights)->RangeMultiplier(10)->Range(10, 10000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(manyLightsForEveryPixel)->RangeMultiplier(10)->Range(10, 1000)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
} // namespace parity::bench

BENCHMARK_MAIN();
