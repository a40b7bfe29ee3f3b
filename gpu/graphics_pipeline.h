// The one raster pipeline: ids and depth, with or without the alpha test.
#pragma once

#include "gpu/pipeline.h"

namespace parity::gpu {

inline constexpr vk::ShaderStageFlags kRasterStages =
    vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;

// Viewport, scissor, cull mode and front face are dynamic. Targets: R32G32 uint and D32.
vk::raii::Pipeline makeVisibilityPipeline(const Device& device, const vk::raii::PipelineLayout& layout,
                                          bool alphaTested);

} // namespace parity::gpu
