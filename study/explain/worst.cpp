#include "study/explain/worst.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/glob.h"
#include "base/text/toml_string.h"
#include "job/context.h"
#include "job/knobs.h"
#include "scenes/scene_info.h"
#include "scenes/view.h"
#include "study/explain/set_renderer.h"

namespace parity::explain {

namespace {

constexpr float kLeastPhi = 15, kMostPhi = 95, kLeastElevation = 5, kMostElevation = 85;
constexpr float kNearest = 0.5f;   // of the distance that fits the scene
constexpr double kSamePeak = 0.05; // views nearer than that, in shares of the domain, climb one peak
constexpr std::size_t kConfirmed = 4;

struct Outcome {
  std::string material;
  double flip = 0; // 0: none is large enough
  std::uint64_t pixels = 0;
};

// A scene under one rotation of the environment, at one size of picture.
class Stage {
public:
  Stage(job::Context& context, job::SceneRequest request, int size, float rotation)
      : m_context(context), m_request(at(std::move(request), size, rotation)), m_paths(pathsFor(m_request.settings)),
        m_prepared(job::prepareScene(context, m_request, m_paths)) {
    const scenes::ViewRequest& view = m_request.views.front();
    scenes::ViewRequest fitted = view;
    fitted.orbit = glm::vec3(30, 70, 0);
    const scenes::Camera camera = scenes::makeCamera(m_prepared.scene, fitted, aspect());
    const glm::vec3 target = view.target.value_or(m_prepared.scene.bounds().center());
    m_radius = glm::length(glm::vec3(camera.toWorld[3]) - target);
  }

  std::size_t triangles() const { return scenes::describeScene(m_prepared.scene).triangles; }
  bool hasSun() const { return m_request.settings.scene.sun.has_value(); }
  float radius() const { return m_radius; }

  // least: pixels below which a material does not count.
  Outcome look(const glm::vec3& orbit, const std::optional<glm::vec2>& sun, std::uint64_t least) {
    scenes::ViewRequest view = m_request.views.front();
    view.camera.clear();
    view.orbit = orbit;
    return look(view, sun, least);
  }
  Outcome look(const scenes::ViewRequest& view, const std::optional<glm::vec2>& sun, std::uint64_t least) {
    if (sun) turnSun(*sun);
    // Shadow maps are those of one sun.
    if (!m_scene || (sun && m_prepared.settings.shadows))
      m_scene = std::make_unique<job::SceneOnDevice>(m_context, m_prepared, m_prepared.settings, m_paths);
    SetRenderer renderer(m_context, m_prepared, *m_scene, m_prepared.settings, m_paths,
                         scenes::makeCamera(m_prepared.scene, view, aspect()));
    std::vector<std::size_t> materials;
    for (std::size_t m = 0; m < renderer.coverage().size(); ++m)
      if (renderer.coverage()[m].pixels.size() >= least && isChosen(m_prepared.scene.materials[m].name))
        materials.push_back(m);
    Outcome worst;
    if (materials.empty()) return worst;
    const std::vector<double> flip = renderer.flip(m_prepared.settings, SetRenderer::Program::specialised, materials);
    for (std::size_t i = 0; i < flip.size(); ++i)
      if (flip[i] > worst.flip || worst.pixels == 0)
        worst = {m_prepared.scene.materials[materials[i]].name, flip[i],
                 renderer.coverage()[materials[i]].pixels.size()};
    return worst;
  }

private:
  static job::SceneRequest at(job::SceneRequest request, int size, float rotation) {
    if (size > 0) {
      // A search looks at many skies: these are filtered in a tenth of the time. What is found is rendered as it was
      // asked for.
      request.settings = job::withKnobs(
          request.settings, {{"prefilter-size", {{"64"}, "worst"}}, {"prefilter-samples", {{"8"}, "worst"}}});
      const float scale =
          static_cast<float>(size) / static_cast<float>(std::max(request.settings.width, request.settings.height));
      request.settings.width =
          std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(request.settings.width))));
      request.settings.height =
          std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(request.settings.height))));
    }
    request.settings.scene.environmentRotationDeg += rotation;
    return request;
  }
  static job::PathChoice pathsFor(const job::Settings& settings) {
    job::PathChoice choice = job::pathsOf(settings);
    choice.truth = false;
    return choice;
  }
  float aspect() const {
    return static_cast<float>(m_request.settings.width) / static_cast<float>(m_request.settings.height);
  }
  bool isChosen(const std::string& material) const {
    const std::vector<std::string>& globs = m_request.settings.materials;
    return globs.empty() ||
           std::ranges::any_of(globs, [&](const auto& glob) { return base::matchesGlob(glob, material); });
  }
  // --sun is the light behind those of the scene.
  void turnSun(const glm::vec2& sun) {
    scenes::SunRequest request = *m_request.settings.scene.sun;
    request.azimuthDeg = sun.x, request.elevationDeg = sun.y;
    scenes::Light light = scenes::makeSun(request);
    light.specularScale *= m_request.settings.scene.lightScales.sunSpecularScale;
    const std::size_t place = m_prepared.scene.lights.size();
    m_prepared.lights.at(place) = light;
    for (auto& [name, own] : m_prepared.lightOfPath) own.lights.at(place) = light;
  }

  job::Context& m_context;
  job::SceneRequest m_request;
  job::PathChoice m_paths;
  job::PreparedScene m_prepared;
  std::unique_ptr<job::SceneOnDevice> m_scene;
  float m_radius = 1; // of the orbit that fits the scene
};

// A point of the search: theta, phi, distance, and of the sun azimuth and elevation.
struct Place {
  glm::vec3 orbit{0};
  std::optional<glm::vec2> sun;
};
Place placeOf(const std::vector<double>& at, float radius) {
  const auto value = [&](std::size_t i) { return static_cast<float>(at[i]); };
  Place place{
      {360 * value(0), kLeastPhi + (kMostPhi - kLeastPhi) * value(1), radius * (kNearest + (1 - kNearest) * value(2))},
      {}};
  if (at.size() > 3)
    place.sun = glm::vec2(360 * value(3), kLeastElevation + (kMostElevation - kLeastElevation) * value(4));
  return place;
}

class Searcher {
public:
  Searcher(job::Context& context, const job::SceneRequest& request, const WorstOptions& options)
      : m_context(context), m_request(request), m_options(options) {
    const job::Settings& settings = request.settings;
    const auto refuse = [](const char* option, const std::string& what, const char* reason) {
      return base::Error(base::ExitCode::usage, option, what, reason);
    };
    if (!settings.scene.baked.empty())
      throw refuse("--baked", settings.scene.baked,
                   "worst turns the sun and the environment, which baked light cannot follow");
    if (!request.views.front().camera.empty())
      throw refuse("--camera", request.views.front().camera, "worst looks for the camera itself");
    const double share = static_cast<double>(options.size) / std::max(settings.width, settings.height);
    m_least = std::max<std::uint64_t>(16, static_cast<std::uint64_t>(kLeastWorstPixels * std::min(1.0, share * share)));
  }

  int rotations() const { return m_request.settings.scene.environment.empty() ? 1 : m_options.rotations; }
  float rotationOf(int k) const { return 360.f * static_cast<float>(k) / static_cast<float>(rotations()); }
  Stage stage(int size, float rotation) const { return Stage(m_context, m_request, size, rotation); }
  std::vector<bool> periodic(const Stage& stage) const {
    return stage.hasSun() ? std::vector<bool>{true, false, false, true, false} : std::vector<bool>{true, false, false};
  }
  double valueAt(Stage& stage, const std::vector<double>& at) const {
    const Place place = placeOf(at, stage.radius());
    return stage.look(place.orbit, place.sun, m_least).flip;
  }

private:
  job::Context& m_context;
  const job::SceneRequest& m_request;
  const WorstOptions& m_options;
  std::uint64_t m_least = 0;
};

} // namespace

int pointsFor(std::size_t triangles) {
  // A picture takes as long as 10,000 triangles, and its own; 30 to 70 s for a search, measured on two cores
  // (bench/worst_bench.cpp).
  constexpr double kWork = 6.6e7, kOfAPicture = 1e4;
  constexpr int kFewest = 500, kMost = 1600;
  return std::clamp(static_cast<int>(kWork / (static_cast<double>(triangles) + kOfAPicture)), kFewest, kMost);
}

WorstResult findWorst(job::Context& context, const job::SceneRequest& request, const WorstOptions& options,
                      const job::Progress& progress) {
  const Searcher searcher(context, request, options);
  WorstResult result;
  result.scene = request.name;
  const int rotations = searcher.rotations();
  int planned = 1; // pictures
  const auto valueIn = [&](Stage& stage) {
    return [&](const std::vector<double>& at) {
      context.requireGoesOn();
      if (progress)
        progress(request.name + ": looking for the worst view",
                 0.95 * std::min(1.0, static_cast<double>(result.pictures) / planned));
      ++result.pictures;
      return searcher.valueAt(stage, at);
    };
  };
  struct Found {
    Peak peak;
    float rotation, radius;
    std::vector<bool> periodic;
  };
  // Other views under each rotation.
  std::vector<Found> all;
  for (int k = 0; k < rotations; ++k) {
    Stage stage = searcher.stage(options.size, searcher.rotationOf(k));
    const int wanted = options.points > 0 ? options.points : pointsFor(stage.triangles());
    const int share = std::max(1, wanted / rotations);
    planned = share * rotations + options.refined * options.steps;
    const std::vector<bool> periodic = searcher.periodic(stage);
    for (Peak& point : spreadPoints(valueIn(stage), periodic.size(), share, k * share))
      if (point.value > 0) all.push_back({std::move(point), searcher.rotationOf(k), stage.radius(), periodic});
  }
  std::ranges::stable_sort(all, std::greater(), [](const Found& f) { return f.peak.value; });
  // The best are refined, each peak once.
  std::map<float, std::vector<Found>> chosen;
  int count = 0;
  for (const Found& each : all) {
    std::vector<Found>& others = chosen[each.rotation];
    const bool isNew = std::ranges::none_of(
        others, [&](const Found& other) { return distanceOf(each.peak.at, other.peak.at, each.periodic) < kSamePeak; });
    if (isNew) others.push_back(each), ++count;
    if (count == options.refined) break;
  }
  std::vector<Found> found;
  for (auto& [rotation, peaks] : chosen) {
    if (peaks.empty()) continue;
    Stage stage = searcher.stage(options.size, rotation);
    for (Found& each : peaks) {
      each.peak = refine(valueIn(stage), each.periodic, each.peak, options.steps);
      found.push_back(each);
    }
  }
  std::ranges::stable_sort(found, std::greater(), [](const Found& f) { return f.peak.value; });
  found.resize(std::min(found.size(), kConfirmed));
  std::map<float, std::vector<const Found*>> byRotation;
  for (const Found& each : found) byRotation[each.rotation].push_back(&each);
  for (const auto& [rotation, peaks] : byRotation) {
    Stage stage = searcher.stage(0, rotation);
    for (const Found* each : peaks) {
      const Place place = placeOf(each->peak.at, each->radius);
      const Outcome outcome = stage.look(place.orbit, place.sun, kLeastWorstPixels);
      if (outcome.pixels > 0)
        result.views.push_back({outcome.material, outcome.flip, each->peak.value, outcome.pixels, place.orbit,
                                place.sun, request.settings.scene.environmentRotationDeg + rotation});
    }
  }
  if (result.views.empty())
    throw base::Error(base::ExitCode::notComparable, request.scene, "worst",
                      fmt::format("no view shows {} pixels of a chosen material", kLeastWorstPixels));
  std::ranges::stable_sort(result.views, std::greater(), &WorstView::flip);
  Stage given = searcher.stage(0, 0);
  const Outcome outcome = given.look(request.views.front(), std::nullopt, kLeastWorstPixels);
  result.given.material = outcome.material;
  result.given.flip = outcome.flip;
  result.given.pixels = outcome.pixels;
  return result;
}

double worstOfRandomViews(job::Context& context, const job::SceneRequest& request, const WorstOptions& options,
                          int views, unsigned seed) {
  const Searcher searcher(context, request, options);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0, 1);
  double worst = 0;
  for (int k = 0; k < searcher.rotations(); ++k) {
    Stage stage = searcher.stage(options.size, searcher.rotationOf(k));
    for (int i = 0; i < views / searcher.rotations(); ++i) {
      std::vector<double> at(searcher.periodic(stage).size());
      std::ranges::generate(at, [&] { return any(random); });
      worst = std::max(worst, searcher.valueAt(stage, at));
    }
  }
  return worst;
}

std::string toToml(const WorstView& view, const job::SceneRequest& request) {
  const scenes::SceneSettings& scene = request.settings.scene;
  std::string text = fmt::format("[[scene]]\nname = {}\nfile = {}\n", base::tomlString(request.name + ", worst"),
                                 base::tomlString(request.scene));
  if (!scene.environment.empty()) text += fmt::format("env = {}\n", base::tomlString(scene.environment));
  if (view.rotation != 0) text += fmt::format("env_rotation = {:g}\n", view.rotation);
  if (view.sun) text += fmt::format("sun = [{:.2f}, {:.2f}, {:g}]\n", view.sun->x, view.sun->y, scene.sun->lux);
  text += fmt::format("\n  [[scene.view]]\n  name = {}\n  orbit = [{:.2f}, {:.2f}, {:.5g}]\n",
                      base::tomlString("worst of " + view.material), view.orbit.x, view.orbit.y, view.orbit.z);
  if (const std::optional<glm::vec3>& target = request.views.front().target)
    text += fmt::format("  target = [{:g}, {:g}, {:g}]\n", target->x, target->y, target->z);
  return text;
}

} // namespace parity::explain
