// The Vulkan device: chosen with reasons, one queue, synchronous submissions, device time by timestamps.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "base/stopwatch.h"
#include "gpu/device/device_report.h"
#include "gpu/device/memory.h"
#include "gpu/device/vulkan.h"

namespace parity::gpu {

class HostBuffer;

// Owns instance, device and queue. Not thread-safe: one thread at a time.
class Device {
public:
  // Throws Error (exit 4) with the reasons of every refusal where no device can be taken, or where validation is asked
  // for and the layer is not installed.
  explicit Device(const DeviceOptions& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const vk::raii::Device& handle() const { return m_device; }
  const vk::PhysicalDeviceProperties& properties() const { return m_properties; }
  const DeviceReport& report() const { return m_report; }
  // Whether this format can be read with linear filtering.
  bool filtersLinearly(vk::Format format) const;

  // Index of a memory type with all of `wanted` among `typeBits`, preferring `preferred` too. Throws Error (exit 4).
  std::uint32_t memoryType(std::uint32_t typeBits, vk::MemoryPropertyFlags wanted,
                           vk::MemoryPropertyFlags preferred) const;
  // A block of memory of this kind, mapped where isMapped. Throws vk::SystemError, and Error (exit 4) as memoryType.
  Memory allocate(const vk::MemoryRequirements& needs, vk::MemoryPropertyFlags wanted,
                  vk::MemoryPropertyFlags preferred, bool isMapped) const;
  // Memory of the host for copies, of at least this size: the same until the next call.
  const HostBuffer& staging(vk::DeviceSize size) const;
  // Whether device-local memory can be mapped (CPU and integrated devices): then nothing is staged.
  bool unifiedMemory() const { return m_unifiedMemory; }
  // Whether shaders take less time here with accessBuffersByPairs, and may have 64-bit integers for it.
  bool accessesByPairs() const { return m_accessesByPairs; }

  // Records, submits and waits; `record` must not submit. Throws Error (exit 4) when the device is lost or the
  // validation layer spoke. The device time is added to timings() under "device: " + stage: by timestamps; on a
  // software device, whose timestamps do not span compute dispatches (lavapipe 22.3 says 0.1 ms of one that takes 100),
  // from submission to the fence.
  void submit(const std::string& stage, const std::function<void(const vk::raii::CommandBuffer&)>& record) const;

  // Device times go there; null: nowhere.
  void setTimings(base::Timings* timings) { m_timings = timings; }
  base::Timings* timings() const { return m_timings; }

  // Throws Error (exit 4) with the first message that the validation layer has left since the last call.
  void checkValidation() const;

private:
  struct Messages;
  vk::raii::Context m_context;
  std::unique_ptr<Messages> m_messages;
  vk::raii::Instance m_instance{nullptr};
  vk::raii::DebugUtilsMessengerEXT m_messenger{nullptr};
  vk::raii::PhysicalDevice m_physical{nullptr};
  vk::PhysicalDeviceProperties m_properties;
  vk::PhysicalDeviceMemoryProperties m_memory;
  DeviceReport m_report;
  bool m_unifiedMemory = false, m_accessesByPairs = false;
  std::uint32_t m_queueFamily = 0;
  std::uint32_t m_timestampBits = 0;
  vk::raii::Device m_device{nullptr};
  std::unique_ptr<MemoryStore> m_memoryStore;
  vk::raii::Queue m_queue{nullptr};
  vk::raii::CommandPool m_commandPool{nullptr};
  vk::raii::QueryPool m_queries{nullptr};
  // Made once: a driver takes longer for a fence than for a small copy.
  vk::raii::CommandBuffers m_commands{nullptr};
  vk::raii::Fence m_fence{nullptr};
  mutable bool m_isSubmitting = false;
  mutable std::unique_ptr<HostBuffer> m_staging;
  base::Timings* m_timings = nullptr;
};

// A barrier between all that came before and all that comes after.
void fullBarrier(const vk::raii::CommandBuffer& commands);

} // namespace parity::gpu
