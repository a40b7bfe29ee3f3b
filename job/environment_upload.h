// The prefiltered environment on the device, as each path reads it.
#pragma once

#include <span>

#include "gpu/shading_pass.h"
#include "lighting/environment_light.h"
#include "lighting/panorama_cells.h"
#include "mobile/options.h"

namespace parity::job {

// The high-end path's: every level and the irradiance cube, in 32-bit floats, and the cells that go with fine ones;
// null where there are none. Throws Error (exit 4) where the device cannot filter those.
gpu::EnvironmentMaps uploadEnvironment(const gpu::Device& device, const lighting::EnvironmentLight& light,
                                       const lighting::PanoramaCells* cells);

// The mobile path's capture: one cube a mip, SH, and these with one tint. Throws Error as the other.
gpu::EnvironmentMaps uploadCapture(const gpu::Device& device, const lighting::EnvironmentLight& light,
                                   mobile::CaptureEncoding encoding);

// The same of several captures, cubes of one size, in the order of gpu::BakedContent::captures; at least one. The
// irradiance is the sky's, for what has no lightmap. Throw Error as those, and where the device takes fewer cubes.
using CaptureCubes = std::span<const lighting::CubeMap* const>;
gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, CaptureCubes cubes,
                                    const lighting::EnvironmentLight& sky);
gpu::EnvironmentMaps uploadCaptures(const gpu::Device& device, CaptureCubes cubes,
                                    const lighting::EnvironmentLight& sky, mobile::CaptureEncoding encoding);

} // namespace parity::job
