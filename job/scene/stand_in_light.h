// What stands for a path's light until its environment is prepared: shaders are compiled by it.
#pragma once

#include "paths/path.h"

namespace parity::job {

// light: with its cells, if the path needs them, and without its environment. The result has a small environment of
// the kind of the one to come: the path needs the same shaders for both.
paths::Light standInLight(const paths::Light& light, const paths::LightNeeds& needs);

} // namespace parity::job
