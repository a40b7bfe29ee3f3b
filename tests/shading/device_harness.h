// The smallest Vulkan compute host: runs one shader over rows of floats, under the validation layer.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace parity::tests {

// A device with one compute queue. Software (CPU) devices are preferred, so that results do not depend on the machine.
class DeviceHarness {
public:
  // Null where no driver offers a Vulkan device. Throws std::runtime_error where there is one but no validation layer.
  static std::unique_ptr<DeviceHarness> open();
  virtual ~DeviceHarness() = default;

  virtual const std::string& deviceName() const = 0;
  virtual bool hasShaderFloat16() const = 0;

  // Dispatches `spirv` (entry point main, 64 rows a group; binding 0 reads inputs, binding 1 writes outputs, push
  // constant 0 is the number of rows, specialization constant 0 is `function`). Returns rows * outputStride floats, NaN
  // where nothing was written. Throws std::runtime_error when Vulkan fails or a validation message came.
  virtual std::vector<float> run(std::span<const std::uint32_t> spirv, std::int32_t function,
                                 std::span<const float> inputs, std::uint32_t rows, std::uint32_t outputStride) = 0;
};

} // namespace parity::tests
