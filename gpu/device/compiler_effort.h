// How much a driver that compiles shaders on the CPU optimises them.
#pragma once

namespace parity::gpu {

// Asks Mesa's software drivers to optimise less, by GALLIVM_PERF=nopt: they compile in less time and shade more slowly.
// The pictures are the same. A value that the environment has already stays. Of no effect on other drivers, nor after
// the first device. Call it before other threads start.
void askForQuickCompilation();

} // namespace parity::gpu
