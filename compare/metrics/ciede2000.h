// The CIEDE2000 colour difference (Sharma, Wu, Dalal 2005, "The CIEDE2000 color-difference formula: implementation
// notes, supplementary test data, and mathematical observations").
#pragma once

#include "compare/metrics/color_rows.h"

namespace parity::compare {

// out[i] = Delta E00 of two CIELAB colours, kL = kC = kH = 1, within 1e-4 (Sharma's 34 pairs are tested). 0 for equal
// colours. out may not overlap the inputs.
void ciede2000Row(const LabRow& reference, const LabRow& test, int count, float* out);

} // namespace parity::compare
