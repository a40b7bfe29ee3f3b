#include "gpu/device/memory.h"

#include <new>

namespace parity::gpu {

MemoryStore::Block MemoryStore::take(vk::DeviceSize size, std::uint32_t type, bool isMapped) {
  const std::scoped_lock lock(m_mutex);
  if (const auto found = m_blocks.find({size, type, isMapped}); found != m_blocks.end() && !found->second.empty()) {
    Block block = std::move(found->second.back());
    found->second.pop_back();
    m_kept -= size;
    return block;
  }
  const vk::MemoryAllocateInfo info(size, type);
  Block block;
  try {
    block.memory = vk::raii::DeviceMemory(m_device, info);
  } catch (const vk::SystemError&) {
    if (m_kept == 0) throw;
    drop();
    block.memory = vk::raii::DeviceMemory(m_device, info);
  }
  if (isMapped) block.mapped = static_cast<std::byte*>(block.memory.mapMemory(0, VK_WHOLE_SIZE));
  return block;
}

void MemoryStore::giveBack(vk::DeviceSize size, std::uint32_t type, Block block) noexcept {
  if (size > m_mostKept) return; // it ends here
  const std::scoped_lock lock(m_mutex);
  if (m_kept + size > m_mostKept) drop(); // sizes that are asked for again come back
  try {
    m_blocks[{size, type, block.mapped != nullptr}].push_back(std::move(block));
    m_kept += size;
  } catch (const std::bad_alloc&) { // it is not kept
  }
}

vk::DeviceSize MemoryStore::kept() const {
  const std::scoped_lock lock(m_mutex);
  return m_kept;
}

void MemoryStore::drop() {
  m_blocks.clear();
  m_kept = 0;
}

} // namespace parity::gpu
