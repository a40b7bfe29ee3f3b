// The microfacet reflection model of the high-end path and the reference: distribution, two visibility terms, Fresnel,
// Lambert, energy compensation. alpha = roughness^2 throughout.
#ifndef PARITY_SHADING_BRDF
#define PARITY_SHADING_BRDF

#include "shading/real.glsl"

// Distribution of normals, per steradian:
//   D = alpha^2 / (pi ((n.h)^2 (alpha^2 - 1) + 1)^2)
// Trowbridge and Reitz 1975; Walter et al. 2007, eq. 33. alpha in [0, 1], NoH in [0, 1].
// Written as (alpha / d)^2 / pi with d = (1 - NoH)(1 + NoH) + (alpha NoH)^2: 1 - NoH is exact for NoH >= 1/2, where
// 1 - NoH^2 loses every digit near the peak. max(d, kSmallest): alpha = 0 at NoH = 1 gives 0 instead of 0/0; it also
// bounds D by 1/(pi kSmallest), so half never overflows, at the price of a low peak below roughness 0.088 (there
// alpha^2 is a half denormal, SHADING 4).
FN real D_GGX(real alpha, real NoH) {
  PRECISE real n = alpha * NoH;
  PRECISE real d = (R(1.0) - NoH) * (R(1.0) + NoH) + n * n;
  PRECISE real k = alpha / max(d, kSmallest);
  PRECISE real D = k * k * kInvPi;
  return D;
}

// Visibility V = G2 / (4 NoL NoV) with the height-correlated Smith masking-shadowing of GGX:
//   V = 1/2 / (NoL sqrt(NoV^2 (1 - alpha^2) + alpha^2) + NoV sqrt(NoL^2 (1 - alpha^2) + alpha^2))
// Heitz 2014, eq. 72 and 99. alpha in [0, 1], NoV and NoL in [0, 1].
// max(., kSmallest): finite where both cosines, or alpha and one cosine, are 0, so that V * NoL is 0 and not NaN.
FN real V_SmithGGXCorrelated(real alpha, real NoV, real NoL) {
  PRECISE real a2 = alpha * alpha;
  PRECISE real sv = (NoV - a2 * NoV) * NoV + a2;
  PRECISE real sl = (NoL - a2 * NoL) * NoL + a2;
  PRECISE real lambdaV = NoL * sqrt(sv);
  PRECISE real lambdaL = NoV * sqrt(sl);
  PRECISE real sum = lambdaV + lambdaL;
  PRECISE real V = R(0.5) / max(sum, kSmallest);
  return V;
}

// Visibility V = G / (4 NoL NoV) with the Schlick-Smith geometry term of Karis 2013 ("Real Shading in Unreal Engine 4",
// eq. 4), k = alpha / 2 for lights as for images, without the "hotness" remap (Karis 2014 removed it):
//   G1(x) = x / (x (1 - k) + k),  G = G1(NoL) G1(NoV)
// alpha in [0, 1], NoV and NoL in [0, 1]. The cosines cancel; max(., kSmallest) keeps alpha = 0 at a cosine of 0 finite.
// From V_SmithGGXCorrelated the preintegrated A and B differ by up to 0.34 and 0.25 (SHADING 1).
FN real V_SchlickSmith(real alpha, real NoV, real NoL) {
  PRECISE real k = alpha * R(0.5);
  PRECISE real v = NoV * (R(1.0) - k) + k;
  PRECISE real l = NoL * (R(1.0) - k) + k;
  PRECISE real vl = v * l;
  PRECISE real V = R(0.25) / max(vl, kSmallest);
  return V;
}

// Fresnel reflectance, F90 = 1:
//   F = F0 + (1 - F0) (1 - VoH)^5
// Schlick 1994, eq. 15. F0 in [0, 1], VoH in [0, 1]. Written F0 (1 - f) + f: exactly 1 at VoH = 0 and F0 at VoH = 1.
FN real3 F_Schlick(real3 F0, real VoH) {
  PRECISE real x = R(1.0) - VoH;
  PRECISE real x2 = x * x;
  PRECISE real f = x2 * x2 * x;
  PRECISE real g = R(1.0) - f;
  PRECISE real3 F = real3(F0.x * g + f, F0.y * g + f, F0.z * g + f);
  return F;
}

// Diffuse reflection per unit of albedo, 1 / pi per steradian (Lambert 1760).
FN real Fd_Lambert() { return kInvPi; }

// Factor on single-scattering specular that returns the light lost between microfacets:
//   1 + F0 (1/Ess - 1),  Ess = A + B = directional albedo at F0 = 1
// Turquin 2019, eq. 16. F0 in [0, 1], dfg = (A, B) of the environment BRDF, A + B in (0, 1]. At F0 = 1 the white furnace
// comes back to 1 exactly. max(., kSmallest): a table that holds 0 gives a finite factor.
FN real3 energyCompensation(real3 F0, real2 dfg) {
  PRECISE real Ess = dfg.x + dfg.y;
  PRECISE real m = R(1.0) / max(Ess, kSmallest) - R(1.0);
  PRECISE real3 factor = real3(R(1.0) + F0.x * m, R(1.0) + F0.y * m, R(1.0) + F0.z * m);
  return factor;
}

#endif
