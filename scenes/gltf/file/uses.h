// Which meshes of a glTF file are shown, each in how many poses.
#pragma once

#include <compare>
#include <string>
#include <vector>

#include "scenes/gltf/nodes.h"
#include "scenes/gltf/skin.h"

namespace parity::scenes {

// A mesh in one pose. Nodes that show the same share it.
struct MeshUse {
  int mesh = 0;
  int skin = -1; // -1: none
  std::vector<float> weights;
  auto operator<=>(const MeshUse&) const = default;
};

struct MeshUses {
  static constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<MeshUse> uses;       // ordered by mesh, then skin, then weights
  std::vector<std::size_t> ofNode; // for each shown node its use, kNone where it has no mesh
  std::vector<SkinPose> skins;     // by the file's index; empty where no use has it
};

// nodes: as placeNodes gives them for the list. What is wrong goes to `problems`.
MeshUses listMeshUses(const GltfDocument& document, const NodeList& list, const std::vector<PlacedNode>& nodes,
                      const Pose& pose, Problems& problems);

} // namespace parity::scenes
