// The mobile path's functions by themselves, as the device computes them: for studies of a preset.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/device/device.h"
#include "mobile/options.h"
#include "mobile/shaders/probe.h"

namespace parity::mobile {

// The results of the calls, in their order; what they hold is said beside kProbe... Compiles the program: some 0.2 s.
// Throws Error (failed), as PresetFolder::program does.
std::vector<glm::vec4> probe(const gpu::Device& device, const Options& options, std::span<const ProbeCall> calls);

} // namespace parity::mobile
