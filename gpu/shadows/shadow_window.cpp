#include "gpu/shadows/shadow_window.h"

#include <algorithm>
#include <cmath>

namespace parity::gpu {

namespace {

struct Region {
  glm::vec2 lower{INFINITY}, upper{-INFINITY}; // from the middle of the whole, metres
  bool isEmpty() const { return !(lower.x <= upper.x); }
};

// Of the positions that lie within the whole.
Region regionOf(const ShadowView& whole, std::span<const glm::vec4> positions) {
  Region region;
  for (const glm::vec4& position : positions) {
    const glm::vec3 d = glm::vec3(position) - whole.origin;
    const glm::vec2 p(glm::dot(whole.right, d), glm::dot(whole.up, d));
    if (!(std::abs(p.x) <= whole.extent && std::abs(p.y) <= whole.extent)) continue;
    region.lower = glm::min(region.lower, p);
    region.upper = glm::max(region.upper, p);
  }
  return region;
}

} // namespace

ShadowWindow windowAbout(const ShadowView& whole, std::span<const glm::vec4> positions) {
  const Region region = regionOf(whole, positions);
  if (region.isEmpty()) return {}; // any will do
  const auto [lower, upper] = region;
  const double span = std::max(upper.x - lower.x, upper.y - lower.y), side = 2.0 * whole.extent;
  ShadowWindow window;
  while (window.level < kMaxWindowLevel && span <= 0.75 * std::ldexp(side, -static_cast<int>(window.level) - 1))
    ++window.level;
  if (window.level == 0) return window;
  const double step = 0.25 * std::ldexp(side, -static_cast<int>(window.level));
  window.x = static_cast<std::int64_t>(std::floor((static_cast<double>(lower.x) + whole.extent) / step));
  window.y = static_cast<std::int64_t>(std::floor((static_cast<double>(lower.y) + whole.extent) / step));
  return window;
}

bool holds(const ShadowView& whole, const ShadowWindow& window, std::span<const glm::vec4> positions) {
  const Region region = regionOf(whole, positions);
  if (window.level == 0 || region.isEmpty()) return true;
  const double side = std::ldexp(2.0 * whole.extent, -static_cast<int>(window.level)), step = 0.25 * side;
  const glm::dvec2 from(static_cast<double>(window.x) * step - whole.extent,
                        static_cast<double>(window.y) * step - whole.extent);
  return region.lower.x >= from.x && region.lower.y >= from.y && region.upper.x <= from.x + side &&
         region.upper.y <= from.y + side;
}

ShadowView throughWindow(const ShadowView& whole, const ShadowWindow& window, const std::vector<Caster>& casters,
                         std::uint32_t filter) {
  if (window.level == 0) return whole;
  ShadowView view = whole;
  const double side = std::ldexp(2.0 * whole.extent, -static_cast<int>(window.level)), step = 0.25 * side;
  const auto x = static_cast<float>(static_cast<double>(window.x) * step + 0.5 * side - whole.extent);
  const auto y = static_cast<float>(static_cast<double>(window.y) * step + 0.5 * side - whole.extent);
  view.extent = static_cast<float>(0.5 * side);
  view.origin = whole.origin + x * whole.right + y * whole.up;
  view.casters.clear();
  const float extent = shadowExtent(view, filter);
  for (const Caster& caster : casters) {
    if (!std::binary_search(whole.casters.begin(), whole.casters.end(), caster.instance)) continue;
    glm::vec2 lower(INFINITY), upper(-INFINITY);
    for (const glm::vec3& corner : caster.corners) {
      const glm::vec3 d = corner - view.origin;
      const glm::vec2 p(glm::dot(view.right, d), glm::dot(view.up, d));
      lower = glm::min(lower, p);
      upper = glm::max(upper, p);
    }
    if (std::max(lower.x, lower.y) <= extent && std::min(upper.x, upper.y) >= -extent)
      view.casters.push_back(caster.instance);
  }
  return view;
}

} // namespace parity::gpu
