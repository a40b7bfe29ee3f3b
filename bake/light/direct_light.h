// Light that comes straight from suns, points and spots.
#pragma once

#include <span>

#include "bake/atlas/texels.h"
#include "bake/light/texel_light.h"
#include "lighting/surface/visibility.h"
#include "scenes/scene.h"

namespace parity::bake {

// Adds to `sum` what one light gives at a point, if nothing stands between: its fall-off (scenes::Falloff), range and
// cone, as the paths have them. bothSides: the back is lit, too. Returns whether it did.
bool addLight(const scenes::Light& light, const SurfacePoint& point, bool bothSides,
              const lighting::Visibility& visibility, LightSum& sum);

} // namespace parity::bake
