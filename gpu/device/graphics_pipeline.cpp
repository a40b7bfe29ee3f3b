#include "gpu/device/graphics_pipeline.h"

#include <array>
#include <vector>

#include "gpu_shaders/shadow_mask.frag.h"
#include "gpu_shaders/visibility.frag.h"
#include "gpu_shaders/visibility.vert.h"
#include "gpu_shaders/visibility_mask.frag.h"
#include "gpu_shaders/visibility_peel.frag.h"

namespace parity::gpu {

namespace {

Spirv fragmentOf(Visibility visibility) {
  switch (visibility) {
  case Visibility::masked:
    return kVisibilityMaskFrag;
  case Visibility::peeled:
    return kVisibilityPeelFrag;
  case Visibility::maskedCaster:
    return kShadowMaskFrag;
  default:
    return kVisibilityFrag;
  }
}

} // namespace

vk::raii::Pipeline makeVisibilityPipeline(const Device& device, const vk::raii::PipelineLayout& layout,
                                          Visibility visibility) {
  const auto makeModule = [&](Spirv spirv) {
    return vk::raii::ShaderModule(device.handle(), vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
  };
  const vk::raii::ShaderModule vertex = makeModule(kVisibilityVert);
  const vk::raii::ShaderModule fragment = makeModule(fragmentOf(visibility));
  const bool isShadow = visibility == Visibility::caster || visibility == Visibility::maskedCaster;
  std::vector stages = {vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"),
                        vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eFragment, *fragment, "main")};
  if (visibility == Visibility::caster) stages.pop_back();  // depth alone
  const vk::PipelineVertexInputStateCreateInfo vertexInput; // vertices are pulled
  const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
  const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
  vk::PipelineRasterizationStateCreateInfo rasterization;
  rasterization.lineWidth = 1;
  const vk::PipelineMultisampleStateCreateInfo multisample({}, vk::SampleCountFlagBits::e1);
  const vk::PipelineDepthStencilStateCreateInfo depth({}, true, true,
                                                      isShadow                           ? vk::CompareOp::eGreater
                                                      : visibility == Visibility::peeled ? vk::CompareOp::eLessOrEqual
                                                                                         : vk::CompareOp::eLess);
  vk::PipelineColorBlendAttachmentState attachment;
  attachment.colorWriteMask = vk::ColorComponentFlagBits::eR | vk::ColorComponentFlagBits::eG;
  vk::PipelineColorBlendStateCreateInfo blend({}, false, vk::LogicOp::eCopy, attachment);
  if (isShadow) blend.attachmentCount = 0;
  const std::array dynamic = {vk::DynamicState::eViewport, vk::DynamicState::eScissor, vk::DynamicState::eCullMode,
                              vk::DynamicState::eFrontFace};
  const vk::PipelineDynamicStateCreateInfo dynamicState({}, dynamic);
  const vk::Format idFormat = vk::Format::eR32G32Uint;
  vk::PipelineRenderingCreateInfo rendering(0, idFormat, vk::Format::eD32Sfloat);
  if (isShadow) rendering.colorAttachmentCount = 0;
  const vk::GraphicsPipelineCreateInfo info({}, stages, &vertexInput, &assembly, nullptr, &viewport, &rasterization,
                                            &multisample, &depth, &blend, &dynamicState, *layout, {}, 0, {}, {},
                                            &rendering);
  return vk::raii::Pipeline(device.handle(), nullptr, info);
}

} // namespace parity::gpu
