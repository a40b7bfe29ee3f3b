// The light of a tree of lamps, filtered as a prefiltered level is.
#pragma once

#include <array>
#include <span>

#include <glm/glm.hpp>

#include "lighting/environment/float4.h"
#include "lighting/environment/lamp_steps.h"
#include "lighting/environment/lamp_tree.h"
#include "lighting/environment/texel_tile.h"

namespace parity::lighting {

// Four unit directions (x, y, z) and the sums of light there (red, green, blue).
struct FourLampSums {
  std::array<Float4, 3> direction{}, sum{};
};

// Adds the tree's light filtered as prefilteredLobe (shading/lamps.glsl) does, of alpha^2 = `a2`, to the sums. A node
// stands for all below it where the lobe is nearly a parabola over it: then the second moment of its light gives the
// mean. Each four fours in a row decide that together. They should be close to each other, and the sums depend on which
// they are, but not on the processor. Where the horizon cuts a node, the cosine is a mean over it, too: such light is
// above 0 a little below the horizon. steps: what findLampSteps gives for the tree, a2 and all directions of the fours;
// `smooth` counts as taken.
void addLamps(const LampTree& tree, float a2, const LampSteps& steps, std::span<FourLampSums> fours);

// Adds the same to the sums of a tile's texels. Tiles of 8x8 texels or more find the light of smooth nodes at 5x5
// points and interpolate it. normals: of the texels, unit; as many as sums.
void addLampsToTile(const LampTree& tree, const TexelTile& tile, std::span<const glm::vec3> normals, float a2,
                    std::span<glm::vec3> sums);

} // namespace parity::lighting
