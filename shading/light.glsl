// How point and spot lights fade: with distance, at the edge of their range, outside their cone.
//
// Distances and what is divided by their squares stay in real32 whatever the working precision: the square is infinite in
// half from 256 m on (docs/shading.md 4), its reciprocal a denormal.
#ifndef PARITY_SHADING_LIGHT
#define PARITY_SHADING_LIGHT

#include "shading/real.glsl"

// The nearest that a light can come: (1 cm)^2. Keeps 1/d^2 finite at the light.
CONSTANT real32 kMinDistanceSquared = R32(1e-4);

// Attenuation of a point light, 1/m^2:
//   max(min(1 - (d / range)^4, 1), 0) / d^2
// KHR_lights_punctual, "Range Property". d2 = d^2 in m^2, finite and >= 0, clamped at kMinDistanceSquared in the denominator; range
// in m, 0 or infinite: no window (the extension's "undefined" range).
FN real32 squareFalloff(real32 d2, real32 range) {
  real32 window = R32(1.0);
  if (range > R32(0.0)) {
    PRECISE real32 q = d2 / range / range;
    PRECISE real32 w = R32(1.0) - q * q;
    window = max(min(w, R32(1.0)), R32(0.0));
  }
  PRECISE real32 attenuation = window / max(d2, kMinDistanceSquared);
  return attenuation;
}

// Attenuation of a point light as Unreal Engine 4 has it, 1/m^2:
//   saturate(1 - (d / range)^4)^2 / (d^2 + 1 cm^2)
// Karis 2013, eq. 9, whose 1 is in cm^2: 1e-4 m^2. d2 in m^2, finite and >= 0; range in m, 0 or infinite: no window.
// From squareFalloff: the window is squared, and the light itself is softened instead of clamped (50 % less at 1 cm).
FN real32 squareFalloffUE4(real32 d2, real32 range) {
  real32 window = R32(1.0);
  if (range > R32(0.0)) {
    PRECISE real32 q = d2 / range / range;
    PRECISE real32 w = R32(1.0) - q * q;
    window = max(min(w, R32(1.0)), R32(0.0));
  }
  PRECISE real32 attenuation = window * window / (d2 + R32(1e-4));
  return attenuation;
}

// Attenuation of a light that has a falloff exponent, in [0, 1]: no inverse square, so its colour is the illuminance at the
// light (lux), not candela.
//   (1 - saturate((d / range)^2))^exponent
// Unreal Engine 4's RadialAttenuation (DynamicLightingCommon.ush), which AccumulateLightingOfDynamicPointLight takes where
// LightColorAndFalloffExponent.w is not 0. d2 in m^2, finite and >= 0; range in m, above 0 and finite; exponent above 0.
// The base is cut off at 0 before pow, which is not defined below it; 0 at 0 in words, as pow(0, e) is exp2(-inf) on some
// devices.
FN real32 exponentFalloff(real32 d2, real32 range, real32 exponent) {
  PRECISE real32 base = R32(1.0) - d2 / range / range;
  if (base > R32(0.0)) {
    PRECISE real32 attenuation = pow(base, exponent);
    return attenuation;
  }
  return R32(0.0);
}

// How a point or spot light fades with distance.
CONSTANT int kFalloffKhr = 0;      // squareFalloff
CONSTANT int kFalloffUE4 = 1;      // squareFalloffUE4
CONSTANT int kFalloffExponent = 2; // exponentFalloff, which alone reads the exponent

// By one of these: every path's lights.
FN real32 distanceFalloff(int falloff, real32 d2, real32 range, real32 exponent) {
  if (falloff == kFalloffExponent) return exponentFalloff(d2, range, exponent);
  if (falloff == kFalloffUE4) return squareFalloffUE4(d2, range);
  return squareFalloff(d2, range);
}

// Attenuation of a spot light across its cone, in [0, 1]:
//   saturate(cosAngle scale + offset)^2,  scale = 1 / max(0.001, cosInner - cosOuter),  offset = -cosOuter scale
// KHR_lights_punctual, "Inner and Outer Cone Angles". cosAngle: between the cone's axis and the way from the light to the
// point; all cosines in [-1, 1], cosInner >= cosOuter. 0.001 is the extension's guard for inner = outer. Evaluated as
// (cosAngle - cosOuter) scale, the same number without the cancellation (in half, cosAngle * 1000 has steps of 0.5).
FN real spotAttenuation(real cosAngle, real cosInner, real cosOuter) {
  PRECISE real x = (cosAngle - cosOuter) / max(R(0.001), cosInner - cosOuter);
  PRECISE real s = saturate(x);
  PRECISE real attenuation = s * s;
  return attenuation;
}

// min(65000, contribution): UE4's mobile base pass (2020) clamps what each local light adds, so that one light alone
// cannot make a half target infinite. 65000 rounds to 64992 in half, and two such lights still add up to inf.
FN real3 clampContribution65000(real3 contribution) {
  return real3(min(contribution.x, R(65000.0)), min(contribution.y, R(65000.0)), min(contribution.z, R(65000.0)));
}

#endif
