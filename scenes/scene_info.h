// What is in a scene, in numbers and words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace parity::scenes {

struct MaterialInfo {
  std::string name;
  // In this order, where they apply: unlit, nonmetal, fully rough, textured, normal map, vertex colours, emissive,
  // coat, sheen, anisotropy, iridescence, transmission, diffuse transmission, volume, alpha mask, alpha blend,
  // double-sided, not shown.
  std::vector<std::string> flags;
  std::vector<std::string> textures; // "base color: wood.png (2048x2048)"
  glm::vec3 f0{0.f};                 // of a dielectric, linear
  std::size_t triangles = 0;         // over all instances
};

struct SceneInfo {
  std::size_t vertices = 0, triangles = 0, instances = 0; // triangles over all instances, vertices as stored
  std::vector<MaterialInfo> materials;                    // in the scene's order
  Bounds bounds;
  std::size_t meshBytes = 0, imageBytes = 0; // decoded, in memory
  std::size_t images = 0, texels = 0;        // of those, base levels
};

SceneInfo describeScene(const Scene& scene);

} // namespace parity::scenes
