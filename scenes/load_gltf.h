// A glTF file -> a Scene: the order of the steps, and what binds them.
#pragma once

#include <string>

#include "scenes/scene.h"

namespace parity::scenes {

// Throws Error (exit 4). See loadScene.
Scene loadGltf(const std::string& file);

} // namespace parity::scenes
