// Where shadow maps look from, and what they draw: fitted to what can cast, on the CPU.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "gpu/shadows/shadow_casters.h"
#include "gpu/shadows/shadow_options.h"
#include "scenes/scene.h"

namespace parity::gpu {

// A square map. Perspective: the light's position is the origin, `extent` the tangent of half the angle. Orthographic:
// the origin is in the middle of the near plane, `extent` half the side in metres.
struct ShadowView {
  bool orthographic = false;
  glm::vec3 origin{0.f};
  glm::vec3 right{1.f, 0.f, 0.f}, up{0.f, 1.f, 0.f}, forward{0.f, 0.f, 1.f}; // unit; forward: away from the light
  float extent = 1;
  float near = 0, far = 1;            // distances along `forward`; far: of orthographic ones, others see without end
  float bias = 0;                     // metres that coordinates of casters and receivers may be wrong by
  std::uint32_t side = 0;             // texels
  std::vector<std::uint32_t> casters; // instances to draw; none: there is no map
};

// Which views are a light's.
struct ShadowOfLight {
  std::uint32_t first = 0;
  std::uint32_t count = 0; // 0: nothing casts; 1; or 6: +x, -x, +y, -y, +z, -z
  auto operator<=>(const ShadowOfLight&) const = default;
};

// What decides a light's maps: kind, position, direction, range and cone.
using ShadowKey = std::tuple<int, std::array<float, 3>, std::array<float, 3>, float, float>;
ShadowKey shadowKey(const scenes::Light& light);

struct ShadowPlan {
  std::vector<ShadowOfLight> lights; // of each light
  std::vector<ShadowView> views;     // those of a cube without casters are there, without texels
  std::vector<Caster> casters;       // all that any may draw
  bool shrunk = false;               // maps have fewer texels than asked for, for options.maxBytes
};

// Directional lights get one map about what casts, turned so that it is smallest; local ones one about what casts
// within their reach or about their cone, whichever is narrower, of half the texels a side; where that is wider than
// 120 degrees the six faces of a cube, of a fourth. Drawn are instances that are not blended and not unlit, that a
// light's range and cone reach, and that lie before something: a flat floor with nothing below it casts no shadow. What
// is nearer to a light than 2^-20 of the distance to the farthest that a map draws is not drawn. Equal lights share
// their maps; dark ones have none. Maps are halved until all fit into options.maxBytes, those of local lights first,
// down to kMinTile texels a side. Throws Error (exit 4) where that does not suffice, and beyond kMaxShadowDraws.
ShadowPlan planShadows(const scenes::Scene& scene, const std::vector<scenes::Light>& lights,
                       const ShadowOptions& options);

inline constexpr std::uint32_t kMinTile = 16;
inline constexpr std::uint64_t kMaxShadowDraws = 4'000'000; // instances over all maps

// Texels about the edge of a map that only filters reach: about what is seen of local lights, about what casts of
// directional ones, whose shadows' soft edges lie beyond. `extent` with them.
constexpr std::uint32_t shadowGuard(std::uint32_t filter, bool orthographic) {
  return (filter + 1) / 2 * (orthographic ? 2 : 1) + 2;
}
inline float shadowExtent(const ShadowView& view, std::uint32_t filter) {
  return view.extent * static_cast<float>(view.side) /
         static_cast<float>(view.side - 2 * shadowGuard(filter, view.orthographic));
}

} // namespace parity::gpu
