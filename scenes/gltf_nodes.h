// The node hierarchy of a glTF file, walked once: what is placed where in the world.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/gltf_document.h"

namespace parity::scenes {

inline constexpr int kMaxNodeDepth = 256;

// A node that is part of the scene shown. Transforms are affine and finite.
struct PlacedNode {
  int node = 0;
  glm::dmat4 toWorld{1.0};
  std::string path; // "root/child", names or "node 3"
};

// All nodes of the default scene (else the first scene; else all roots, with a warning), parents before children.
// Throws Error (exit 4): a node that is its own ancestor or has two parents, a transform that is not affine, not finite
// or given twice, deeper than kMaxNodeDepth.
std::vector<PlacedNode> placeNodes(const GltfDocument& document, std::vector<std::string>& warnings);

} // namespace parity::scenes
