// The intermediates of the mobile base pass that can be looked at: `parity render --path mobile --term NAME`.
#pragma once

#include <vector>

#include "mobile/shaders/views.h"
#include "paths/path.h"

namespace parity::mobile {

using View = paths::Intermediate;

// By number (mobile/shaders/views.h). The first is the lit picture.
const std::vector<View>& views();

} // namespace parity::mobile
