// The memory of a report's rows, of which a nightly run holds a hundred thousand and more.
#pragma once

#include "report/report.h"

namespace parity::report {

// Gives back what the lists and texts of a scene have room for beyond what they hold: lists that grow element by
// element have up to half of it.
void trim(SceneResult& scene);

} // namespace parity::report
