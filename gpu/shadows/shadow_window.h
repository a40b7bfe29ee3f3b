// Which part of a directional light's map a view needs: where a scene is large against what is seen of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/shadows/shadow_views.h"

namespace parity::gpu {

// A square of 2^-level of the whole map's side, its corner at so many quarters of its own side from the whole's.
struct ShadowWindow {
  std::uint32_t level = 0;
  std::int64_t x = 0, y = 0;
  bool operator==(const ShadowWindow&) const = default;
};
inline constexpr std::uint32_t kMaxWindowLevel = 16;

// The smallest about these positions (xyz; world), as far as they lie within the whole map, of windows of which they
// take three quarters at most; the whole where they take more. It depends on nothing else. Positions that are not
// finite do not count.
ShadowWindow windowAbout(const ShadowView& whole, std::span<const glm::vec4> positions);

// Whether all of these positions, as far as they lie within the whole map, lie in the window.
bool holds(const ShadowView& whole, const ShadowWindow& window, std::span<const glm::vec4> positions);

// The whole's view through a window: its casters are those that the window and what the filter reaches about it touch.
ShadowView throughWindow(const ShadowView& whole, const ShadowWindow& window, const std::vector<Caster>& casters,
                         std::uint32_t filter);

} // namespace parity::gpu
