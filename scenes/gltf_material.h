// Materials of a glTF file.
#pragma once

#include <string>
#include <vector>

#include "scenes/gltf_document.h"
#include "scenes/scene.h"

namespace parity::scenes {

// All materials of the file in its order, with unique names; texture slots count in document.images. Factors out of
// their range are clamped with a warning; slots that cannot change anything (an emissive texture times 0, all but the
// base colour of an unlit material) are left out. `needsDefault` appends the default material of glTF. Throws Error
// (exit 4).
std::vector<Material> readMaterials(const GltfDocument& document, bool needsDefault,
                                    std::vector<std::string>& warnings);

} // namespace parity::scenes
