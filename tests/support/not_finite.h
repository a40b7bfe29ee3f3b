// Floats that are no finite numbers.
#pragma once

#include <limits>

namespace parity::tests {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

} // namespace parity::tests
