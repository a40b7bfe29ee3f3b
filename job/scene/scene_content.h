// What a prepared scene has, in the words of base::Knob::needsScene.
#pragma once

#include <set>
#include <string>

#include "job/scene/prepared_scene.h"

namespace parity::job {

// "environment", "environment capture", "directional light", "local light", "fog", "lightmap", "texture", "clear coat",
// ...; and "", which every scene has.
std::set<std::string> contentOf(const PreparedScene& prepared);

} // namespace parity::job
