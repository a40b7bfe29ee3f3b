// What binds the parts of a glTF document together: ranges of buffers, the forest of nodes.
#pragma once

#include <nlohmann/json.hpp>

#include "scenes/gltf/file/meshopt.h"
#include "scenes/problems.h"

namespace parity::scenes {

// Checks a document whose types are right (checkGltfSchema), all of it, whether shown or not: that buffer views lie in
// their buffers, accessors in their buffer views (offsets, strides, alignment, sparse parts, min and max), that images
// have one source, nodes one parent and no cycle, scenes roots, and that animations refer to their own samplers.
void checkGltfStructure(const nlohmann::json& document, Problems& problems);

// What EXT_meshopt_compression says of a buffer view, whose types are right.
MeshoptLayout meshoptLayoutOf(const nlohmann::json& extension);

// Components of an accessor type ("VEC3": 3), and the bytes of a component type (5126: 4).
int componentsOf(std::string_view accessorType);
std::size_t bytesOfComponent(int componentType);

} // namespace parity::scenes
