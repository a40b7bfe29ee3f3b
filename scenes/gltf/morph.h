// Morph targets of a glTF primitive (glTF 2.0, 3.7.2.2), on the CPU.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/gltf/material.h"
#include "scenes/gltf/pose.h"
#include "scenes/gltf/primitive.h"

namespace parity::scenes {

// The weights with which a node shows its mesh: animated, else the node's, else the mesh's, else 0; empty where the
// mesh has no targets. Throws Error (exit 4) where their number is not that of the targets, or primitives differ in
// that.
std::vector<float> morphWeights(const GltfDocument& document, int node, const Pose& pose);

// Adds the targets' displacements times their weights to what the mesh has of positions, normals, tangents (xyz), uv
// and colours (clamped to [0,1] then). Directions are not unit length afterwards. Targets of weight 0 are not read.
// Throws Error (exit 4).
void applyMorphTargets(const PrimitiveReader& reader, std::span<const float> weights, const UvSets& uvSets, Mesh& mesh,
                       std::vector<std::string>& warnings);

} // namespace parity::scenes
