// Which instances can cast a shadow at all.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/scene.h"

namespace parity::gpu {

// An instance that may cast.
struct Caster {
  std::uint32_t instance = 0;
  std::array<glm::vec3, 8> corners{}; // of its mesh's bounds, in world space
  scenes::Bounds bounds;              // of the corners
  bool isFlat = false;                // all of it lies in one plane: dot(normal, p) = distance
  glm::vec3 normal{0.f};
  float distance = 0;
  bool castsUp = true, castsDown = true; // flat: something lies before the plane (along the normal), behind it
};

struct Casters {
  std::vector<Caster> list;
  float extent = 0; // the largest coordinate of the scene's instances
};

// All but blended and unlit ones and those without triangles; by the vertices that triangles use. Flatness is within
// 1e-6 of the mesh's size; what lies within 1e-5 of the scene's size about a plane lies in it. Those with a vertex that
// is not finite or beyond 1.8e18 m are left out.
Casters findCasters(const scenes::Scene& scene);

// Whether light from a point, or from far away against `direction`, could meet something behind the caster.
bool castsAwayFrom(const Caster& caster, const glm::vec3& position);
bool castsAlong(const Caster& caster, const glm::vec3& direction);

} // namespace parity::gpu
