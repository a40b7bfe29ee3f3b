#include "gpu/device/memory.h"

namespace parity::gpu {

MemoryStore::Block MemoryStore::take(vk::DeviceSize size, std::uint32_t type, bool isMapped) {
  {
    const std::scoped_lock lock(m_mutex);
    if (const auto found = m_blocks.find({size, type, isMapped}); found != m_blocks.end() && !found->second.empty()) {
      Block block = std::move(found->second.back());
      found->second.pop_back();
      m_kept -= size;
      return block;
    }
  }
  Block block;
  block.memory = vk::raii::DeviceMemory(m_device, vk::MemoryAllocateInfo(size, type));
  if (isMapped) block.mapped = static_cast<std::byte*>(block.memory.mapMemory(0, VK_WHOLE_SIZE));
  return block;
}

void MemoryStore::giveBack(vk::DeviceSize size, std::uint32_t type, Block block) {
  const std::scoped_lock lock(m_mutex);
  if (m_kept + size > m_mostKept) return; // it ends here
  m_kept += size;
  m_blocks[{size, type, block.mapped != nullptr}].push_back(std::move(block));
}

} // namespace parity::gpu
