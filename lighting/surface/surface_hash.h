// Hashes of a scene's surfaces, for what is kept of them.
#pragma once

#include <string>

#include "scenes/scene.h"

namespace parity::lighting {

// Meshes but for their tangents, and instances.
std::string hashOfGeometry(const scenes::Scene& scene);
// Materials and the images that they read. The images must have their pixels.
std::string hashOfMaterials(const scenes::Scene& scene);
// Both, and the tangents: all that decides what rays find (lighting/surface/surface_material.h).
std::string hashOfSurfaces(const scenes::Scene& scene);

} // namespace parity::lighting
