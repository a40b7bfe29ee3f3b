// The machine that the program runs on. Linux.
#pragma once

#include <string>

namespace parity::base {

// The processor's name for people, "AMD EPYC 7763 64-Core Processor"; empty where the system does not tell.
std::string processorName();

// CPU time of all threads of this process so far, seconds.
double cpuSeconds();

} // namespace parity::base
