#include "gpu/device/compiler_effort.h"

#include <cstdlib>

namespace parity::gpu {

void askForQuickCompilation() { setenv("GALLIVM_PERF", "nopt", 0); }

} // namespace parity::gpu
