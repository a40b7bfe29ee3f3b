// What a list of pixels must be before anything is measured over it.
#pragma once

#include <cstddef>

#include "base/frame.h"

namespace parity::compare {

// Throws Error (failed), naming the list and the place in it, for a pixel beyond pixelCount, pixels not in strictly
// ascending order, a number of weights other than 0 or that of the pixels, or a weight that is negative or not finite.
void requireWellFormed(const base::PixelList& list, std::size_t pixelCount);

} // namespace parity::compare
