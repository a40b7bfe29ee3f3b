// On what machine a sweep was taken.
#pragma once

#include "gpu/device/device_report.h"
#include "study/sweep/sweep_report.h"

namespace parity::sweep {

// The processor's name as Linux tells it ("unknown" where it does not), threads as ThreadLimit allows, the best SIMD
// level that compare/ uses.
Machine describeMachine(const gpu::DeviceReport& device);

} // namespace parity::sweep
