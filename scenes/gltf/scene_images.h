// The images of a scene: of those in the file the ones that its materials read, and those computed from them.
#pragma once

#include <vector>

#include "scenes/gltf/file/document.h"
#include "scenes/gltf/specular_glossiness.h"

namespace parity::scenes {

// Fills scene.images and turns the slots of scene.materials, whose images count in document.images and then in
// `derived`, to count there. Pixels have only those that a material reads of which isShown says so (one for each
// material); the others keep their places. What is wrong goes to `problems`. Returns the files that were read.
std::vector<SourceFile> readSceneImages(const GltfDocument& document, const std::vector<DerivedImage>& derived,
                                        const std::vector<bool>& isShown, Scene& scene, Problems& problems);

} // namespace parity::scenes
