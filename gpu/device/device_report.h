// What Vulkan devices there are, and which one is wanted: plain data, without Vulkan's headers.
#pragma once

#include <string>
#include <vector>

namespace parity::gpu {

struct DeviceOptions {
  std::string name; // substring of the device's name, case-insensitive, or its index; "": lavapipe, else any CPU device
  bool validation =
      false; // load the Khronos validation layer; each of its messages becomes an Error at the next submit
};

// One physical device, and why it was taken or refused.
struct DeviceReport {
  std::string name, driver, kind; // kind: "cpu", "discrete", "integrated", "virtual", "other"
  std::string apiVersion;
  bool float16 = false; // shaderFloat16: the mobile path can run in half
  bool taken = false;
  std::string reason;              // one line
  std::string build;               // tells apart the builds of a driver, whose pictures may differ: hexadecimal digits
  std::string description() const; // "name (driver)"
};

// All devices in the driver's order with the choice that `options` leads to. Empty where there is none. Throws Error
// (exit 4) where the Vulkan loader itself is missing, naming the packages to install.
std::vector<DeviceReport> listDevices(const DeviceOptions& options);

// The one that Device(options) would take, without making it: half the time. Throws Error (exit 4) as that does.
DeviceReport findDevice(const DeviceOptions& options);

} // namespace parity::gpu
