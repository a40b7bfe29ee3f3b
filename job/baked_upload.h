// Baked light on the device, as each path reads it.
#pragma once

#include "bake/baked_light.h"
#include "gpu/baked_maps.h"
#include "gpu/shading_pass.h"
#include "mobile/options.h"

namespace parity::job {

// Irradiance and direction in halves, the sun's visibility as a mask. Throws Error (exit 4) where the device cannot
// filter the formats, or takes fewer pages.
gpu::BakedMaps uploadHighendBaked(const gpu::Device& device, const bake::BakedLight& baked);
// The codes of the mobile lightmap with the scales of its objects, and the sun's distance field. Throws as the other.
gpu::BakedMaps uploadMobileBaked(const gpu::Device& device, const bake::BakedLight& baked);

// The captures in place of an environment; at least one. Throw as uploadEnvironment does.
gpu::EnvironmentMaps uploadHighendCaptures(const gpu::Device& device, const bake::BakedLight& baked);
gpu::EnvironmentMaps uploadMobileCaptures(const gpu::Device& device, const bake::BakedLight& baked,
                                          mobile::CaptureEncoding encoding);

} // namespace parity::job
