// Textures read on the CPU, for rays: base level, no footprint.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::lighting {

// A point of a mesh's triangle.
struct TrianglePoint {
  std::array<std::uint32_t, 3> vertices{}; // of the mesh
  std::array<double, 3> weights{};         // barycentric
};

// What a slot's image holds at that point, stored values over 255, by the sampler's wrap modes and its filter for
// magnification. A uv that is missing or not finite is read at 0. The slot must have an image, and that its pixels.
glm::dvec4 readTexture(const scenes::Scene& scene, const scenes::Mesh& mesh, const scenes::TextureSlot& slot,
                       const TrianglePoint& point);

} // namespace parity::lighting
