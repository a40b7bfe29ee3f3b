// What something that is left out of a picture does to each material of it.
#pragma once

#include <cstddef>
#include <map>
#include <set>

#include "job/view/material_swaps.h"
#include "job/view/view_builder.h"

namespace parity::job {

// Mean FLIP against the first path's picture of those in which each of the materials alone, that has pixels, looks as
// in `without`, another picture of that path. reference: the first, displayed.
std::map<std::size_t, double> swapEffects(Context& context, const std::set<std::size_t>& materials,
                                          const ViewFrames& frames, const Displayed& reference,
                                          const base::Image& without, float exposureEv);

} // namespace parity::job
