// How fine a lightmap is where nobody says so.
#pragma once

#include "scenes/scene.h"

namespace parity::bake {

// 16 texels a metre; more where the scene is so small that its surfaces would have fewer than 2^14 texels, fewer where
// it is so large that they would have more than 2^20.
double defaultTexelsPerMetre(const scenes::Scene& scene);

} // namespace parity::bake
