// Which Vulkan device is taken, and the reason for each.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device/device.h"

namespace parity::gpu {

// The first queue family with graphics and compute, or nothing.
std::optional<std::uint32_t> graphicsQueueFamily(const vk::raii::PhysicalDevice& device);

// Index of the choice among the devices without a refusal, or -1: the one that the user names (digits alone are an
// index into the list, anything else part of the name, case-insensitive; the first among several), without a name
// lavapipe, else another software device. Hardware is taken only by name: pictures of software devices are the same on
// every machine.
int chooseByName(const std::vector<DeviceReport>& reports, const std::vector<std::string>& refusals,
                 const std::string& name);

struct DeviceChoice {
  std::vector<DeviceReport> reports; // in the order of `devices`, each with its reason
  int taken = -1;                    // -1: none
};
DeviceChoice chooseDevice(const std::vector<vk::raii::PhysicalDevice>& devices, const DeviceOptions& options);

} // namespace parity::gpu
