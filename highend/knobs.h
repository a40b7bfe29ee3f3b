// The high-end path's knobs.
#pragma once

#include "base/knob/table.h"
#include "highend/options.h"

namespace parity::highend {

const base::KnobTable<Options>& knobs();

} // namespace parity::highend
