// The mobile path's knobs.
#pragma once

#include <string>

#include "base/knob/table.h"
#include "mobile/options.h"

namespace parity::mobile {

// The preset is the first: it sets most of the others.
const base::KnobTable<Options>& knobs();

// Throws Error (usage) for what does not go together, with the option that says so. display: name of the display
// transform.
void requireSense(const Options& options, const std::string& display);

} // namespace parity::mobile
