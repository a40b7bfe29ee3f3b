#include "study/sweep/machine.h"

#include "base/machine.h"
#include "base/parallel.h"
#include "base/simd_level.h"

namespace parity::sweep {

Machine describeMachine(const gpu::DeviceReport& device) {
  Machine machine;
  machine.processor = base::processorName();
  if (machine.processor.empty()) machine.processor = "unknown";
  machine.device = device.name;
  machine.driver = device.driver;
  machine.deviceKind = device.kind;
  machine.simd = base::simdLevels().front();
  machine.threads = base::threadCount();
  return machine;
}

} // namespace parity::sweep
