// One primitive of a glTF mesh -> one scenes::Mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf/file/document.h"
#include "scenes/gltf/material.h"
#include "scenes/gltf/skin.h"
#include "scenes/scene.h"

namespace parity::scenes {

// A mesh and what was mended or ignored on the way.
struct GltfPrimitive {
  std::optional<Mesh> mesh; // nothing: points or lines, or no whole triangle
  bool isSkinned = false;   // the mesh is in world space
  std::vector<std::string> warnings;
};

// How a mesh is bent.
struct MeshPose {
  std::vector<float> weights;     // of its morph targets
  const SkinPose* skin = nullptr; // none: not skinned
};

// An upper bound of the bytes that buildPrimitive will keep. Checks nothing but what it needs. Throws Error (exit 4)
// where the primitive has no POSITION.
std::size_t estimateBytes(const GltfDocument& document, int mesh, int primitive);

// Reads attributes and indices, turns strips and fans into lists, applies morph targets and skin, and generates what is
// missing: flat normals, and tangents if the material needs them (tangentSetOf). `material` is the one that the
// primitive is drawn with, uvSets its uv sets. Throws Error (exit 4) with the place:
// "/meshes/0/primitives/1/attributes/POSITION".
GltfPrimitive buildPrimitive(const GltfDocument& document, int mesh, int primitive, std::uint32_t materialIndex,
                             const Material& material, const UvSets& uvSets, const MeshPose& pose);

} // namespace parity::scenes
