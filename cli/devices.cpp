// parity devices: what Vulkan offers, why each device is taken or not, and how the one that is taken rounds.
#include <algorithm>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "job/context.h"

namespace parity::cli {

namespace {

// Of the device that is taken; the cache holds it from the second time on. A device that fails is listed all the same.
struct Numerics {
  std::string id, reason; // one is empty
};
Numerics numericsOf(const gpu::DeviceOptions& device) {
  try {
    job::Settings settings;
    settings.device = device;
    settings.cacheFolder = base::defaultCacheFolder();
    return {job::Context(settings).numerics(), {}};
  } catch (const base::Error& error) {
    return {{}, error.what()};
  }
}

} // namespace

int runDevicesCommand(const DevicesCommand& command) {
  const std::vector<gpu::DeviceReport> reports = gpu::listDevices(command.device);
  const bool isAnyTaken = std::ranges::any_of(reports, &gpu::DeviceReport::taken);
  const Numerics numerics = isAnyTaken ? numericsOf(command.device) : Numerics();
  if (!command.json.empty()) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const gpu::DeviceReport& r : reports) {
      list.push_back({{"name", r.name},
                      {"driver", r.driver},
                      {"kind", r.kind},
                      {"api", r.apiVersion},
                      {"fp16", r.float16},
                      {"taken", r.taken},
                      {"reason", r.reason}});
      if (r.taken && !numerics.id.empty()) list.back()["numerics"] = numerics.id;
    }
    writeJson(command.json, dumpJson(list));
  }
  if (command.json != "-")
    for (std::size_t i = 0; i < reports.size(); ++i) {
      const gpu::DeviceReport& r = reports[i];
      print("{} {} {}\n    {}, Vulkan {}, {}, {}\n    {}\n", r.taken ? "*" : " ", i, r.name, r.kind, r.apiVersion,
            r.driver, r.float16 ? "fp16" : "no fp16", r.reason);
      if (r.taken && numerics.reason.empty()) print("    numerics id {}\n", numerics.id);
      if (r.taken && !numerics.reason.empty()) print("    numerics id unknown: {}\n", numerics.reason);
    }
  if (!isAnyTaken)
    throw base::Error(
        base::ExitCode::failed, "Vulkan", "device",
        !reports.empty() && !command.device.name.empty()
            ? fmt::format("no device has the name or number '{}'; 'parity devices' lists them", command.device.name)
            : fmt::format("{}; 'apt-get install mesa-vulkan-drivers' installs the software device",
                          reports.empty() ? "no driver was found" : "no device can be used"));
  return 0;
}

} // namespace parity::cli
