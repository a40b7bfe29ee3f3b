// The environment and baked light on the device, as the high-end path reads them.
#pragma once

#include "lighting/environment/environment_light.h"
#include "lighting/environment/panorama_cells.h"
#include "paths/cube_upload.h"

namespace parity::highend {

// Every level and the irradiance cube, in 32-bit floats, and the cells that go with fine levels; null where there are
// none. sheen: the scene has some, which reads the points of cutEnvironment. Throws Error (exit 4) where the device
// cannot filter those.
gpu::EnvironmentMaps uploadEnvironment(const gpu::Device& device, const lighting::EnvironmentLight& light,
                                       const lighting::PanoramaCells* cells, bool sheen = false);

// The same of several captures, cubes of one size, in the order of gpu::BakedContent::captures; at least one. The
// irradiance is the sky's, for what has no lightmap. Throws Error as that, and where the device takes fewer cubes.
gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, paths::Cubes cubes,
                                    const lighting::EnvironmentLight& sky);

// Lightmap, mask of the sun and captures.
gpu::BakedMaps uploadBaked(const gpu::Device& device, const lighting::BakedLight& baked);

} // namespace parity::highend
