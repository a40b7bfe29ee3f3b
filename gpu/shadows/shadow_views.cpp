#include "gpu/shadows/shadow_views.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "gpu/shadows/smallest_square.h"

namespace parity::gpu {

namespace {

constexpr float kMaxConeAngle = 1.0471976f; // half: 60 degrees
// Of the distance to the farthest caster: what is nearer to a light casts no shadow.
constexpr float kNearShare = 0x1p-20f;
// Of the scene's largest coordinate: positions are 32-bit floats, wrong by a few 2^-24 of what they were computed from.
constexpr float kCoordinateError = 0x1p-19f;

bool casts(const scenes::Light& light) { return std::max({light.color.x, light.color.y, light.color.z}) > 0; }

// Any frame about an axis.
void aim(ShadowView& view, const glm::vec3& forward) {
  view.forward = forward;
  view.right =
      glm::normalize(glm::cross(std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0), forward));
  view.up = glm::cross(forward, view.right);
}

ShadowView directionalView(const scenes::Light& light, const Casters& casters) {
  ShadowView view;
  view.orthographic = true;
  aim(view, light.direction);
  std::vector<glm::vec2> points;
  float near = INFINITY, far = -INFINITY;
  for (const Caster& caster : casters.list) {
    if (!castsAlong(caster, light.direction)) continue;
    view.casters.push_back(caster.instance);
    for (const glm::vec3& p : caster.corners) {
      points.emplace_back(glm::dot(view.right, p), glm::dot(view.up, p));
      near = std::min(near, glm::dot(view.forward, p));
      far = std::max(far, glm::dot(view.forward, p));
    }
  }
  if (points.empty()) return view;
  const Square square = smallestSquare(points);
  const glm::vec3 right = square.axis.x * view.right + square.axis.y * view.up;
  const glm::vec3 center = square.center.x * view.right + square.center.y * view.up;
  view.right = right;
  view.up = glm::cross(view.forward, right);
  const float error = kCoordinateError * casters.extent;
  const float margin = std::max({1e-3f * (far - near), 1e-3f * square.halfSide, 8 * error, 1e-9f});
  view.extent = square.halfSide + margin;
  view.origin = center + (near - margin) * view.forward;
  view.near = 0;
  view.far = far - near + 2 * margin;
  return view;
}

float distanceTo(const scenes::Bounds& bounds, const glm::vec3& p) {
  return glm::length(glm::max(glm::max(bounds.lower - p, p - bounds.upper), glm::vec3(0.f)));
}
float farthestOf(const scenes::Bounds& bounds, const glm::vec3& p) {
  return glm::length(glm::max(glm::abs(bounds.lower - p), glm::abs(bounds.upper - p)));
}

// Whether some of the box may lie in the view's pyramid: not all corners are on one wrong side.
bool mayBeSeen(const ShadowView& view, float extent, const Caster& caster) {
  unsigned outside = ~0u;
  for (const glm::vec3& corner : caster.corners) {
    const glm::vec3 d = corner - view.origin;
    const float x = glm::dot(view.right, d), y = glm::dot(view.up, d), z = glm::dot(view.forward, d) * extent;
    outside &= (x > z ? 1u : 0) | (x < -z ? 2u : 0) | (y > z ? 4u : 0) | (y < -z ? 8u : 0) | (z < 0 ? 16u : 0);
  }
  return outside == 0;
}

struct Reached {
  const Caster* caster;
  float nearest, farthest;
};

std::vector<Reached> castersInReach(const scenes::Light& light, const std::vector<Caster>& casters) {
  std::vector<Reached> reached;
  for (const Caster& caster : casters) {
    const float nearest = distanceTo(caster.bounds, light.position);
    if ((light.range > 0 && nearest >= light.range) || !castsAwayFrom(caster, light.position)) continue;
    const float farthest = farthestOf(caster.bounds, light.position);
    reached.push_back({&caster, nearest, light.range > 0 ? std::min(farthest, light.range) : farthest});
  }
  return reached;
}

// A cone from the light: cosine of half its angle, below 0 where it is wider than a half space.
struct Cone {
  glm::vec3 axis{0.f, 0.f, 1.f};
  float cosine = -1;
};

// About all of these casters.
Cone coneAbout(const scenes::Light& light, const std::vector<Reached>& reached) {
  scenes::Bounds bounds{glm::vec3(INFINITY), glm::vec3(-INFINITY)};
  for (const Reached& each : reached) {
    if (each.nearest == 0) return {};
    bounds.lower = glm::min(bounds.lower, each.caster->bounds.lower);
    bounds.upper = glm::max(bounds.upper, each.caster->bounds.upper);
  }
  const glm::vec3 towards = bounds.center() - light.position;
  if (!(glm::length(towards) > 0)) return {};
  Cone cone{glm::normalize(towards), 1};
  for (const Reached& each : reached)
    for (const glm::vec3& corner : each.caster->corners)
      cone.cosine = std::min(cone.cosine, glm::dot(glm::normalize(corner - light.position), cone.axis));
  return cone;
}

// One about the casters or the light's cone, whichever is narrower, if that is narrow enough; else six of a cube.
std::vector<ShadowView> aimLocalViews(const scenes::Light& light, const std::vector<Reached>& reached) {
  Cone cone = coneAbout(light, reached);
  float margin = 1.02f; // for the soft edges about what casts
  if (light.kind == scenes::LightKind::spot && std::cos(light.outerConeAngle) > cone.cosine) {
    cone = {light.direction, std::cos(light.outerConeAngle)};
    margin = 1; // all is dark there
  }
  std::vector<ShadowView> views;
  if (cone.cosine >= std::cos(kMaxConeAngle)) {
    ShadowView& view = views.emplace_back();
    aim(view, cone.axis);
    view.extent = std::max(margin * std::sqrt(std::max(1 - cone.cosine * cone.cosine, 0.f)) / cone.cosine, 1e-4f);
  } else {
    for (int face = 0; face < 6; ++face) {
      glm::vec3 axis(0.f);
      axis[face / 2] = face % 2 ? -1.f : 1.f;
      aim(views.emplace_back(), axis);
    }
  }
  for (ShadowView& view : views) view.origin = light.position;
  return views;
}

// Fills `casters`, and the near plane that they leave. The views have their texels.
void findCastersOf(std::vector<ShadowView>& views, const scenes::Light& light, const std::vector<Reached>& reached,
                   std::uint32_t filter) {
  for (ShadowView& view : views) {
    // A face of a cube, 54.8 degrees about its axis at its corners, that a spot's cone does not touch stays empty.
    if (light.kind == scenes::LightKind::spot && views.size() == 6 &&
        std::acos(std::clamp(glm::dot(view.forward, light.direction), -1.f, 1.f)) > light.outerConeAngle + 0.9561f)
      continue;
    const float extent = shadowExtent(view, filter);
    float nearest = INFINITY, farthest = 0;
    for (const Reached& each : reached)
      if (mayBeSeen(view, extent, *each.caster)) {
        view.casters.push_back(each.caster->instance);
        nearest = std::min(nearest, each.nearest);
        farthest = std::max(farthest, each.farthest);
      }
    // A corner of a face is sqrt(3) times as far from the light as along its axis, with the guard a little more.
    view.near = std::max({nearest / (2 + extent), kNearShare * farthest, 1e-30f});
    view.far = INFINITY;
  }
}

// Texels a side, where maps are to shrink by so much: local lights' first.
std::uint32_t sideOf(const ShadowOptions& options, bool isSun, bool isCube, std::uint32_t shrink) {
  const std::uint32_t ofLocal = std::max(1u, options.mapSize / (4 * kMinTile));
  if (isSun) return std::max(kMinShadowMapSize, options.mapSize / std::max(1u, shrink / ofLocal));
  return std::max(kMinTile, options.mapSize / (isCube ? 4 : 2) / shrink);
}

std::vector<ShadowView> viewsOf(const scenes::Light& light, const Casters& casters, const ShadowOptions& options,
                                std::uint32_t shrink) {
  const bool isSun = light.kind == scenes::LightKind::directional;
  const std::vector<Reached> reached = isSun ? std::vector<Reached>() : castersInReach(light, casters.list);
  std::vector<ShadowView> views = isSun ? std::vector{directionalView(light, casters)} : aimLocalViews(light, reached);
  for (ShadowView& view : views) view.side = sideOf(options, isSun, views.size() > 1, shrink);
  if (!isSun) findCastersOf(views, light, reached, options.filter);
  bool any = false;
  for (ShadowView& view : views) {
    if (view.casters.empty()) view.side = 0;
    any |= view.side > 0;
    view.bias = kCoordinateError * casters.extent;
  }
  return any ? views : std::vector<ShadowView>();
}

// The lights that need maps of their own, and whose maps each light has.
struct Distinct {
  std::vector<const scenes::Light*> lights;
  std::vector<std::optional<std::size_t>> ofLight;
};
Distinct distinctLights(const std::vector<scenes::Light>& lights) {
  Distinct distinct;
  std::map<ShadowKey, std::size_t> known;
  for (const scenes::Light& light : lights) {
    distinct.ofLight.emplace_back();
    if (!casts(light)) continue;
    const auto [at, isNew] = known.try_emplace(shadowKey(light), distinct.lights.size());
    if (isNew) distinct.lights.push_back(&light);
    distinct.ofLight.back() = at->second;
  }
  return distinct;
}

ShadowPlan planOnce(const std::string& scene, const Casters& casters, const Distinct& distinct,
                    const ShadowOptions& options, std::uint32_t shrink) {
  std::vector<std::vector<ShadowView>> views(distinct.lights.size());
  std::atomic<std::uint64_t> draws = 0;
  base::parallelFor(views.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end && draws <= kMaxShadowDraws; ++k) {
      views[k] = viewsOf(*distinct.lights[k], casters, options, shrink);
      for (const ShadowView& view : views[k]) draws += view.casters.size();
    }
  });
  if (draws > kMaxShadowDraws)
    throw base::fileError(
        scene, "shadows",
        fmt::format("the shadow maps of {} lights draw more than {} instances; give the lights a range",
                    distinct.lights.size(), kMaxShadowDraws));
  ShadowPlan plan;
  std::vector<ShadowOfLight> of;
  for (std::vector<ShadowView>& each : views) {
    of.push_back({static_cast<std::uint32_t>(plan.views.size()), static_cast<std::uint32_t>(each.size())});
    std::move(each.begin(), each.end(), std::back_inserter(plan.views));
  }
  for (const std::optional<std::size_t>& light : distinct.ofLight)
    plan.lights.push_back(light ? of[*light] : ShadowOfLight());
  plan.shrunk = shrink > 1;
  return plan;
}

// With maps that shrink by so much.
std::uint64_t bytesOf(const ShadowPlan& plan, const ShadowOptions& options, std::uint32_t shrink) {
  std::uint64_t texels = 0;
  for (const ShadowOfLight& light : std::set(plan.lights.begin(), plan.lights.end()))
    for (std::uint32_t k = light.first; k < light.first + light.count; ++k)
      if (const ShadowView& view = plan.views[k]; view.side > 0) {
        const std::uint64_t side = sideOf(options, view.orthographic, light.count > 1, shrink);
        texels += side * side;
      }
  return texels * sizeof(float);
}

} // namespace

ShadowKey shadowKey(const scenes::Light& l) {
  const bool local = l.kind != scenes::LightKind::directional, aimed = l.kind != scenes::LightKind::point;
  return {static_cast<int>(l.kind),
          local ? std::array{l.position.x, l.position.y, l.position.z} : std::array<float, 3>{},
          aimed ? std::array{l.direction.x, l.direction.y, l.direction.z} : std::array<float, 3>{}, local ? l.range : 0,
          l.kind == scenes::LightKind::spot ? l.outerConeAngle : 0};
}

ShadowPlan planShadows(const scenes::Scene& scene, const std::vector<scenes::Light>& lights,
                       const ShadowOptions& options) {
  Casters casters = findCasters(scene);
  const Distinct distinct = distinctLights(lights);
  std::uint32_t shrink = 1;
  for (;;) {
    ShadowPlan plan = planOnce(scene.name, casters, distinct, options, shrink);
    if (bytesOf(plan, options, shrink) <= options.maxBytes) {
      plan.casters = std::move(casters.list);
      return plan;
    }
    // As far as these maps need it; smaller ones see a little more beside them, which may take another round.
    constexpr std::uint32_t kMost = kMaxShadowMapSize * kMaxShadowMapSize;
    while (shrink < kMost && bytesOf(plan, options, shrink) > options.maxBytes) shrink *= 2;
    if (bytesOf(plan, options, shrink) > options.maxBytes)
      throw base::fileError(scene.name, "shadows",
                            fmt::format("the smallest shadow maps of {} lights need {} MiB, expected at most {}",
                                        distinct.lights.size(), bytesOf(plan, options, shrink) >> 20,
                                        options.maxBytes >> 20));
  }
}

} // namespace parity::gpu
