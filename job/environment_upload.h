// The prefiltered environment on the device, as each path reads it.
#pragma once

#include <span>

#include "gpu/shading_pass.h"
#include "lighting/environment_light.h"
#include "mobile/options.h"

namespace parity::job {

// The high-end path's: every level, in 32-bit floats. Throws Error (exit 4) where the device cannot filter those.
gpu::EnvironmentMaps uploadEnvironment(const gpu::Device& device, const lighting::EnvironmentLight& light);

// The mobile path's capture: one cube a mip. Throws Error as the other.
gpu::EnvironmentMaps uploadCapture(const gpu::Device& device, const lighting::EnvironmentLight& light,
                                   mobile::CaptureEncoding encoding);

// The same of several captures, cubes of one size, in the order of gpu::BakedContent::captures; at least one. The SH
// are the sky's, for what has no lightmap. Throw Error as those, and where the device takes fewer cubes.
using CaptureCubes = std::span<const lighting::CubeMap* const>;
using SkyIrradiance = std::array<glm::vec3, 9>;
gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, CaptureCubes cubes, const SkyIrradiance& sky);
gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, CaptureCubes cubes, const SkyIrradiance& sky,
                                    mobile::CaptureEncoding encoding);

} // namespace parity::job
