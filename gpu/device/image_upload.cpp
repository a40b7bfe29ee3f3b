#include "gpu/device/image_upload.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <span>

#include <vulkan/vulkan_format_traits.hpp>

#include "base/parallel.h"

namespace parity::gpu {

namespace {

constexpr vk::DeviceSize kMaxStagingBytes = 16 << 20; // a row of the largest image is a sixty-fourth of it
constexpr vk::DeviceSize kAlignment = 16;             // of a copy's begin, which must be a multiple of a texel's size

vk::DeviceSize alignUp(vk::DeviceSize size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

std::uint32_t sideOf(std::uint32_t side, std::uint32_t mip) { return std::max(side >> mip, 1u); }

vk::DeviceSize stagingBytes(const DeviceImage::Shape& shape) {
  vk::DeviceSize total = 0;
  for (std::uint32_t mip = 0; mip < shape.mips && total < kMaxStagingBytes; ++mip)
    total += shape.layers() * alignUp(vk::DeviceSize{vk::blockSize(shape.format)} * sideOf(shape.width, mip) *
                                      sideOf(shape.height, mip));
  return std::min(total, kMaxStagingBytes);
}

// Most of the time goes to new pages of memory, so all threads copy.
void copyBytes(std::span<const std::byte> from, std::byte* to) {
  constexpr std::size_t kGrainBytes = std::size_t{1} << 20;
  base::parallelFor(from.size(), kGrainBytes, [&](std::size_t begin, std::size_t end) {
    std::memcpy(to + begin, from.data() + begin, end - begin);
  });
}

} // namespace

ImageUpload::ImageUpload(const Device& device, const DeviceImage& image)
    : m_device(device), m_image(image), m_staging(device, stagingBytes(image.shape())) {
  assert(kAlignment % vk::blockSize(image.shape().format) == 0);
}

void ImageUpload::write(std::uint32_t mip, std::span<const std::byte> pixels) {
  const DeviceImage::Shape& shape = m_image.shape();
  const std::uint32_t width = sideOf(shape.width, mip), height = sideOf(shape.height, mip);
  const vk::DeviceSize rowBytes = vk::DeviceSize{vk::blockSize(shape.format)} * width;
  assert(pixels.size() == rowBytes * height * shape.layers() && rowBytes <= m_staging.size());
  for (std::uint32_t layer = 0; layer < shape.layers(); ++layer)
    for (std::uint32_t row = 0; row < height;) {
      const vk::DeviceSize begin = alignUp(m_used);
      const vk::DeviceSize room = begin < m_staging.size() ? (m_staging.size() - begin) / rowBytes : 0;
      if (room == 0) {
        submit(false);
        continue;
      }
      const auto rows = static_cast<std::uint32_t>(std::min<vk::DeviceSize>(room, height - row));
      copyBytes(pixels.subspan((vk::DeviceSize{layer} * height + row) * rowBytes, rows * rowBytes),
                m_staging.data() + begin);
      m_copies.emplace_back(begin, 0, 0, vk::ImageSubresourceLayers(vk::ImageAspectFlagBits::eColor, mip, layer, 1),
                            vk::Offset3D(0, static_cast<std::int32_t>(row), 0), vk::Extent3D(width, rows, 1));
      m_used = begin + rows * rowBytes;
      row += rows;
    }
}

void ImageUpload::finish() { submit(true); }

void ImageUpload::submit(bool isLast) {
  m_device.submit("upload", [&](const vk::raii::CommandBuffer& commands) {
    if (m_isFirst) changeLayout(commands, m_image, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
    if (!m_copies.empty())
      commands.copyBufferToImage(m_staging.handle(), m_image.handle(), vk::ImageLayout::eTransferDstOptimal, m_copies);
    if (isLast)
      changeLayout(commands, m_image, vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
  });
  m_isFirst = false;
  m_copies.clear();
  m_used = 0;
}

} // namespace parity::gpu
