// The high-end path, as paths/path.h says what a path is.
#pragma once

#include "highend/options.h"
#include "paths/path.h"

namespace parity::highend {

const paths::Path& path();

} // namespace parity::highend
