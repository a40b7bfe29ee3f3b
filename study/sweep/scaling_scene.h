// Scenes of a given size, written as glTF, to see what a run costs as they grow.
#pragma once

#include <filesystem>

namespace parity::sweep {

// A plane of `materials` square fields, each a mesh and a material of its own, seen whole by the default view.
struct SceneSize {
  int triangles = 2048; // of all fields together; at least two a field
  int materials = 1;
  int textures = 0;      // the first so many materials have a base colour texture of their own, of textureSide^2
  int textureSide = 256; // texels
  int lights = 0;        // point lights above the plane, of equal light in all
};

// Writes scene.gltf with its buffer and textures into the folder, and returns its path. Throws Error (exit 4).
std::filesystem::path writeScalingScene(const std::filesystem::path& folder, const SceneSize& size);

} // namespace parity::sweep
