// What directions close to each other do alike with a tree of lamps, found once for all of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lighting/environment/lamp_tree.h"

namespace parity::lighting {

// A node that all directions come to.
struct LampStep {
  std::uint32_t node : 31;
  std::uint32_t isTaken : 1; // by all; else each four has to look whether it takes the node or what is below
};

inline constexpr float kLampOpening = 96; // see addLamps

// In the order of the tree. Nodes that all directions open are left out, and so is what is below a node that all take.
// A node of which rounding might decide counts as open to doubt.
std::vector<LampStep> findLampSteps(const LampTree& tree, float a2, std::span<const FourLampSums> fours);

} // namespace parity::lighting
