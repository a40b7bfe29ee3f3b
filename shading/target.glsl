// What a mobile shader does to its colour before a render target keeps it (docs/shading.md 7h).
#ifndef PARITY_SHADING_TARGET
#define PARITY_SHADING_TARGET

#include "shading/real.glsl"

// Gamma 2.0, for 8-bit targets without a transfer function of their own: sqrt(saturate(c)), one instruction where sRGB
// takes a power. Shown as sRGB it is darker above c = 0.0101, by up to 9.5 codes of 255 (at 0.213), and brighter below, by
// up to 4.9 codes (at 0.0015). Any c.
FN real3 encodeGamma2(real3 c) {
  real3 s = saturate(c);
  PRECISE real3 e = real3(sqrt(s.x), sqrt(s.y), sqrt(s.z));
  return e;
}

// A store that saturates: what exceeds the largest half, 65504, is that, so that a 16-bit target never holds infinity.
FN real3 saturateToHalf(real3 c) {
  return real3(min(max(c.x, R(-65504.0)), R(65504.0)), min(max(c.y, R(-65504.0)), R(65504.0)),
               min(max(c.z, R(-65504.0)), R(65504.0)));
}

#endif
