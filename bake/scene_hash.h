// What a bake was made from, as hashes: a folder that was baked from anything else is stale.
#pragma once

#include <string>

#include "bake/light/integrate.h"
#include "scenes/scene.h"

namespace parity::bake {

// Apart, so that it can be said what has changed.
struct SceneHashes {
  std::string geometry;  // meshes (positions, normals, indices, both uvs, colours) and where they stand
  std::string materials; // factors and textures: captures show all of them
  std::string lights;    // of all kinds, without the scale of their specular light; which of them is the sun
  std::string sky;       // the environment, its rotation applied
  bool operator==(const SceneHashes&) const = default;
};

// The scene's images must have their pixels.
SceneHashes hashScene(const scenes::Scene& scene, const BakeLights& lights);

// "stale: not the materials, lights that it was baked from"; empty where nothing has.
std::string describeChange(const SceneHashes& baked, const SceneHashes& now);

} // namespace parity::bake
