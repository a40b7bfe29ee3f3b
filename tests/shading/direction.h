// A direction in double precision, for quadratures.
#pragma once

namespace parity::tests {

struct Direction {
  double x, y, z;
};
inline double dot(const Direction& a, const Direction& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

} // namespace parity::tests
