// The lobes of a material that a path drops, in words.
#pragma once

#include <string>

#include "report/report.h"

namespace parity::report {

// "mobile drops the clear coat (FLIP 0.043 of the high-end picture without it) and the sheen (0.12)". The material
// drops at least one. Paths by their names.
std::string describeDroppedLobes(const MaterialResult& material, const std::string& reference, const std::string& test);

} // namespace parity::report
