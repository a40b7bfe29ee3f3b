// Animations of a glTF file (glTF 2.0, 3.11), evaluated at one moment.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenes/gltf/file/document.h"
#include "scenes/gltf/pose.h"

namespace parity::scenes {

// The pose at options.timeSeconds, each channel clamped to its keys: of the animation that the options name
// (kNoAnimation: none, the rest pose), else of all in the file's order, where a node's property belongs to the first
// animation that has it (one warning says so). Only channels of nodes for which `isNeeded` says true are read. What is
// wrong goes to `problems`: keys that do not increase or are not finite, counts that do not match, a node with a
// matrix. Throws Error (usage) naming the animations there are where the options ask for another.
Pose poseAt(const GltfDocument& document, const std::function<bool(int node)>& isNeeded, Problems& problems,
            std::vector<std::string>& warnings);

// Of each animation the time of its last key, seconds, as the file declares it; 0 where it does not.
std::vector<double> animationLengths(const GltfDocument& document);

} // namespace parity::scenes
