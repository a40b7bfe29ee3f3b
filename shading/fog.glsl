// Exponential height fog: how much light comes through it along a straight way.
//
// Heights and distances stay in real32 whatever the working precision, as in shading/light.glsl.
#ifndef PARITY_SHADING_FOG
#define PARITY_SHADING_FOG

#include "shading/real.glsl"

// Extinction at height y, per metre: density 2^(-heightFalloff (y - height)). A falloff of 0 is plain distance fog.
struct HeightFog {
  real32 density;       // 1/m, >= 0: the extinction at `height`
  real32 heightFalloff; // 1/m, >= 0: it halves with every 1/heightFalloff metres upwards
  real32 height;        // m
  real32 startDistance; // m, >= 0: there is no fog nearer than this
  real32 maxOpacity;    // in [0, 1]: 1 - the least transmittance
};

// (1 - 2^-F) / (F ln 2), the mean of 2^-(F s) over s in [0, 1]; F in [0, 1e30]. Near 0, where 1 - 2^-F cancels, Taylor's
//   1 - x/2 + x^2/6,  x = F ln 2
// Below F = 0.05 what it leaves out (x^3/24) is 1.7e-6, as much as fp32 loses of the quotient there.
FN real32 meanOfFalloff(real32 F) {
  PRECISE real32 x = F * R32(0.693147180559945309);
  PRECISE real32 taylor = R32(1.0) - x * (R32(0.5) - x * R32(0.166666666666666667));
  PRECISE real32 quotient = (R32(1.0) - exp2(-F)) / max(x, R32(1e-3));
  return F < R32(0.05) ? taylor : quotient;
}

// Transmittance, in [1 - maxOpacity, 1], of the way that begins at height eyeHeight, is `distance` long and rises by `rise`
// (negative: falls); metres, distance >= |rise|:
//   T = max(e^-tau, 1 - maxOpacity),  tau = integral of the extinction over the way from startDistance on
//     = density 2^(-heightFalloff (min(y0, y1) - height)) (1 - 2^-F) / (F ln 2) (distance - startDistance)
//   y0, y1: the heights of its ends,  F = heightFalloff |y1 - y0|
// Unreal Engine 4, HeightFogCommon.ush (CalculateLineIntegralShared, GetExponentialHeightFog), 4.20 to 4.26. From it: the
// integral begins at the lower end, so that F >= 0 and 2^-F cannot overflow; and the density is in 1/m: UE4 leaves out the
// 1/(ln 2) of the integral and takes 2^-x for e^-x, so that its density d, per unit of length, is an extinction of ln(2)^2 d.
// Any finite inputs give a finite result: exponents end at +-126, where a density is nothing or a wall.
FN real heightFogTransmittance(HeightFog fog, real32 eyeHeight, real32 rise, real32 distance) {
  if (fog.density <= R32(0.0) || distance <= fog.startDistance) return R(1.0);
  PRECISE real32 without = fog.startDistance / distance; // the share of the way without fog
  PRECISE real32 y0 = eyeHeight + without * rise - fog.height;
  PRECISE real32 y1 = eyeHeight + rise - fog.height;
  PRECISE real32 lowest = min(max(min(y0, y1), R32(-1e30)), R32(1e30)); // 0 times infinity is NaN
  PRECISE real32 exponent = min(max(-fog.heightFalloff * lowest, R32(-126.0)), R32(126.0));
  PRECISE real32 inFog = rise * (R32(1.0) - without);
  PRECISE real32 F = min(fog.heightFalloff * abs(inFog), R32(1e30));
  PRECISE real32 length = distance - fog.startDistance;
  PRECISE real32 tau = fog.density * exp2(exponent) * meanOfFalloff(F) * length;
  PRECISE real32 transmittance = exp2(-min(tau * R32(1.44269504088896341), R32(126.0)));
  PRECISE real32 least = R32(1.0) - fog.maxOpacity;
  return real(min(max(transmittance, least), R32(1.0)));
}

#endif
