// The node hierarchy of a glTF file: which nodes are shown, and what is placed where in the world.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/gltf/file/document.h"
#include "scenes/gltf/pose.h"

namespace parity::scenes {

// The longest path of names that a node has in messages, in bytes; longer ones keep their end.
inline constexpr std::size_t kMaxNodePath = 200;

// The nodes that are needed, parents before children: those of the scene shown first, then the trees in which a skin of
// theirs has joints that the scene lacks.
struct NodeList {
  static constexpr std::size_t kNone = ~std::size_t{0};
  struct Entry {
    int node = 0;
    std::size_t parent = kNone; // its place in the list
  };
  std::vector<Entry> entries;
  std::size_t shown = 0;            // as many entries belong to the scene
  std::vector<std::size_t> placeOf; // for each node of the file its place in the list
};

// Of the scene that the options name (else the default one, else the first; else all roots, with a warning). Throws
// Error (usage) for a scene that is not there.
NodeList listNodes(const GltfDocument& document, std::vector<std::string>& warnings);

// A node in the world. Transforms are affine and finite.
struct PlacedNode {
  int node = 0;
  glm::dmat4 toWorld{1.0};
  std::string path; // "root/child", names or "node 3"; of a deep one the end: ".../child"
};

// Each entry of the list, in its order, with what the pose says instead of the node's own values. To `problems`: a
// transform that is not affine or not finite.
std::vector<PlacedNode> placeNodes(const GltfDocument& document, const NodeList& list, const Pose& pose,
                                   Problems& problems);

// Makes the last row 0 0 0 1 where it is that but for rounding; else false.
bool makeAffine(glm::dmat4& m);

} // namespace parity::scenes
