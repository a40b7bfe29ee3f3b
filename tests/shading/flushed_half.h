// Half precision without denormals, and GLSL's functions for it.
#pragma once

#include <cmath>

#include "shading/half.h"

namespace parity::tests {

// A half whose denormal results are 0, as a device without them has it.
class FlushedHalf {
public:
  constexpr FlushedHalf() = default;
  constexpr explicit FlushedHalf(double value) : m_half(flush(shading::Half(value))) {}
  constexpr explicit FlushedHalf(float value) : m_half(flush(shading::Half(value))) {}
  constexpr explicit FlushedHalf(int value) : m_half(value) {}
  constexpr operator float() const { return m_half; }
  friend constexpr FlushedHalf operator+(FlushedHalf a, FlushedHalf b) { return FlushedHalf(float(a) + float(b)); }
  friend constexpr FlushedHalf operator-(FlushedHalf a, FlushedHalf b) { return FlushedHalf(float(a) - float(b)); }
  friend constexpr FlushedHalf operator*(FlushedHalf a, FlushedHalf b) { return FlushedHalf(float(a) * float(b)); }
  friend constexpr FlushedHalf operator/(FlushedHalf a, FlushedHalf b) { return FlushedHalf(float(a) / float(b)); }
  friend constexpr FlushedHalf operator-(FlushedHalf a) { return FlushedHalf(-float(a)); }
  friend constexpr bool operator==(FlushedHalf a, FlushedHalf b) { return float(a) == float(b); }
  friend constexpr auto operator<=>(FlushedHalf a, FlushedHalf b) { return float(a) <=> float(b); }

private:
  static constexpr shading::Half flush(shading::Half h) {
    return (h.bits() & 0x7c00u) == 0 ? shading::Half::fromBits(h.bits() & 0x8000u) : h;
  }
  shading::Half m_half;
};

} // namespace parity::tests

namespace parity::shading {
inline tests::FlushedHalf sqrt(tests::FlushedHalf x) { return tests::FlushedHalf(std::sqrt(float(x))); }
inline tests::FlushedHalf exp2(tests::FlushedHalf x) { return tests::FlushedHalf(std::exp2(float(x))); }
inline tests::FlushedHalf log2(tests::FlushedHalf x) { return tests::FlushedHalf(std::log2(float(x))); }
inline tests::FlushedHalf pow(tests::FlushedHalf x, tests::FlushedHalf y) {
  return tests::FlushedHalf(std::pow(float(x), float(y)));
}
} // namespace parity::shading
