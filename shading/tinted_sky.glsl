// The sky light of the mobile preset refit: irradiance by SH up to the second band, which has one tint for all channels: 38
// operations in place of the 58 of nine coefficients a channel, for nearly the same irradiance (docs/refit.md).
#ifndef PARITY_SHADING_TINTED_SKY
#define PARITY_SHADING_TINTED_SKY

#include "shading/real.glsl"

// E(n)/pi = c0 + c1 x + c2 y + c3 z + tint q(n),  q = x (q0 x + q1 y + q2 z) + y (q3 y + q4 z): the part of z^2 is in the
// constant, as n is a unit vector. Uniforms, as SkySh: at least fp32 in every precision. Made by
// lighting/environment/tinted_irradiance.h.
struct TintedSky {
  real32x3 c[4];
  real32x3 tint;
  real32 q[5];
};

FN real32 tintedSkyChannel(real32 c0, real32 cx, real32 cy, real32 cz, real32 tint, real32x3 n, real32 q) {
  PRECISE real32 e = c0 + cx * n.x + cy * n.y + cz * n.z + tint * q;
  return max(e, R32(0.0));
}

// E(n)/pi, the radiance of a white Lambertian. N: unit length; not negative.
FN real3 tintedSkyDiffuse(TintedSky sky, real3 N) {
  real32x3 n = widen(N);
  PRECISE real32 q = n.x * (sky.q[0] * n.x + sky.q[1] * n.y + sky.q[2] * n.z) + n.y * (sky.q[3] * n.y + sky.q[4] * n.z);
  return narrow(real32x3(tintedSkyChannel(sky.c[0].x, sky.c[1].x, sky.c[2].x, sky.c[3].x, sky.tint.x, n, q),
                         tintedSkyChannel(sky.c[0].y, sky.c[1].y, sky.c[2].y, sky.c[3].y, sky.tint.y, n, q),
                         tintedSkyChannel(sky.c[0].z, sky.c[1].z, sky.c[2].z, sky.c[3].z, sky.tint.z, n, q)));
}

#endif
