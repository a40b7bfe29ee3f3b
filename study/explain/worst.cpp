#include "study/explain/worst.h"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <random>
#include <span>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/toml_string.h"
#include "job/context.h"
#include "study/explain/two_devices.h"
#include "study/explain/worst_stage.h"

namespace parity::explain {

namespace {

constexpr float kLeastPhi = 15, kMostPhi = 95, kLeastElevation = 5, kMostElevation = 85;
constexpr float kNearest = 0.5f;   // of the distance that fits the scene
constexpr double kSamePeak = 0.05; // views nearer than that, in shares of the domain, climb one peak
constexpr std::size_t kConfirmed = 4;

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

// What is searched, and by which rules.
class Domain {
public:
  Domain(const job::SceneRequest& request, const WorstOptions& options) : m_request(request), m_options(options) {
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
  float rotationOf(std::size_t k) const { return 360.f * static_cast<float>(k) / static_cast<float>(rotations()); }
  std::vector<bool> periodic() const {
    return m_request.settings.scene.sun ? std::vector<bool>{true, false, false, true, false}
                                        : std::vector<bool>{true, false, false};
  }
  double valueAt(Stage& stage, const std::vector<double>& at) const {
    const Place place = placeOf(at, stage.radius());
    return stage.look(place.orbit, place.sun, m_least).flip;
  }

private:
  const job::SceneRequest& m_request;
  const WorstOptions& m_options;
  std::uint64_t m_least = 0;
};

struct Found {
  Peak peak;
  float rotation = 0, radius = 1;
};

// Of so many points. A search that has few of them has slow pictures.
int refinedFor(int points) { return points < 300 ? 6 : points < 1500 ? 8 : 24; }

class Search {
public:
  Search(job::Context& context, const job::SceneRequest& request, const WorstOptions& options,
         const job::Progress& progress)
      : m_context(context), m_request(request), m_options(options), m_progress(progress), m_domain(request, options) {
    m_result.scene = request.name;
  }

  WorstResult run() {
    spread();
    choose();
    refineChosen();
    confirm();
    return std::move(m_result);
  }

private:
  CostlyFunction valueIn(job::Context& context, Stage& stage) {
    return [&](const std::vector<double>& at) {
      context.requireGoesOn();
      {
        const std::lock_guard lock(m_mutex);
        if (m_progress)
          m_progress(m_request.name + ": looking for the worst view",
                     0.95 * std::min(1.0, static_cast<double>(m_result.pictures) / m_planned));
        ++m_result.pictures;
      }
      return m_domain.valueAt(stage, at);
    };
  }

  // Other views under each rotation.
  void spread() {
    const auto rotations = static_cast<std::size_t>(m_domain.rotations());
    std::vector<std::vector<Found>> of(rotations);
    onTwoDevices(m_context, rotations, [&](job::Context& context, std::size_t k) {
      Stage stage(context, m_request, m_options.size, m_domain.rotationOf(k));
      const int wanted = m_options.points > 0 ? m_options.points : pointsFor(stage.triangles());
      const int share = std::max(1, wanted / m_domain.rotations());
      {
        const std::lock_guard lock(m_mutex);
        m_refined = m_options.refined > 0 ? m_options.refined : refinedFor(wanted);
        m_planned = share * m_domain.rotations() + m_refined * m_options.steps;
      }
      for (Peak& point :
           spreadPoints(valueIn(context, stage), m_domain.periodic().size(), share, static_cast<int>(k) * share))
        if (point.value > 0) of[k].push_back({std::move(point), m_domain.rotationOf(k), stage.radius()});
    });
    for (std::vector<Found>& each : of) std::ranges::move(each, std::back_inserter(m_found));
  }

  // The best, each peak once.
  void choose() {
    std::ranges::stable_sort(m_found, std::greater(), [](const Found& f) { return f.peak.value; });
    std::vector<Found> chosen;
    for (const Found& each : m_found) {
      const bool isKnown = std::ranges::any_of(chosen, [&](const Found& other) {
        return each.rotation == other.rotation &&
               distanceOf(each.peak.at, other.peak.at, m_domain.periodic()) < kSamePeak;
      });
      if (!isKnown) chosen.push_back(each);
      if (chosen.size() == static_cast<std::size_t>(m_refined)) break;
    }
    m_found = std::move(chosen);
  }

  // A stage serves neighbours of one rotation; each device has half of the peaks at least.
  void refineChosen() {
    std::ranges::stable_sort(m_found, {}, &Found::rotation);
    std::vector<std::span<Found>> parts;
    const std::size_t most = (m_found.size() + 1) / 2;
    for (std::size_t first = 0; first < m_found.size();) {
      std::size_t end = first;
      while (end < m_found.size() && end - first < most && m_found[end].rotation == m_found[first].rotation) ++end;
      parts.push_back(std::span(m_found).subspan(first, end - first));
      first = end;
    }
    onTwoDevices(m_context, parts.size(), [&](job::Context& context, std::size_t k) {
      Stage stage(context, m_request, m_options.size, parts[k].front().rotation);
      for (Found& each : parts[k])
        each.peak = refine(valueIn(context, stage), m_domain.periodic(), each.peak, m_options.steps);
    });
    std::ranges::stable_sort(m_found, std::greater(), [](const Found& f) { return f.peak.value; });
    m_found.resize(std::min(m_found.size(), kConfirmed));
  }

  // At the request's size; and the request's own view.
  void confirm() {
    std::vector<float> rotations = {0};
    for (const Found& each : m_found)
      if (std::ranges::count(rotations, each.rotation) == 0) rotations.push_back(each.rotation);
    std::vector<std::optional<WorstView>> views(m_found.size());
    onTwoDevices(m_context, rotations.size(), [&](job::Context& context, std::size_t k) {
      Stage stage(context, m_request, 0, rotations[k]);
      for (std::size_t i = 0; i < m_found.size(); ++i) {
        if (m_found[i].rotation != rotations[k]) continue;
        const Place place = placeOf(m_found[i].peak.at, m_found[i].radius);
        const Outcome outcome = stage.look(place.orbit, place.sun, kLeastWorstPixels);
        if (outcome.pixels > 0)
          views[i] = WorstView{outcome.material,
                               outcome.flip,
                               m_found[i].peak.value,
                               outcome.pixels,
                               place.orbit,
                               place.sun,
                               m_request.settings.scene.environmentRotationDeg + rotations[k]};
      }
      if (k > 0) return;
      const Outcome outcome = stage.look(m_request.views.front(), std::nullopt, kLeastWorstPixels);
      m_result.given.material = outcome.material;
      m_result.given.flip = outcome.flip;
      m_result.given.pixels = outcome.pixels;
    });
    for (const std::optional<WorstView>& view : views)
      if (view) m_result.views.push_back(*view);
    if (m_result.views.empty())
      throw base::Error(base::ExitCode::notComparable, m_request.scene, "worst",
                        fmt::format("no view shows {} pixels of a chosen material", kLeastWorstPixels));
    std::ranges::stable_sort(m_result.views, std::greater(), &WorstView::flip);
  }

  job::Context& m_context;
  const job::SceneRequest& m_request;
  const WorstOptions& m_options;
  const job::Progress& m_progress;
  Domain m_domain;
  std::vector<Found> m_found;
  std::mutex m_mutex; // of all below
  int m_planned = 1;  // pictures
  int m_refined = 0;
  WorstResult m_result;
};

} // namespace

int pointsFor(std::size_t triangles) {
  // A picture takes as long as 10,000 triangles, and its own; 30 to 60 s for a search, measured on two cores
  // (bench/worst_bench.cpp).
  constexpr double kWork = 3.2e7, kOfAPicture = 1e4;
  constexpr int kFewest = 250, kMost = 2000;
  return std::clamp(static_cast<int>(kWork / (static_cast<double>(triangles) + kOfAPicture)), kFewest, kMost);
}

WorstResult findWorst(job::Context& context, const job::SceneRequest& request, const WorstOptions& options,
                      const job::Progress& progress) {
  return Search(context, request, options, progress).run();
}

double worstOfRandomViews(job::Context& context, const job::SceneRequest& request, const WorstOptions& options,
                          int views, unsigned seed) {
  const Domain domain(request, options);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0, 1);
  double worst = 0;
  const auto rotations = static_cast<std::size_t>(domain.rotations());
  for (std::size_t k = 0; k < rotations; ++k) {
    Stage stage(context, request, options.size, domain.rotationOf(k));
    for (int i = 0; i < views / domain.rotations(); ++i) {
      std::vector<double> at(domain.periodic().size());
      std::ranges::generate(at, [&] { return any(random); });
      worst = std::max(worst, domain.valueAt(stage, at));
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
