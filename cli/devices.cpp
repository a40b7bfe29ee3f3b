// parity devices: what Vulkan offers, and why each device is taken or not.
#include <algorithm>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/invocation.h"
#include "cli/output.h"

namespace parity::cli {

int runDevicesCommand(const DevicesCommand& command) {
  const std::vector<gpu::DeviceReport> reports = gpu::listDevices(command.device);
  if (!command.json.empty()) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const gpu::DeviceReport& r : reports)
      list.push_back({{"name", r.name},
                      {"driver", r.driver},
                      {"kind", r.kind},
                      {"api", r.apiVersion},
                      {"fp16", r.float16},
                      {"taken", r.taken},
                      {"reason", r.reason}});
    writeJson(command.json, dumpJson(list));
  }
  if (command.json != "-")
    for (std::size_t i = 0; i < reports.size(); ++i) {
      const gpu::DeviceReport& r = reports[i];
      print("{} {} {}\n    {}, Vulkan {}, {}, {}\n    {}\n", r.taken ? "*" : " ", i, r.name, r.kind, r.apiVersion,
            r.driver, r.float16 ? "fp16" : "no fp16", r.reason);
    }
  if (std::none_of(reports.begin(), reports.end(), [](const auto& r) { return r.taken; }))
    throw base::Error(
        base::ExitCode::failed, "Vulkan", "device",
        !reports.empty() && !command.device.name.empty()
            ? fmt::format("no device has the name or number '{}'; 'parity devices' lists them", command.device.name)
            : fmt::format("{}; 'apt-get install mesa-vulkan-drivers' installs the software device",
                          reports.empty() ? "no driver was found" : "no device can be used"));
  return 0;
}

} // namespace parity::cli
