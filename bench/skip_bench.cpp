// What a scene's features cost where they are present, against the same scene without them: device time of shading, by
// interleaved medians. And a permutation made for a plain nonmetal against the one that does everything.
//   build/bench_skip [SIZE [ROUNDS [GLOB]]]
// A table in Markdown; by default 512 pixels a side, 15 rounds, all features.
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/text/glob.h"
#include "job/scene/scene_renderer.h"
#include "scenes/builtin/builtin.h"
#include "scenes/view.h"

namespace parity::bench {
namespace {

struct Settings {
  int size = 512, rounds = 15;
  std::string features = "*";
};

// A scene to shade, all of whose parts a feature may change.
struct Subject {
  scenes::Scene scene;
  bool environment = true;
  std::vector<scenes::Light> lights;
  job::Settings settings;
  gpu::PermutationBudget budget;
};

struct Feature {
  std::string name;
  std::function<Subject()> make; // with neither
  std::function<void(Subject&)> with, without;
};

// builtin:spheres as it is, 24 materials, in studio light and sun.
Subject makeSpheres() {
  Subject subject;
  subject.scene = scenes::makeBuiltinScene("spheres");
  subject.lights = {scenes::makeSun({30, 50, 4})};
  return subject;
}

// The same spheres, all of this one's material.
Subject makeAllOf(const std::string& material) {
  Subject subject = makeSpheres();
  scenes::Scene& scene = subject.scene;
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
    if (scene.materials[scene.meshes[mesh].material].name == material) {
      for (scenes::Instance& instance : scene.instances) instance.mesh = mesh;
      return subject;
    }
  throw base::Error(base::ExitCode::failed, "bench_skip", material, "builtin:spheres has no such material");
}

scenes::Material& materialOf(Subject& subject) {
  return subject.scene.materials[subject.scene.meshes[subject.scene.instances.front().mesh].material];
}

void addLamps(Subject& subject) {
  for (int i = 0; i < 4; ++i) {
    scenes::Light lamp;
    lamp.position = {static_cast<float>(i) - 1.5f, 0.5f, 2.f};
    lamp.color = glm::vec3(6.f);
    subject.lights.push_back(lamp);
  }
}

std::vector<Feature> listFeatures() {
  const auto nothing = [](Subject&) {};
  const auto plain = [] { return makeAllOf("dielectric 0.4"); };
  return {
      {"environment (builtin:spheres)", makeSpheres, nothing, [](Subject& s) { s.environment = false; }},
      {"sun (builtin:spheres)", makeSpheres, nothing, [](Subject& s) { s.lights.clear(); }},
      {"environment", plain, nothing, [](Subject& s) { s.environment = false; }},
      {"sun", plain, nothing, [](Subject& s) { s.lights.clear(); }},
      {"four local lights", plain, addLamps, nothing},
      {"fog", plain, [](Subject& s) { s.scene.fog = scenes::Fog{.density = 0.1f}; }, nothing},
      {"terms", plain, [](Subject& s) { s.settings.terms = true; }, nothing},
      {"alpha blending", plain,
       [](Subject& s) {
         materialOf(s).alphaMode = scenes::AlphaMode::blend;
         materialOf(s).baseColor.w = 0.5f;
       },
       nothing},
      {"base colour texture", [] { return makeAllOf("checker"); }, nothing,
       [](Subject& s) { materialOf(s).baseColorTexture = {}; }},
      {"normal map", [] { return makeAllOf("brushed steel"); }, nothing,
       [](Subject& s) { materialOf(s).normalTexture = {}; }},
      {"specular anti-aliasing of it", [] { return makeAllOf("brushed steel"); },
       [](Subject& s) { s.settings.specularAa = gpu::SpecularAa::toksvig; }, nothing},
      {"light at all (else unlit)", plain, nothing, [](Subject& s) { materialOf(s).unlit = true; }},
      {"metallic above 0 (else nonmetal)", plain, [](Subject& s) { materialOf(s).metallic = 0.5f; }, nothing},
      {"gloss (else fully rough)", plain, nothing, [](Subject& s) { materialOf(s).fullyRough = true; }},
      {"does everything (else made for a plain nonmetal)", plain,
       [](Subject& s) { s.budget = {.own = 0, .shares = true}; }, nothing},
  };
}

// A renderer with all that it refers to.
struct Variant {
  job::Context context;
  job::PreparedScene prepared;
  std::optional<job::SceneRenderer> renderer;
  scenes::Camera camera;
  struct Times {
    double firstMs = 0;
    std::vector<double> laterMs;
    double median() const {
      std::vector<double> sorted = laterMs;
      std::ranges::sort(sorted);
      return sorted[sorted.size() / 2];
    }
  } highend, mobile;

  Variant(Subject subject, const Settings& bench)
      : context([&] {
          subject.settings.width = subject.settings.height = bench.size;
          subject.settings.cacheFolder = base::defaultCacheFolder();
          return subject.settings;
        }()) {
    prepared.scene = std::move(subject.scene);
    paths::Light light;
    if (subject.environment) {
      const scenes::Environment studio = scenes::makeBuiltinEnvironment("studio");
      light.environment = context.environmentLight(studio, lighting::kFinePrefilter);
      light.cells = std::make_shared<const lighting::PanoramaCells>(lighting::makePanoramaCells(studio));
    }
    prepared.lights = light.lights = subject.lights;
    for (const paths::Path* path : job::allPaths()) prepared.lightOfPath[path->name()] = light;
    camera = scenes::makeCamera(prepared.scene, {}, 1.f);
    renderer.emplace(context, prepared, context.settings(), job::PathChoice{.chosen = job::allPaths()}, 1,
                     subject.budget);
    const auto [first, second] = run();
    highend.firstMs = first;
    mobile.firstMs = second;
  }
  Variant(const Variant&) = delete;
  Variant& operator=(const Variant&) = delete;

  // Device time of one frame by each path.
  std::pair<double, double> run() {
    const auto timeMs = [&](const std::string& stage) {
      for (const auto& [name, sum] : context.timings().stages())
        if (name == stage) return sum;
      return 0.0;
    };
    const double before = timeMs("device: shade highend"), beforeMobile = timeMs("device: shade mobile");
    renderer->render(camera);
    return {timeMs("device: shade highend") - before, timeMs("device: shade mobile") - beforeMobile};
  }
};

void compare(const Feature& feature, const Settings& bench) {
  Subject with = feature.make(), without = feature.make();
  feature.with(with);
  feature.without(without);
  Variant present(std::move(with), bench), absent(std::move(without), bench);
  std::mt19937 random(1);
  for (int round = 0; round < bench.rounds; ++round) {
    std::vector<Variant*> order = {&present, &absent};
    std::ranges::shuffle(order, random);
    for (Variant* variant : order) {
      const auto [highendMs, mobileMs] = variant->run();
      variant->highend.laterMs.push_back(highendMs);
      variant->mobile.laterMs.push_back(mobileMs);
    }
  }
  fmt::print("| {} |", feature.name);
  for (const auto path : {&Variant::highend, &Variant::mobile})
    fmt::print(" {:.1f} | {:.1f} | {:.2f} |", (present.*path).median(), (absent.*path).median(),
               (present.*path).median() / (absent.*path).median());
  for (const auto path : {&Variant::highend, &Variant::mobile})
    fmt::print(" {:.0f}, {:.0f} |", (present.*path).firstMs - (present.*path).median(),
               (absent.*path).firstMs - (absent.*path).median());
  fmt::print("\n");
  std::fflush(stdout);
}

} // namespace
} // namespace parity::bench

int main(int argc, char** argv) {
  using namespace parity;
  bench::Settings settings;
  if (argc > 1) settings.size = std::atoi(argv[1]);
  if (argc > 2) settings.rounds = std::atoi(argv[2]);
  if (argc > 3) settings.features = argv[3];
  if (settings.size < 16 || settings.size > 4096 || settings.rounds < 1) {
    fmt::print(stderr, "bench_skip [SIZE [ROUNDS [GLOB]]]: 16 to 4096 pixels, at least 1 round\n");
    return static_cast<int>(base::ExitCode::usage);
  }
  try {
    fmt::print(
        "| feature | high-end with, ms | without | ratio | mobile with, ms | without | ratio | compiling high-end, "
        "ms | compiling mobile |\n|---|---|---|---|---|---|---|---|---|\n");
    for (const bench::Feature& feature : bench::listFeatures())
      if (base::matchesGlob(settings.features, feature.name)) bench::compare(feature, settings);
  } catch (const base::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
