#include "gpu/device/image.h"

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "gpu/device/image_upload.h"

namespace parity::gpu {

namespace {

bool isDepth(vk::Format format) { return format == vk::Format::eD32Sfloat; }

vk::ImageSubresourceRange wholeOf(const DeviceImage::Shape& shape) {
  return {isDepth(shape.format) ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor, 0, shape.mips, 0,
          shape.layers()};
}

} // namespace

DeviceImage::DeviceImage(const Device& device, const Shape& shape) : m_shape(shape) {
  const std::uint32_t side = std::max(shape.width, shape.height);
  const auto& limits = device.properties().limits;
  if (const std::uint32_t limit = shape.cube ? limits.maxImageDimensionCube : limits.maxImageDimension2D; side > limit)
    throw base::Error(base::ExitCode::failed, device.report().name,
                      "image of " + std::to_string(shape.width) + "x" + std::to_string(shape.height),
                      "the device allows at most " + std::to_string(limit) + " pixels a side");
  vk::ImageCreateInfo info(shape.cube ? vk::ImageCreateFlagBits::eCubeCompatible : vk::ImageCreateFlags{},
                           vk::ImageType::e2D, shape.format, vk::Extent3D(shape.width, shape.height, 1), shape.mips,
                           shape.layers(), vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, shape.usage);
  m_image = vk::raii::Image(device.handle(), info);
  const vk::MemoryRequirements needs = m_image.getMemoryRequirements();
  try {
    m_memory = device.allocate(needs, {}, vk::MemoryPropertyFlagBits::eDeviceLocal, false);
  } catch (const vk::SystemError& error) {
    throw base::Error(base::ExitCode::failed, device.report().name,
                      "image of " + std::to_string(shape.width) + "x" + std::to_string(shape.height), error.what());
  }
  m_image.bindMemory(m_memory.handle(), 0);
  m_view = vk::raii::ImageView(device.handle(), vk::ImageViewCreateInfo({}, *m_image,
                                                                        shape.cube    ? vk::ImageViewType::eCubeArray
                                                                        : shape.array ? vk::ImageViewType::e2DArray
                                                                                      : vk::ImageViewType::e2D,
                                                                        shape.format, {}, wholeOf(shape)));
}

vk::raii::ImageView DeviceImage::layerView(const Device& device, std::uint32_t layer) const {
  vk::ImageSubresourceRange range = wholeOf(m_shape);
  range.baseArrayLayer = layer;
  range.layerCount = 1;
  return vk::raii::ImageView(device.handle(),
                             vk::ImageViewCreateInfo({}, *m_image, vk::ImageViewType::e2D, m_shape.format, {}, range));
}

DeviceImage::DeviceImage(const Device& device, const Shape& shape, std::span<const std::span<const std::byte>> mips)
    : DeviceImage(device, shape) {
  ImageUpload upload(device, *this);
  for (std::uint32_t mip = 0; mip < mips.size(); ++mip) upload.write(mip, mips[mip]);
  upload.finish();
}

std::uint32_t standInSide(std::uint32_t side) { return std::has_single_bit(side) ? std::min(side, 2u) : 3; }

void changeLayout(const vk::raii::CommandBuffer& commands, const DeviceImage& image, vk::ImageLayout from,
                  vk::ImageLayout to) {
  const vk::ImageMemoryBarrier2 barrier(
      vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
      vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite,
      from, to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image.handle(), wholeOf(image.shape()));
  commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

} // namespace parity::gpu
