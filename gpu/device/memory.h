// Memory of the device: a driver takes some .4 ms to hand out a block and as long to take it back, so that blocks are
// kept for the next buffer or image of the same size and kind.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

#include "gpu/device/vulkan.h"

namespace parity::gpu {

// The blocks that are kept. Thread-safe. Ends after all that it has handed out, and before the device.
class MemoryStore {
public:
  struct Block {
    vk::raii::DeviceMemory memory{nullptr};
    std::byte* mapped = nullptr; // as long as the block lives; null where it is not mapped
  };

  // mostKept: bytes that are kept at most; what is kept goes where more would be. 0: nothing is kept.
  MemoryStore(const vk::raii::Device& device, vk::DeviceSize mostKept) : m_device(device), m_mostKept(mostKept) {}

  // A block of exactly this size; its content is undefined. Where the device has no more, what is kept goes first.
  // Throws vk::SystemError.
  Block take(vk::DeviceSize size, std::uint32_t type, bool isMapped);
  void giveBack(vk::DeviceSize size, std::uint32_t type, Block block) noexcept;
  vk::DeviceSize kept() const; // bytes

private:
  void drop(); // all that is kept; under the lock

  const vk::raii::Device& m_device;
  const vk::DeviceSize m_mostKept;
  vk::DeviceSize m_kept = 0;
  mutable std::mutex m_mutex;
  std::map<std::tuple<vk::DeviceSize, std::uint32_t, bool>, std::vector<Block>> m_blocks; // size, type, mapped
};

// A block of a store, which gets it back when this ends. Buffers and images end before their memory.
class Memory {
public:
  Memory() = default;
  Memory(MemoryStore& store, vk::DeviceSize size, std::uint32_t type, bool isMapped)
      : m_store(&store), m_size(size), m_type(type), m_block(store.take(size, type, isMapped)) {}
  Memory(Memory&& other) noexcept { swap(other); }
  Memory& operator=(Memory&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Memory() {
    if (m_store) m_store->giveBack(m_size, m_type, std::move(m_block));
  }

  vk::DeviceMemory handle() const { return *m_block.memory; }
  std::byte* mapped() const { return m_block.mapped; }

private:
  void swap(Memory& other) noexcept {
    std::swap(m_store, other.m_store);
    std::swap(m_size, other.m_size);
    std::swap(m_type, other.m_type);
    std::swap(m_block, other.m_block);
  }

  MemoryStore* m_store = nullptr;
  vk::DeviceSize m_size = 0;
  std::uint32_t m_type = 0;
  MemoryStore::Block m_block;
};

} // namespace parity::gpu
