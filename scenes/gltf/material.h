// Materials of a glTF file.
#pragma once

#include <string>
#include <vector>

#include "scenes/gltf/file/document.h"
#include "scenes/gltf/specular_glossiness.h"
#include "scenes/scene.h"

namespace parity::scenes {

// Which of the file's uv sets (TEXCOORD_n) a material reads: the texture slots' texCoord of 0 and 1 stand for these.
struct UvSets {
  int first = 0, second = 1;
  bool operator==(const UvSets&) const = default;
};

struct GltfMaterials {
  std::vector<Material> materials; // of the file in its order, with unique names
  std::vector<UvSets> uvSets;      // of each
  DerivedImages derived;           // slots count in document.images, then here
};

// Reads all materials; texture slots count in document.images and then in `derived`. Factors out of their range are
// clamped with a warning; slots that cannot change anything (an emissive texture times 0, those of a coat of 0, all but
// the base colour of an unlit material) are left out. `needsDefault` appends the default material of glTF. What is
// wrong goes to `problems`.
GltfMaterials readMaterials(const GltfDocument& document, bool needsDefault, Problems& problems,
                            std::vector<std::string>& warnings);

} // namespace parity::scenes
