// Angles in degrees, as people write them.
#pragma once

#include <numbers>

namespace parity::external {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kDegree = kPi / 180; // in radians

} // namespace parity::external
