// Lamps of an environment, evaluated as lights beside its prefiltered levels (lighting/environment/lamp_tree.h).
//
// The levels hold round lobes; that of GGX is round for N = V alone. What a light of the environment gives is known
// both ways: filtered by the lobes that were read, and by the true one. Their difference is added, so that the levels
// are a control variate, and what is left of their error is that of the dim, smooth rest.
#ifndef PARITY_SHADING_LAMPS
#define PARITY_SHADING_LAMPS

#include "shading/real.glsl"

// integral cos / t^2 over the hemisphere, with t = u + a2 (1 - u), u = (1 - cos) / 2 and a2 = alpha^2: D of GGX for
// N = V is alpha^2 / (pi t^2). With b = 1 - a2 and v = (1 + a2) / 2, the value of t at the horizon,
//   4 pi / b ((1 + 2 a2 / b) (1 / a2 - 1 / v) - 2 / b ln(v / a2)),
// and for small b, where that cancels, its power series: pi (1 + 5/3 b + 17/8 b^2 + 49/20 b^3). a2 in (0, 1].
// Within 2e-4.
FN real32 prefilteredLobeIntegral(real32 a2) {
  PRECISE real32 b = R32(1.0) - a2;
  if (b < R32(0.08)) {
    PRECISE real32 series = R32(1.0) + b * (R32(1.6666667) + b * (R32(2.125) + b * R32(2.45)));
    return series * R32(3.14159265);
  }
  PRECISE real32 v = (R32(1.0) + a2) * R32(0.5);
  PRECISE real32 rational = (R32(1.0) + R32(2.0) * a2 / b) * (R32(1.0) / a2 - R32(1.0) / v);
  PRECISE real32 integral = R32(12.5663706) / b * (rational - R32(2.0) / b * log(v / a2));
  return integral;
}

// Mean of 1 / t^2 over a light, in its value at the light's middle: with its mean square distance `spread`, to second
// order in the plane, 1 + x with x = spread (t - 3/2 a2) / t^2. Where the light is no longer small for the lobe x is below 0,
// down to -spread / (2 a2) at its middle; 1 / (1 - x) is the same to that order, and what a disc gives there exactly.
FN real32 meanOverSpread(real32 a2, real32 t, real32 spread) {
  PRECISE real32 x = spread * (t - R32(1.5) * a2) / (t * t);
  if (x < R32(0.0)) return R32(1.0) / (R32(1.0) - x);
  return R32(1.0) + x;
}

// The lobe of a prefiltered level, per steradian: cos / t^2 over its integral (prefilteredLobeIntegral). u = (1 - cos)
// / 2, a quarter of the squared chord between the level's direction and the light's. spread: the light's mean square distance from its
// direction, over which the lobe's mean is taken.
FN real32 prefilteredLobe(real32 a2, real32 integral, real32 u, real32 spread) {
  PRECISE real32 cosine = R32(1.0) - R32(2.0) * u;
  if (cosine <= R32(0.0)) return R32(0.0);
  PRECISE real32 t = u + a2 * (R32(1.0) - u);
  PRECISE real32 lobe = cosine / (t * t) * meanOverSpread(a2, t, spread) / integral;
  return lobe;
}

// The squared angle by which a light may move before GGX changes noticeably. Half vectors turn by 1 / (2 VoH) at most
// of what the light does, and D by the scale of 1 - NoH^2 + alpha^2. Compared with the light's spread.
FN real32 lobeScale(real32 a2, real32 NoH2, real32 VoH2) {
  PRECISE real32 scale = R32(4.0) * VoH2 * (max(R32(1.0) - NoH2, R32(0.0)) + a2);
  return scale;
}

// The same of GGX's D, which is alpha^2 / (pi t^2) with t = 1 - NoH^2 (1 - alpha^2): half vectors turn by half of what
// the light does in the plane of incidence, and by 1 / (2 VoH) of it across.
FN real32 meanOfGgx(real32 a2, real32 NoH2, real32 VoH2, real32 spread) {
  PRECISE real32 t = R32(1.0) - NoH2 * (R32(1.0) - a2);
  PRECISE real32 turned = spread * (R32(0.5) + R32(0.5) / VoH2);
  return meanOverSpread(a2, max(t, a2), turned);
}

// Share of a node's difference that counts: next to 1 where the lobe is wide for it, 0 where it is a point for the lobe
// and would be seen as one; there the levels alone are read.
FN real32 lampShare(real32 scale, real32 spread) {
  PRECISE real32 limit = R32(4.0) * spread;
  PRECISE real32 share = scale * scale / (scale * scale + limit * limit);
  return share;
}

#endif
