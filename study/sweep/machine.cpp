#include "study/sweep/machine.h"

#include <fstream>

#include "base/parallel.h"
#include "compare/flip/flip_simd.h"

namespace parity::sweep {

namespace {

std::string processorName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name"))
      if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return "unknown";
}

} // namespace

Machine describeMachine(const gpu::DeviceReport& device) {
  Machine machine;
  machine.processor = processorName();
  machine.device = device.name;
  machine.driver = device.driver;
  machine.deviceKind = device.kind;
  machine.simd = compare::simdLevels().front();
  machine.threads = base::threadCount();
  return machine;
}

} // namespace parity::sweep
