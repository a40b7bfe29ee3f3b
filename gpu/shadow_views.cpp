#include "gpu/shadow_views.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "base/error.h"
#include "gpu/shadow_casters.h"

namespace parity::gpu {

namespace {

constexpr float kMaxSpotAngle = 1.0471976f; // half: 60 degrees
// Of the distance to the farthest caster: what is nearer to a light casts no shadow.
constexpr float kNearShare = 1.f / 4096;

bool casts(const scenes::Light& light) { return std::max({light.color.x, light.color.y, light.color.z}) > 0; }

// Any frame about an axis.
void aim(ShadowView& view, const glm::vec3& forward) {
  view.forward = forward;
  view.right =
      glm::normalize(glm::cross(std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0), forward));
  view.up = glm::cross(forward, view.right);
}

float cross(const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; }

// Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions".
std::vector<glm::vec2> convexHull(std::vector<glm::vec2> points) {
  std::sort(points.begin(), points.end(), [](auto a, auto b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::vec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const glm::vec2& p : points) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull.empty() ? points : hull;
}

// The smallest square about the points of those that share a direction with an edge of their hull.
struct Square {
  glm::vec2 axis{1.f, 0.f}, center{0.f};
  float halfSide = INFINITY;
};
Square smallestSquare(const std::vector<glm::vec2>& points) {
  const std::vector<glm::vec2> hull = convexHull(points);
  Square best;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const glm::vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    const float length = glm::length(edge);
    const glm::vec2 x = length > 0 ? edge / length : glm::vec2(1, 0), y(-x.y, x.x);
    glm::vec2 lower(INFINITY), upper(-INFINITY);
    for (const glm::vec2& p : hull) {
      const glm::vec2 q(glm::dot(x, p), glm::dot(y, p));
      lower = glm::min(lower, q);
      upper = glm::max(upper, q);
    }
    const glm::vec2 size = upper - lower, middle = 0.5f * (lower + upper);
    if (const float half = 0.5f * std::max(size.x, size.y); half < best.halfSide)
      best = {x, middle.x * x + middle.y * y, half};
  }
  return best;
}

ShadowView directionalView(const scenes::Light& light, const std::vector<Caster>& casters) {
  ShadowView view;
  view.orthographic = true;
  aim(view, light.direction);
  std::vector<glm::vec2> points;
  float near = INFINITY, far = -INFINITY;
  for (const Caster& caster : casters) {
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
  const float margin = 1e-3f * std::max({far - near, square.halfSide, 1e-6f});
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

// The six of a cube, or one along the axis of a spot.
std::vector<ShadowView> startLocalViews(const scenes::Light& light) {
  std::vector<ShadowView> views;
  if (light.kind == scenes::LightKind::spot && light.outerConeAngle <= kMaxSpotAngle) {
    ShadowView& view = views.emplace_back();
    aim(view, light.direction);
    view.extent = std::tan(std::max(light.outerConeAngle, 1e-3f));
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
void findCastersOf(std::vector<ShadowView>& views, const scenes::Light& light, const std::vector<Caster>& casters,
                   std::uint32_t filter) {
  std::vector<const Caster*> reached;
  float nearest = INFINITY, farthest = 0;
  for (const Caster& caster : casters) {
    const float distance = distanceTo(caster.bounds, light.position);
    if ((light.range > 0 && distance >= light.range) || !castsAwayFrom(caster, light.position)) continue;
    reached.push_back(&caster);
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, farthestOf(caster.bounds, light.position));
  }
  if (light.range > 0) farthest = std::min(farthest, light.range);
  for (ShadowView& view : views) {
    view.near = std::max(0.5f * nearest, kNearShare * farthest);
    view.far = INFINITY;
    // A face of a cube, 54.8 degrees about its axis at its corners, that a spot's cone does not touch stays empty.
    if (light.kind == scenes::LightKind::spot && views.size() == 6 &&
        std::acos(std::clamp(glm::dot(view.forward, light.direction), -1.f, 1.f)) > light.outerConeAngle + 0.9561f)
      continue;
    const float extent = shadowExtent(view, filter);
    for (const Caster* caster : reached)
      if (mayBeSeen(view, extent, *caster)) view.casters.push_back(caster->instance);
  }
}

std::uint64_t bytesOf(const ShadowPlan& plan) {
  std::uint64_t texels = 0;
  for (const ShadowView& view : plan.views) texels += std::uint64_t{view.side} * view.side;
  return texels * sizeof(float);
}

// localShare: texels of local lights' maps are by so much fewer than asked for.
ShadowPlan planOnce(const std::vector<Caster>& casters, const std::vector<scenes::Light>& lights,
                    const ShadowOptions& options, std::uint32_t localShare) {
  ShadowPlan plan;
  std::map<ShadowKey, ShadowOfLight> known;
  for (const scenes::Light& light : lights) {
    plan.lights.emplace_back();
    if (!casts(light)) continue;
    const auto [at, isNew] = known.try_emplace(shadowKey(light));
    if (isNew) {
      const bool isSun = light.kind == scenes::LightKind::directional;
      std::vector<ShadowView> views = isSun ? std::vector{directionalView(light, casters)} : startLocalViews(light);
      const std::uint32_t share = isSun ? 1 : (views.size() == 1 ? 2 : 4) * localShare;
      for (ShadowView& view : views) view.side = std::max(kMinTile, options.mapSize / share);
      if (!isSun) findCastersOf(views, light, casters, options.filter);
      for (ShadowView& view : views)
        if (view.casters.empty()) view.side = 0;
      if (std::any_of(views.begin(), views.end(), [](const ShadowView& v) { return v.side > 0; })) {
        at->second = {static_cast<std::uint32_t>(plan.views.size()), static_cast<std::uint32_t>(views.size())};
        plan.views.insert(plan.views.end(), views.begin(), views.end());
      }
    }
    plan.lights.back() = at->second;
  }
  return plan;
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
  const std::vector<Caster> casters = findCasters(scene);
  for (std::uint32_t share = 1;; share *= 2) {
    ShadowPlan plan = planOnce(casters, lights, options, share);
    plan.shrunk = share > 1;
    if (bytesOf(plan) <= options.maxBytes) return plan;
    if (options.mapSize / (4 * share) <= kMinTile)
      throw base::fileError(scene.name, "shadows",
                            fmt::format("the maps of {} lights take {} MiB, expected at most {}", lights.size(),
                                        bytesOf(plan) >> 20, options.maxBytes >> 20));
  }
}

} // namespace parity::gpu
