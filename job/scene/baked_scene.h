// Baked light in a scene that is made ready: whether it is this scene's, and what it takes the place of.
#pragma once

#include <memory>
#include <string>

#include "bake/baked_light.h"
#include "bake/light/integrate.h"
#include "job/scene/prepared_scene.h"

namespace parity::job {

// What lights the scene, for baking it or for holding it against a bake. The sun is the brightest directional light.
// The scene must have kept its panorama.
bake::BakeLights bakeLightsOf(const PreparedScene& prepared);

// Throws Error (exit 4) naming the folder and what has changed unless the scene's baked light is of it, as it is now.
void requireFresh(const PreparedScene& prepared, const std::string& folder);

// From here on the scene is lit by that: of its lights the sun stays, with stationary local lights all others in the
// paths that do not bake them; the environments are the captures.
void takeBaked(PreparedScene& prepared, const PathChoice& paths, std::shared_ptr<const bake::BakedLight> baked);

} // namespace parity::job
