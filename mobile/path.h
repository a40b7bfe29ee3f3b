// The mobile path, as paths/path.h says what a path is.
#pragma once

#include "paths/path.h"

namespace parity::mobile {

const paths::Path& path();

} // namespace parity::mobile
