// A glTF file -> a Scene: the order of the steps, and what binds them.
#pragma once

#include <string>

#include "scenes/load_options.h"
#include "scenes/scene.h"

namespace parity::scenes {

// Throws Error or ErrorList. See loadScene.
Scene loadGltf(const std::string& file, const LoadOptions& options);

} // namespace parity::scenes
