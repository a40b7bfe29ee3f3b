// The functions of a preset over their domains, as the device computes them.
#pragma once

#include <vector>

#include "gpu/device/device.h"
#include "mobile/options.h"
#include "paths/env_brdf.h"
#include "study/preset/preset_study.h"

namespace parity::presets {

// Every function of the path that presets differ in, edges of its domain included, in the precision of the options.
std::vector<FunctionStress> stressFunctions(const gpu::Device& device, const mobile::Options& options);

// The direct lobe against GGX, at a roughness of .1, .25, .5, .75 and 1. In fp32. table: gives the albedos.
std::vector<LobeError> lobeErrors(const gpu::Device& device, const mobile::Options& options,
                                  const paths::EnvBrdf& table);

} // namespace parity::presets
