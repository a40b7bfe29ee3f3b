// What stands for a path's light until its environment is prepared: shaders are compiled by it.
#pragma once

#include "paths/path.h"

namespace parity::job {

// The path's light with a small environment of the same kind: the path needs the same shaders for it, if the
// environment to come has lamps, and sides that are powers of two.
paths::Light standInLight(const paths::Light& light, const paths::LightNeeds& needs);

} // namespace parity::job
