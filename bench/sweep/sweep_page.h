// A sweep as one self-contained page.
#pragma once

#include <string>

#include "sweep/sweep_json.h"

namespace parity::sweep {

// HTML: what to conclude, then a Pareto picture and a table a scene. Nothing outside of it is read.
std::string toPage(const SweepReport& report, const Conclusions& conclusions);

} // namespace parity::sweep
