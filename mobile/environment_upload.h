// The environment and baked light on the device, as the mobile path reads them.
#pragma once

#include "lighting/environment/environment_light.h"
#include "mobile/options.h"
#include "paths/cube_upload.h"

namespace parity::mobile {

// One cube a mip, SH, and these with one tint; of several captures, cubes of one size, in the order of
// gpu::BakedContent::captures, with the sky's irradiance, for what has no lightmap. At least one cube. Throws Error
// (exit 4) where the device cannot filter the encoding or takes fewer cubes.
gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, paths::Cubes cubes,
                                    const lighting::EnvironmentLight& sky, CaptureEncoding encoding);

// Lightmap in that form, distance field of the sun's shadow, and captures.
gpu::BakedMaps uploadBaked(const gpu::Device& device, const lighting::BakedLight& baked, LightmapForm form);

} // namespace parity::mobile
