// Runs one of the table's functions, or any shader of that form, over rows of floats on the device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device/pipeline.h"

namespace parity::stress {

// The shader that holds this function of the table, in half or single.
gpu::Spirv functionShader(int id, bool half);

// A pipeline of `shader` (entry point main, 64 rows a group; binding 0 reads inputs, binding 1 writes outputs, push
// constant 0 is the number of rows) with `function` as specialization constant 0. The device must outlive it.
class DeviceRows {
public:
  // Throws Error (exit 4) where the validation layer objects.
  DeviceRows(const gpu::Device& device, gpu::Spirv shader, std::int32_t function);

  // rows * outputStride floats, NaN where nothing was written. At most 65535 * 64 rows; any number of inputs. Throws
  // Error (exit 4) when the device is lost or a validation message came.
  std::vector<float> run(std::span<const float> inputs, std::uint32_t rows, std::uint32_t outputStride) const;

private:
  const gpu::Device& m_device;
  vk::raii::DescriptorSetLayout m_setLayout{nullptr};
  vk::raii::PipelineLayout m_layout{nullptr};
  vk::raii::Pipeline m_pipeline{nullptr};
};

} // namespace parity::stress
