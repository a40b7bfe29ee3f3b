// The prefiltered environment on the device, as each path reads it.
#pragma once

#include "gpu/shading_pass.h"
#include "lighting/environment_light.h"
#include "mobile/options.h"

namespace parity::job {

// The high-end path's: every level, in 32-bit floats. Throws Error (exit 4) where the device cannot filter those.
gpu::EnvironmentMaps uploadEnvironment(const gpu::Device& device, const lighting::EnvironmentLight& light);

// The mobile path's capture: one cube a mip. Throws Error as the other.
gpu::EnvironmentMaps uploadCapture(const gpu::Device& device, const lighting::EnvironmentLight& light,
                                   mobile::CaptureEncoding encoding);

} // namespace parity::job
