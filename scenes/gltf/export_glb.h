// A scene as one binary glTF 2.0 file, so that other programs can load what is made in code.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace parity::scenes {

// Meshes, instances, materials, textures (as PNG), lights and cameras; the same bytes for the same scene. Not the
// environment and the fog, which glTF does not know. notes: what of the scene the file does not say, a line each; may
// be null. Throws Error (exit 4) for a texture whose transform is no offset, rotation and scale.
std::vector<std::byte> toGlb(const Scene& scene, std::vector<std::string>* notes = nullptr);

} // namespace parity::scenes
