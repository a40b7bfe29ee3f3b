// Skins of a glTF file (glTF 2.0, 3.7.3): linear blend skinning on the CPU.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenes/gltf/primitive.h"
#include "scenes/scene.h"

namespace parity::scenes {

// Per joint: from the mesh's space in the bind pose to the world.
struct SkinPose {
  std::vector<glm::dmat4> matrices;
};

// worldOf: the transform of a node. The skinned mesh's own node has no say. Throws Error (exit 4): no joint, fewer
// inverse bind matrices than joints, one that is not affine.
SkinPose poseSkin(const GltfDocument& document, int skin, const std::function<const glm::dmat4&(int node)>& worldOf);

// Moves positions, normals and tangents to the world, by the sum of the joints' matrices times the vertex's weights
// (all sets JOINTS_n, WEIGHTS_n): normals by its inverse transpose. Directions are not unit length afterwards. Weights
// are scaled to a sum of 1, with a warning where they are farther from it than their precision; a vertex without any
// follows its first joint. Where all matrices mirror, the triangles are turned round. Returns false, with a warning and
// an unchanged mesh, where the primitive has no joints or weights. Throws Error (exit 4): a negative weight, a joint
// with a weight that the skin does not have.
bool applySkin(const PrimitiveReader& reader, const SkinPose& pose, Mesh& mesh, std::vector<std::string>& warnings);

} // namespace parity::scenes
