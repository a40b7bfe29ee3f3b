// Lights (KHR_lights_punctual) and cameras of a scene into a glTF file, with a node each. Private to export_glb.cpp.
#pragma once

#include "scenes/gltf/glb_draft.h"
#include "scenes/scene.h"

namespace parity::scenes {

// Of a light that glTF cannot say (listNotInGltf), as much as it can; a falloff exponent goes to
// extras.falloffExponent, where the loader finds it.
void addLights(GlbDraft& draft, const Scene& scene);

// The default camera gets the planes that enclose the scene, as the automatic view has them.
void addCameras(GlbDraft& draft, const Scene& scene);

} // namespace parity::scenes
