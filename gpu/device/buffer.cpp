#include "gpu/device/buffer.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "base/error.h"

namespace parity::gpu {

namespace {

using Usage = vk::BufferUsageFlagBits;
using Property = vk::MemoryPropertyFlagBits;

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
  vk::MemoryPropertyFlags wanted = Property::eDeviceLocal;
  if (device.unifiedMemory()) wanted |= Property::eHostVisible | Property::eHostCoherent;
  try {
    m_memory = device.allocate(needs, wanted, Property::eHostCached, device.unifiedMemory());
  } catch (const vk::SystemError& error) {
    throw base::Error(base::ExitCode::failed, device.report().name, "buffer of " + std::to_string(size) + " bytes",
                      error.what());
  }
  m_buffer.bindMemory(m_memory.handle(), 0);
}

void Buffer::upload(std::span<const std::byte> bytes, vk::DeviceSize offset) const {
  assert(offset + bytes.size() <= m_size);
  if (bytes.empty()) return;
  if (std::byte* mapped = m_memory.mapped()) {
    std::memcpy(mapped + offset, bytes.data(), bytes.size());
    return;
  }
  std::optional<HostBuffer> temporary;
  const HostBuffer& staging = stagingOf(*m_device, bytes.size(), temporary);
  std::memcpy(staging.data(), bytes.data(), bytes.size());
  m_device->submit("upload", [&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(staging.handle(), *m_buffer, vk::BufferCopy(0, offset, bytes.size()));
  });
}

const std::byte* Buffer::mappedAt(vk::DeviceSize offset, [[maybe_unused]] vk::DeviceSize size) const {
  assert(offset + size <= m_size);
  const std::byte* mapped = m_memory.mapped();
  return mapped ? mapped + offset : nullptr;
}

void Buffer::download(std::span<std::byte> bytes, vk::DeviceSize offset) const {
  if (bytes.empty()) return;
  if (const std::byte* mapped = mappedAt(offset, bytes.size())) {
    std::memcpy(bytes.data(), mapped, bytes.size());
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
    m_memory = device.allocate(needs, Property::eHostVisible | Property::eHostCoherent, Property::eHostCached, true);
  } catch (const vk::SystemError& error) {
    throw base::Error(base::ExitCode::failed, device.report().name,
                      "buffer of " + std::to_string(size) + " bytes for copies", error.what());
  }
  m_buffer.bindMemory(m_memory.handle(), 0);
}

} // namespace parity::gpu
