// Which scene to compare.
#pragma once

#include "scenes/suite.h"

namespace parity::job {

// What to load: a suite entry, or the command line's one scene in the same form.
using SceneRequest = scenes::SuiteEntry;

} // namespace parity::job
