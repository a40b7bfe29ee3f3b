// Swapped pictures (gpu/surface/material_swap.h) as a screen shows them: what materials are measured by.
#pragma once

#include <vector>

#include "compare/metrics/measure_swaps.h"
#include "gpu/surface/material_swap.h"
#include "job/context.h"
#include "job/view/displayed.h"

namespace parity::job {

// The picture of which the swaps are, as it is displayed.
compare::SwapReference referenceOf(const Displayed& displayed, const base::Image& exposedLinear);

// A gathered picture of the list's pixels, linear and scene-referred, as it is displayed and exposed.
compare::Swap displaySwap(Context& context, const base::PixelList& list, const base::Image& colors, float exposureEv);

// The same of a plane of SwappedPixels. finished: the displayed picture of the test path, which whole pixels take as it
// is; null: none.
compare::Swap displaySwap(Context& context, const base::PixelList& list, const gpu::SwappedPixels& swapped,
                          std::size_t plane, float exposureEv, const Displayed* finished);

// Of pictures that are not composed of surfaces a material takes its share by its coverage: before + weight * (after -
// before) at the list's pixels. Linear and scene-referred; one plane, whole where the weight is 1.
gpu::SwappedPixels mixByCoverage(const base::PixelList& list, const base::Image& before, const base::Image& after);

} // namespace parity::job
