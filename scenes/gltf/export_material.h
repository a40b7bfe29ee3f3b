// Materials, textures, samplers and images of a scene into a glTF file. Private to export_glb.cpp.
#pragma once

#include "scenes/gltf/glb_draft.h"
#include "scenes/scene.h"

namespace parity::scenes {

// All materials, in their order, and of the images those that some slot reads. Throws Error (exit 4): toGlb.
void addMaterials(GlbDraft& draft, const Scene& scene);

} // namespace parity::scenes
