// What directions close to each other do alike with a tree of lamps, found once for all of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "lighting/environment/lamp_tree.h"

namespace parity::lighting {

// A node stands for all below it where 4 min(t, cos^2 + kLampHorizonScale) is at least kLampOpening times its spread.
// t: u + a2 (1 - u), u a quarter of the squared chord to the node (shading/lamps.glsl). The scale is that of 1 / t^2, a
// parabola as wide as the distance or the lobe, and that of the cosine, which ends at the horizon. Where it is 10 times
// a node's radius the node's light errs by some .1 %, that of a long node by 3 %.
inline constexpr float kLampOpening = 96, kLampHorizonScale = 0.05f;

// The horizon cuts a node whose cosine is within kLampHorizon times the root of its spread.
inline constexpr float kLampHorizon = 1.1283792f; // 2 / sqrt(pi), see cosineOf in lamp_sums_simd.cpp

// Nodes in the order of the tree. None is below another. A leaf that is neither in a list nor below a node of one gives
// no light to any of the directions.
struct LampSteps {
  std::vector<std::uint32_t> smooth; // all take it, and a polynomial of degree 4 gives its light between them
  std::vector<std::uint32_t> taken;  // all take it
  std::vector<std::uint32_t> walked; // each sixteen have to look whether they take it or what is below
};

// A node of which rounding might decide is walked. A node that is far for the directions is opened by all of them if
// one of them may open it. directions: unit, at least one.
LampSteps findLampSteps(const LampTree& tree, float a2, std::span<const glm::vec3> directions);

} // namespace parity::lighting
