// parity --version: what is asked first where something differs between two machines.
#include "base/version.h"
#include "base/build_info.h"
#include "base/error.h"
#include "base/text/error_words.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "gpu/device/device_report.h"

namespace parity::cli {

namespace {

// Without a driver, too: a line in words.
std::string describeDevice() {
  try {
    const gpu::DeviceReport device = gpu::findDevice({});
    return fmt::format("device: {}, Vulkan {}", device.description(), device.apiVersion);
  } catch (const base::Error& error) {
    return "no Vulkan device: " + error.reason();
  } catch (const std::exception& error) {
    return "no Vulkan device: " + base::wordsOf(error);
  }
}

} // namespace

int runVersionCommand() {
  print("parity {}\nbuild: {}\n", base::kVersion, base::describeBuild());
  print("{}\n", describeDevice()); // a driver is asked, which may take a while
  return 0;
}

} // namespace parity::cli
