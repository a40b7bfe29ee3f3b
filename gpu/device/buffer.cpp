#include "gpu/device/buffer.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "base/error.h"

namespace parity::gpu {

namespace {

using Usage = vk::BufferUsageFlagBits;
using Memory = vk::MemoryPropertyFlagBits;

// The device's own, or where much is copied one that goes again.
const HostBuffer& stagingOf(const Device& device, vk::DeviceSize size, std::optional<HostBuffer>& temporary) {
  constexpr vk::DeviceSize kMostKept = vk::DeviceSize{64} << 20;
  return size <= kMostKept ? device.staging(size) : temporary.emplace(device, size);
}

} // namespace

Buffer::Buffer(const Device& device, vk::DeviceSize size)
    : m_device(&device), m_size(std::max<vk::DeviceSize>(size, 16)) {
  m_buffer = vk::raii::Buffer(device.handle(), vk::BufferCreateInfo({}, m_size,
                                                                    Usage::eStorageBuffer | Usage::eUniformBuffer |
                                                                        Usage::eVertexBuffer | Usage::eIndexBuffer |
                                                                        Usage::eTransferSrc | Usage::eTransferDst));
  const vk::MemoryRequirements needs = m_buffer.getMemoryRequirements();
  vk::MemoryPropertyFlags wanted = Memory::eDeviceLocal;
  if (device.unifiedMemory()) wanted |= Memory::eHostVisible | Memory::eHostCoherent;
  try {
    m_memory = vk::raii::DeviceMemory(
        device.handle(),
        vk::MemoryAllocateInfo(needs.size, device.memoryType(needs.memoryTypeBits, wanted, Memory::eHostCached)));
  } catch (const vk::SystemError& error) {
    throw base::Error(base::ExitCode::failed, device.report().name, "buffer of " + std::to_string(size) + " bytes",
                      error.what());
  }
  m_buffer.bindMemory(*m_memory, 0);
  if (device.unifiedMemory()) m_mapped = static_cast<std::byte*>(m_memory.mapMemory(0, VK_WHOLE_SIZE));
}

void Buffer::upload(std::span<const std::byte> bytes, vk::DeviceSize offset) const {
  assert(offset + bytes.size() <= m_size);
  if (bytes.empty()) return;
  if (m_mapped) {
    std::memcpy(m_mapped + offset, bytes.data(), bytes.size());
    return;
  }
  std::optional<HostBuffer> temporary;
  const HostBuffer& staging = stagingOf(*m_device, bytes.size(), temporary);
  std::memcpy(staging.data(), bytes.data(), bytes.size());
  m_device->submit("upload", [&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(staging.handle(), *m_buffer, vk::BufferCopy(0, offset, bytes.size()));
  });
}

void Buffer::download(std::span<std::byte> bytes, vk::DeviceSize offset) const {
  assert(offset + bytes.size() <= m_size);
  if (bytes.empty()) return;
  if (m_mapped) {
    std::memcpy(bytes.data(), m_mapped + offset, bytes.size());
    return;
  }
  std::optional<HostBuffer> temporary;
  const HostBuffer& staging = stagingOf(*m_device, bytes.size(), temporary);
  m_device->submit("download", [&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(*m_buffer, staging.handle(), vk::BufferCopy(offset, 0, bytes.size()));
  });
  std::memcpy(bytes.data(), staging.data(), bytes.size());
}

HostBuffer::HostBuffer(const Device& device, vk::DeviceSize size) : m_size(size) {
  m_buffer =
      vk::raii::Buffer(device.handle(), vk::BufferCreateInfo({}, size, Usage::eTransferSrc | Usage::eTransferDst));
  const vk::MemoryRequirements needs = m_buffer.getMemoryRequirements();
  try {
    m_memory = vk::raii::DeviceMemory(
        device.handle(),
        vk::MemoryAllocateInfo(needs.size,
                               device.memoryType(needs.memoryTypeBits, Memory::eHostVisible | Memory::eHostCoherent,
                                                 Memory::eHostCached)));
  } catch (const vk::SystemError& error) {
    throw base::Error(base::ExitCode::failed, device.report().name,
                      "buffer of " + std::to_string(size) + " bytes for copies", error.what());
  }
  m_buffer.bindMemory(*m_memory, 0);
  m_mapped = static_cast<std::byte*>(m_memory.mapMemory(0, VK_WHOLE_SIZE));
}

} // namespace parity::gpu
