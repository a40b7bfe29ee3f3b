#include "mobile/light_choice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "scenes/brightest_light.h"
#include "shading/shading.h"

namespace parity::mobile {

namespace {

float luminanceOf(const glm::vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

struct Sphere {
  glm::vec3 center{0.f};
  float radius = 0;
};

// World-space sphere about the box of the instance's vertices.
Sphere boundingSphere(const scenes::Scene& scene, const scenes::Instance& instance) {
  glm::vec3 lower(INFINITY), upper(-INFINITY);
  for (const glm::vec3& position : scene.meshes[instance.mesh].positions) {
    const glm::vec3 p(instance.toWorld * glm::vec4(position, 1));
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  return {0.5f * (lower + upper), 0.5f * glm::length(upper - lower)};
}

bool coneMayTouch(const scenes::Light& light, const Sphere& sphere) {
  const glm::vec3 d = sphere.center - light.position;
  const float distance = glm::length(d);
  if (distance <= sphere.radius) return true;
  const float angle = std::acos(std::clamp(glm::dot(d, light.direction) / distance, -1.f, 1.f));
  return angle <= light.outerConeAngle + std::asin(sphere.radius / distance);
}

// Of the point of the sphere that is nearest to the light.
float distanceTo(const scenes::Light& light, const Sphere& sphere) {
  return std::max(glm::length(light.position - sphere.center) - sphere.radius, 0.f);
}

float rank(const scenes::Light& light, const Sphere& sphere) {
  if (light.kind == scenes::LightKind::spot && !coneMayTouch(light, sphere)) return 0;
  const float distance = distanceTo(light, sphere);
  return luminanceOf(light.color) * shading::f32::distanceFalloff(static_cast<int>(light.falloff), distance * distance,
                                                                  light.range, light.falloffExponent);
}

// About the mean over the object of a light of this rank: that is of the nearest point, and by an inverse square has no
// bound within the sphere; the object's surface lies about half a radius away, and a light that fades before it lights
// a part of it.
float meanOver(const Sphere& sphere, const scenes::Light& light, float rank) {
  if (light.falloff == scenes::Falloff::exponent) return rank;
  const float distance = distanceTo(light, sphere), d2 = std::max(distance * distance, 1e-4f); // as it is cut off there
  return rank * std::min(4 * d2 / (sphere.radius * sphere.radius), 1.f);
}

struct RankedLight {
  float rank = 0, mean = 0;
  std::uint32_t light = 0;
};

// The local lights that reach the instance, the brightest first.
std::vector<RankedLight> rankLocalLights(const scenes::Scene& scene, const scenes::Instance& instance,
                                         std::span<const scenes::Light> lights) {
  const Sphere sphere = boundingSphere(scene, instance);
  std::vector<RankedLight> ranked;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    if (lights[i].kind == scenes::LightKind::directional) continue;
    if (const float r = rank(lights[i], sphere); r > 0) ranked.push_back({r, meanOver(sphere, lights[i], r), i});
  }
  std::ranges::stable_sort(ranked, std::greater<>(), &RankedLight::rank);
  return ranked;
}

std::size_t mostOf(LightLimit limit) {
  if (limit == LightLimit::all) return std::numeric_limits<std::size_t>::max();
  return limit == LightLimit::four ? kLightsPerObject : 0;
}

} // namespace

std::vector<std::array<std::uint32_t, kLightsPerObject>> chooseLocalLights(const scenes::Scene& scene,
                                                                           std::span<const scenes::Light> lights) {
  std::vector<std::array<std::uint32_t, kLightsPerObject>> chosen;
  for (const scenes::Instance& instance : scene.instances) {
    const std::vector<RankedLight> ranked = rankLocalLights(scene, instance, lights);
    auto& slots = chosen.emplace_back();
    slots.fill(kNoLight);
    for (std::size_t k = 0; k < std::min<std::size_t>(ranked.size(), kLightsPerObject); ++k) slots[k] = ranked[k].light;
  }
  return chosen;
}

LightLimit lightLimitOf(const Options& options) {
  if (!options.localLights) return LightLimit::none;
  return options.lightCap ? LightLimit::four : LightLimit::all;
}

std::vector<LightUse> countLightUse(const scenes::Scene& scene, std::span<const scenes::Light> lights, LightLimit limit,
                                    std::span<const std::uint64_t> pixels) {
  std::vector<LightUse> uses(lights.size());
  const auto sun = scenes::brightestOf(lights, scenes::LightKind::directional);
  const std::size_t kept = mostOf(limit);
  for (std::uint32_t object = 0; object < scene.instances.size(); ++object) {
    if (pixels[object] == 0) continue;
    const auto count = [&](std::size_t light, float brightness, bool keeps) {
      LightUse& use = uses[light];
      if (keeps) return void(++use.keptBy);
      use.droppedBy.push_back(object);
      use.effect += static_cast<double>(brightness) * static_cast<double>(pixels[object]);
    };
    for (std::size_t i = 0; i < lights.size(); ++i)
      if (const float brightness = luminanceOf(lights[i].color);
          lights[i].kind == scenes::LightKind::directional && brightness > 0)
        count(i, brightness, i == sun);
    const std::vector<RankedLight> ranked = rankLocalLights(scene, scene.instances[object], lights);
    for (std::size_t k = 0; k < ranked.size(); ++k) count(ranked[k].light, ranked[k].mean, k < kept);
  }
  return uses;
}

bool mayDropLights(std::span<const scenes::Light> lights, LightLimit limit) {
  const auto suns = std::ranges::count(lights, scenes::LightKind::directional, &scenes::Light::kind);
  const std::size_t locals = lights.size() - static_cast<std::size_t>(suns);
  return suns > 1 || locals > mostOf(limit);
}

} // namespace parity::mobile
