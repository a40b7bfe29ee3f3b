// Four floats that the compiler keeps in one register, as it does not with glm's vectors.
#pragma once

#include <cmath>

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace parity::lighting {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

// Correctly rounded, as std::sqrt is.
inline Float4 squareRoot(const Float4& v) {
#ifdef __SSE__
  return _mm_sqrt_ps(v);
#else
  return Float4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}
inline Float4 smaller(const Float4& a, const Float4& b) { return a < b ? a : b; }
inline Float4 larger(const Float4& a, const Float4& b) { return a > b ? a : b; }

} // namespace parity::lighting
