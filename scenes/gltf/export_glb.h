// A Scene -> one binary glTF 2.0 file (.glb), which other programs load.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace parity::scenes {

// The bytes of the file; the same scene gives the same bytes. A node for each instance, light and camera, without
// hierarchy; images as PNG of 8 bits. The default camera has the near and far planes that enclose the scene
// (makeCamera). A mesh without triangles is left out. Throws Error (exit 4: scene, place, reason): a texture slot whose
// uv transform KHR_texture_transform cannot say, or whose image has no pixels (LoadOptions::allMaterials gives it
// some); more than the 4 GiB of a .glb.
std::vector<std::byte> toGlb(const Scene& scene);

// One line for each thing of the scene that glTF cannot say, or that only parity reads back.
std::vector<std::string> listNotInGltf(const Scene& scene);

} // namespace parity::scenes
