// EXT_mesh_gpu_instancing: the transforms with which a node shows its mesh several times.
#pragma once

#include <vector>

#include "scenes/gltf/file/document.h"

namespace parity::scenes {

bool isInstanced(const GltfDocument& document, int node);

// How many readInstances gives, before they are read; 1 without the extension.
std::size_t instanceCount(const GltfDocument& document, int node);

// From the instance to its node, translation * rotation * scale; one identity where the node has no such extension.
// Throws Error (exit 4): no attribute, other types than the extension's, differing counts, a rotation of length 0.
std::vector<glm::dmat4> readInstances(const GltfDocument& document, int node);

} // namespace parity::scenes
