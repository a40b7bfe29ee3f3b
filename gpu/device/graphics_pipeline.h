// The raster pipelines: ids and depth, with or without the alpha test, and of blended layers.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "gpu/device/pipeline.h"

namespace parity::gpu {

inline constexpr vk::ShaderStageFlags kRasterStages =
    vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;

// The push constants of visibility.vert.
struct RasterPush {
  glm::mat4 toClip;
  std::uint32_t instance = 0, vertexData = 0, layer = 0;
};

// plain: nothing but triangles; masked: with the alpha test; peeled: also behind the layer before (set 2), and of
// surfaces at the same depth the last one drawn. Of shadow maps, which keep the greatest depth: caster, maskedCaster.
enum class Visibility { plain, masked, peeled, caster, maskedCaster };

// Viewport, scissor, cull mode and front face are dynamic. Targets: R32G32 uint, which shadow maps have not, and D32.
vk::raii::Pipeline makeVisibilityPipeline(const Device& device, const vk::raii::PipelineLayout& layout,
                                          Visibility visibility);

} // namespace parity::gpu
