// Scenes from glTF files, HDR environments from image files.
#pragma once

#include <filesystem>
#include <string>

#include "scenes/load_options.h"
#include "scenes/scene.h"

namespace parity::scenes {

// Loads a .gltf or .glb (glTF 2.0), or "builtin:NAME" (scenes/builtin/builtin.h), which knows nothing of the options.
// Everything is checked before it is used: what cannot be shown rightly is an Error (exit 4: file, JSON pointer such as
// "/accessors/3/count", reason) or an ErrorList of up to 20, what is ignored is a line in Scene::warnings. Throws Error
// (usage) naming what the file has where it lacks the scene, animation or variant asked for, and for a time that is not
// finite.
Scene loadScene(const std::string& fileOrBuiltin, const LoadOptions& options = {});

// Loads an equirectangular .hdr, .exr or .pfm within the limits of the options (an image's side and the memory), or
// "builtin:NAME" (scenes/builtin/builtin.h). Grey is spread, channels beside R, G, B are dropped; a .hdr is turned as
// its header says. NaN, infinite and negative texels are set to 0 (NaN, negative) or the largest finite value (inf),
// those above 1e30 to that, counted, and reported in lines appended to `warnings`; below 1e-30 they are 0. Throws Error
// (exit 4): unreadable, zero-sized, of integers, other channels, a cube map, a part of a panorama, not twice as wide as
// high, nothing finite.
Environment loadEnvironment(const std::string& fileOrBuiltin, float rotationDeg, std::vector<std::string>& warnings,
                            const LoadOptions& options = {});

} // namespace parity::scenes
