#include "study/sweep/machine.h"

#include "base/machine.h"
#include "base/parallel.h"
#include "compare/flip/flip_simd.h"

namespace parity::sweep {

Machine describeMachine(const gpu::DeviceReport& device) {
  Machine machine;
  machine.processor = base::processorName();
  if (machine.processor.empty()) machine.processor = "unknown";
  machine.device = device.name;
  machine.driver = device.driver;
  machine.deviceKind = device.kind;
  machine.simd = compare::simdLevels().front();
  machine.threads = base::threadCount();
  return machine;
}

} // namespace parity::sweep
