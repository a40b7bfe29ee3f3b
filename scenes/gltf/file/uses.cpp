// Which meshes of a glTF file are shown, each in how many poses.
#include "scenes/gltf/file/uses.h"

#include <map>

#include "scenes/gltf/morph.h"

namespace parity::scenes {

MeshUses listMeshUses(const GltfDocument& document, const NodeList& list, const std::vector<PlacedNode>& nodes,
                      const Pose& pose, Problems& problems) {
  MeshUses out;
  out.ofNode.assign(list.shown, MeshUses::kNone);
  out.skins.resize(document.model.skins.size());
  std::map<MeshUse, std::vector<std::size_t>> nodesOf;
  for (std::size_t place = 0; place < list.shown; ++place) {
    const int node = list.entries[place].node;
    const tinygltf::Node& source = document.model.nodes[static_cast<std::size_t>(node)];
    if (source.mesh < 0) continue;
    problems.attempt([&] { nodesOf[{source.mesh, source.skin, morphWeights(document, node, pose)}].push_back(place); });
  }
  for (const auto& [use, places] : nodesOf) {
    for (const std::size_t place : places) out.ofNode[place] = out.uses.size();
    out.uses.push_back(use);
    const int skin = use.skin;
    if (skin < 0 || !out.skins[static_cast<std::size_t>(skin)].matrices.empty()) continue;
    problems.attempt([&] {
      out.skins[static_cast<std::size_t>(skin)] = poseSkin(document, skin, [&](int joint) -> const glm::dmat4& {
        return nodes[list.placeOf[static_cast<std::size_t>(joint)]].toWorld;
      });
    });
  }
  return out;
}

} // namespace parity::scenes
