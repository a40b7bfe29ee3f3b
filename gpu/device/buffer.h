// Buffers, with or without a view from the host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "gpu/device/device.h"

namespace parity::gpu {

// A storage buffer (also vertex, index, uniform and transfer) in device-local memory; mapped where the device allows
// it.
class Buffer {
public:
  Buffer() = default;
  // size 0 is rounded up to 16 bytes: every binding must be filled.
  Buffer(const Device& device, vk::DeviceSize size);
  // With this content.
  template <typename T> Buffer(const Device& device, std::span<const T> content)
      : Buffer(device, content.size_bytes()) {
    upload(std::as_bytes(content));
  }

  vk::Buffer handle() const { return *m_buffer; }
  vk::DeviceSize size() const { return m_size; }
  vk::DescriptorBufferInfo info() const { return {*m_buffer, 0, m_size}; }

  // Copy from or to the host; staged where the memory is not mapped. Bytes beyond size() are a bug.
  void upload(std::span<const std::byte> bytes, vk::DeviceSize offset = 0) const;
  void download(std::span<std::byte> bytes, vk::DeviceSize offset = 0) const;
  template <typename T> std::vector<T> downloadAs(std::size_t count, vk::DeviceSize offset = 0) const {
    if (const std::span<const T> mapped = mappedAs<T>(count, offset); !mapped.empty()) // not cleared first
      return std::vector<T>(mapped.begin(), mapped.end());
    std::vector<T> values(count);
    download(std::as_writable_bytes(std::span{values}), offset);
    return values;
  }

  // The values where they are, which the host reads as fast as its own; empty where the memory is not mapped.
  template <typename T> std::span<const T> mappedAs(std::size_t count, vk::DeviceSize offset = 0) const {
    const std::byte* mapped = mappedAt(offset, count * sizeof(T));
    if (!mapped) return {};
    return {reinterpret_cast<const T*>(mapped), count};
  }

private:
  // Null where the memory is not mapped.
  const std::byte* mappedAt(vk::DeviceSize offset, vk::DeviceSize size) const;

  const Device* m_device = nullptr;
  vk::DeviceSize m_size = 0;
  Memory m_memory;
  vk::raii::Buffer m_buffer{nullptr};
};

// Memory of the host that the device copies from and to: mapped as long as it lives.
class HostBuffer {
public:
  HostBuffer(const Device& device, vk::DeviceSize size); // above 0

  vk::Buffer handle() const { return *m_buffer; }
  vk::DeviceSize size() const { return m_size; }
  std::byte* data() const { return m_memory.mapped(); }

private:
  vk::DeviceSize m_size = 0;
  Memory m_memory;
  vk::raii::Buffer m_buffer{nullptr};
};

} // namespace parity::gpu
