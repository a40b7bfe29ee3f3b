// The intermediates of the high-end path that can be looked at: `parity render --path highend --term NAME`. Those that
// the mobile path has, too, have the same names there (mobile/views.h).
#pragma once

#include <vector>

#include "highend/shaders/views.h"
#include "paths/path.h"

namespace parity::highend {

using View = paths::Intermediate;

// By number (highend/shaders/views.h). The first is the lit picture.
const std::vector<View>& views();

} // namespace parity::highend
