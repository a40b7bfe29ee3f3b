// The high-end path, as paths/path.h says what a path is.
#pragma once

#include "highend/options.h"
#include "paths/path.h"

namespace parity::highend {

const paths::Path& path();

// The environment BRDF's table of these options: of the run's store, else of the cache, else made.
const base::Image& envBrdfLutOf(const Options& options, const paths::Services& services);

} // namespace parity::highend
