// The light of a tree of lamps, filtered as a prefiltered level is.
#pragma once

#include <array>
#include <span>

#include <glm/glm.hpp>

#include "lighting/environment/cube.h"
#include "lighting/environment/float4.h"
#include "lighting/environment/lamp_steps.h"
#include "lighting/environment/lamp_tree.h"

namespace parity::lighting {

// Four unit directions (x, y, z) and the sums of light there (red, green, blue).
struct FourLampSums {
  std::array<Float4, 3> direction{}, sum{};
};

// Adds the tree's light filtered as prefilteredLobe (shading/lamps.glsl) does, of alpha^2 = `a2`, to the sums. A node
// stands for all below it where the lobe is nearly a parabola over it, at all of sixteen directions: then the second
// moment of its light gives the mean. Where the horizon cuts a node, the cosine is a mean over it, too. steps: of the
// directions; `smooth` counts as taken. Sums do not depend on the processor. Four fours in a row should be close to
// each other: they open the tree together.
void addLamps(const LampTree& tree, float a2, const LampSteps& steps, std::span<FourLampSums> fours);

// Texels of a face that are filtered together: neighbours open the same lamps.
struct TexelTile {
  int face, left, top, side, faceSize;
  int count() const { return side * side; }
};
inline constexpr int kMaxTileSide = 16, kMaxTileTexels = kMaxTileSide * kMaxTileSide;

// Adds the same to the sums of a tile's texels, row by row. The light of smooth lamps is found at 5 x 5 points of a
// large tile and interpolated. normals: of the texels, unit.
void addLampsToTile(const LampTree& tree, const TexelTile& tile, std::span<const glm::vec3> normals, float a2,
                    std::span<glm::vec3> sums);

} // namespace parity::lighting
