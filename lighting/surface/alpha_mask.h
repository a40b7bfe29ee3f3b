// The alpha test of masked materials on the CPU, for rays.
#pragma once

#include <array>

#include "scenes/scene.h"

namespace parity::lighting {

// Whether the point of a triangle lets light through: alpha below the material's cutoff, by the rule of
// gpu/shaders/visibility_mask.frag (material alpha times vertex alpha times the base colour texture's). A ray has no
// footprint: the texture's base level is read, with the sampler's wrap modes and its filter for magnification. A uv
// that is not finite is read at 0. indices: of the mesh's vertices; weights: barycentric. The material is the mesh's.
bool isHole(const scenes::Scene& scene, const scenes::Mesh& mesh, const std::array<std::uint32_t, 3>& indices,
            const std::array<double, 3>& weights);

} // namespace parity::lighting
