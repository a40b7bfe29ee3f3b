// A sweep as one self-contained page.
#pragma once

#include <string>

#include "study/sweep/sweep_json.h"

namespace parity::sweep {

// The dashboard with the sweep and the pictures of its scenes as its data. Empty in a build without the dashboard.
std::string toPage(const SweepReport& report, const Conclusions& conclusions);

} // namespace parity::sweep
