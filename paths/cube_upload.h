// Cube maps of an environment, or of several captures, on the device.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gpu/surface/shading_pass.h"
#include "lighting/baked_light.h"

namespace parity::paths {

// mips: of each, all cubes' layers one after another. Throws Error (exit 4) where the device cannot filter the format,
// or takes fewer cubes.
gpu::EnvironmentMaps makeCubes(const gpu::Device& device, const gpu::DeviceImage::Shape& shape,
                               std::span<const std::span<const std::byte>> mips);

// The prefiltered cubes of baked captures, in their order.
using Cubes = std::span<const lighting::CubeMap* const>;
std::vector<const lighting::CubeMap*> cubesOf(const lighting::BakedLight& baked);

} // namespace parity::paths
