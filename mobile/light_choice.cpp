#include "mobile/light_choice.h"

#include <algorithm>
#include <cmath>

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

float rank(const scenes::Light& light, const Sphere& sphere) {
  if (light.kind == scenes::LightKind::spot && !coneMayTouch(light, sphere)) return 0;
  const float distance = std::max(glm::length(light.position - sphere.center) - sphere.radius, 0.f);
  return luminanceOf(light.color) *
         static_cast<float>(shading::f32::squareFalloffUE4(distance * distance, light.range));
}

// By luminance, the first among equals.
std::optional<std::size_t> brightest(std::span<const scenes::Light> lights, scenes::LightKind kind) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].kind == kind && (!best || luminanceOf(lights[i].color) > luminanceOf(lights[*best].color))) best = i;
  return best;
}

} // namespace

std::optional<std::size_t> chooseSun(std::span<const scenes::Light> lights) {
  return brightest(lights, scenes::LightKind::directional);
}

std::optional<std::size_t> chooseShadowSpot(std::span<const scenes::Light> lights) {
  return brightest(lights, scenes::LightKind::spot);
}

std::vector<std::array<std::uint32_t, kLightsPerObject>> chooseLocalLights(const scenes::Scene& scene,
                                                                           std::span<const scenes::Light> lights) {
  std::vector<std::array<std::uint32_t, kLightsPerObject>> chosen;
  for (const scenes::Instance& instance : scene.instances) {
    const Sphere sphere = boundingSphere(scene, instance);
    std::vector<std::pair<float, std::uint32_t>> ranked;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
      if (lights[i].kind == scenes::LightKind::directional) continue;
      if (const float r = rank(lights[i], sphere); r > 0) ranked.emplace_back(r, i);
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    auto& slots = chosen.emplace_back();
    slots.fill(kNoLight);
    for (std::size_t k = 0; k < std::min<std::size_t>(ranked.size(), kLightsPerObject); ++k)
      slots[k] = ranked[k].second;
  }
  return chosen;
}

} // namespace parity::mobile
