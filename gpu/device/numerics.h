// How a device rounds: results whose last bits differ between drivers, builds and processors.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/device/device.h"

namespace parity::gpu {

// Bits of division, roots, exp2, log2, pow, fma, sine, packing to half, arithmetic in half where the device has it, and
// trilinear fetches, on fixed inputs: gpu/shaders/numerics.glsl. The same device gives the same words. Throws Error
// (exit 4) where the device is lost or the validation layer objects.
std::vector<std::uint32_t> numericsOf(const Device& device);

} // namespace parity::gpu
