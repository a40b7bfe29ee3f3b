// One primitive of a glTF mesh -> one scenes::Mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf_document.h"
#include "scenes/scene.h"

namespace parity::scenes {

// Most memory that the meshes of a scene may take, all attributes counted.
inline constexpr std::size_t kMaxMeshBytes = std::size_t{1} << 30;

// A mesh and what was mended or ignored on the way.
struct GltfPrimitive {
  std::optional<Mesh> mesh; // nothing: points or lines, or no whole triangle
  std::vector<std::string> warnings;
};

// An upper bound of the bytes that buildPrimitive will keep. Checks nothing but what it needs. Throws Error (exit 4)
// where the primitive has no POSITION.
std::size_t estimateBytes(const GltfDocument& document, int mesh, int primitive);

// Reads attributes and indices, turns strips and fans into lists, and generates what is missing: flat normals, and
// tangents if the material has a normal map. `material` is the one that the primitive is drawn with. Throws Error (exit
// 4) with the place: "meshes[0].primitives[1].attributes.POSITION".
GltfPrimitive buildPrimitive(const GltfDocument& document, int mesh, int primitive, std::uint32_t materialIndex,
                             const Material& material);

} // namespace parity::scenes
