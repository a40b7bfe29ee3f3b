// What animations say of the nodes at one moment.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace parity::scenes {

// Replaces a node's own values, as far as there are any.
struct NodePose {
  std::optional<glm::dvec3> translation, scale;
  std::optional<glm::dquat> rotation;        // unit
  std::optional<std::vector<float>> weights; // of its mesh's morph targets
};

// By node index; those that nothing animates are not in it.
using Pose = std::unordered_map<int, NodePose>;

} // namespace parity::scenes
