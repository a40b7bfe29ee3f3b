// The bright part of an environment as a tree of lights (Walter et al. 2005, "Lightcuts: A Scalable Approach to
// Illumination"): from far away a whole lamp is one light, from close by its parts are many.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "lighting/environment/panorama.h"

namespace parity::lighting {

// All light below a node, as one directional light.
struct LampNode {
  glm::vec3 direction{0.f}; // unit, towards the light: its centroid, weighted by luminance
  float spread = 0;         // mean square distance of the light from it (chords on the unit sphere), above 0, and
                            // at least a quarter of the largest square
  glm::vec3 light{0.f};     // radiance times solid angle, linear Rec.709
  std::uint32_t next = 0;   // the first node that is not below this one; of a leaf the next in the list
};

// Depth first: the root, all that is below its first child, all that is below its second. Empty: no lamps.
struct LampTree {
  std::vector<LampNode> nodes;
  bool isLeaf(std::size_t node) const { return nodes[node].next == node + 1; }
};

inline constexpr std::size_t kMaxCompactLamps = 64;

struct Lamps {
  LampTree wide;    // its leaves are the cells: levels hold them, too
  LampTree compact; // its leaves are groups of cells that no level holds
};

// Takes out of the panorama what its cells have above its mean luminance over solid angle, in their own colours. The
// light before is the light after and that of both trees, per channel. Deterministic.
//
// A group of cells is compact where
// - the root mean square distance of its light from its direction is at most .31 degrees, as wide as the lobe of the
//   sharpest level, which the level's texels blur;
// - it has .7 of the light, at least, that is within four times that distance: a part of a softbox has .13, a part of a
//   line .43, its ends .6;
// - it is one of the kMaxCompactLamps of these with the most light.
Lamps takeLamps(Panorama& panorama);

// A binary tree down to at most `leaves` leaves: of those that are left the one with the most light times spread is
// divided first. The root's light stays the same. The result is not binary: a node with more than a quarter of its
// parent's spread is left out, because a pixel that opens the parent nearly always opens this node, too.
LampTree pruneLamps(const LampTree& tree, std::size_t leaves);

} // namespace parity::lighting
