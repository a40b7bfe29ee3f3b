// Device images: textures with mips, cubes, attachments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device/buffer.h"

namespace parity::gpu {

// Layouts of images that are read, and of depth that is written.
inline constexpr auto kReadOnlyLayout = vk::ImageLayout::eShaderReadOnlyOptimal;
inline constexpr auto kDepthLayout = vk::ImageLayout::eDepthStencilAttachmentOptimal;

// An image with its memory and a view of all of it.
class DeviceImage {
public:
  struct Shape {
    vk::Format format = vk::Format::eR8G8B8A8Unorm;
    std::uint32_t width = 1, height = 1, mips = 1;
    bool cube = false;           // 6 layers an array element, seen as a cube array
    bool array = false;          // seen as an array of `arraySize` layers
    std::uint32_t arraySize = 1; // of cubes, or of layers
    vk::ImageUsageFlags usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst;

    std::uint32_t layers() const { return (cube ? 6 : 1) * arraySize; }
  };

  DeviceImage() = default;
  DeviceImage(const Device& device, const Shape& shape);

  // A sampled image with this content, one span a mip (all layers of a mip one after another, rows tight), left in
  // eShaderReadOnlyOptimal.
  DeviceImage(const Device& device, const Shape& shape, std::span<const std::span<const std::byte>> mips);

  vk::Image handle() const { return *m_image; }
  vk::ImageView view() const { return *m_view; }
  // Of one layer of an array, to draw into.
  vk::raii::ImageView layerView(const Device& device, std::uint32_t layer) const;
  const Shape& shape() const { return m_shape; }

private:
  Shape m_shape;
  Memory m_memory;
  vk::raii::Image m_image{nullptr};
  vk::raii::ImageView m_view{nullptr};
};

// The side of a small image that stands for one of this side: lavapipe compiles a shader anew for each kind of image,
// and tells them apart by having mips, and by sides that are powers of two.
std::uint32_t standInSide(std::uint32_t side);

// Records a layout change of all of `image`, after all that came before.
void changeLayout(const vk::raii::CommandBuffer& commands, const DeviceImage& image, vk::ImageLayout from,
                  vk::ImageLayout to);

} // namespace parity::gpu
