// Lights (KHR_lights_punctual) and cameras of a glTF file, placed in the world.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf/file/document.h"
#include "scenes/gltf/nodes.h"
#include "scenes/scene.h"

namespace parity::scenes {

// The light of a node, nothing where it has none. It shines along the node's -Z; scale changes neither range nor
// intensity. One whose node has no direction is left out with a warning. Throws Error (exit 4): values out of range.
std::optional<Light> readLight(const GltfDocument& document, const PlacedNode& node,
                               std::vector<std::string>& warnings);

// The camera of a node, nothing where it has none. toWorld is made rigid. An absent far plane comes out as zFar = 0.
// One whose node has no direction is left out with a warning. Throws Error (exit 4): values out of range.
std::optional<Camera> readCamera(const GltfDocument& document, const PlacedNode& node,
                                 std::vector<std::string>& warnings);

} // namespace parity::scenes
