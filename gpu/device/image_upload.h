// The way of pixels into a device image, by a staging buffer that does not grow with the image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device/buffer.h"
#include "gpu/device/image.h"

namespace parity::gpu {

// Fills a new image of uncompressed texels of 1, 2, 4, 8 or 16 bytes. Not thread-safe.
class ImageUpload {
public:
  // Both must outlive it.
  ImageUpload(const Device& device, const DeviceImage& image);

  // A mip: its layers one after another, rows tight. What was written may be gone from the host's memory afterwards.
  void write(std::uint32_t mip, std::span<const std::byte> pixels);
  // After all mips: the image is left in eShaderReadOnlyOptimal.
  void finish();

private:
  void submit(bool isLast);

  const Device& m_device;
  const DeviceImage& m_image;
  HostBuffer m_staging;
  vk::DeviceSize m_used = 0;
  std::vector<vk::BufferImageCopy> m_copies; // that wait in the staging buffer
  bool m_isFirst = true;
};

} // namespace parity::gpu
