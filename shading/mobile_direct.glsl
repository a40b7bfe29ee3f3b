// Direct specular light of the mobile path, as the sources print it, with the types they print (real32 stands where they
// say float inside half code). 1/pi is in the light's colour in all of them, and the caller multiplies by NoL.
//
// Reflectance over the height-correlated truth at F0 = 1 (docs/shading.md 3), N = .1 .25 .5 .75 1:
//   D_Approx     R=.1: .38 .95 1.89 2.84 3.78   R=.5: .57 .90 1.48 2.08 2.69   R=1: .31 .42 .63 .87 1.15
//   CalcSpecular R=.1: .011 .066 .26 .58 1.04   R=.5: .11 .18 .35 .58 .91      R=1: .30 .38 .50 .62 .73
// (CalcSpecular at R=.1 before the clamp at 2048, which leaves .70 of those.)
#ifndef PARITY_SHADING_MOBILE_DIRECT
#define PARITY_SHADING_MOBILE_DIRECT

#include "shading/real.glsl"

// pi times the lobe of the prefiltered environment around the reflection direction, GGX -> Blinn -> Phong -> spherical
// Gaussian; multiply by EnvBRDFApprox and NoL:
//   D = 2^(c RoL - c) / alpha^2,  c = 0.5/ln2 / alpha^2 + 0.275/ln2
// Karis 2014 ("Physically Based Shading on Mobile"). Roughness in (0, 1], RoL in [-1, 1]. Lacks the 1/4 of the microfacet
// denominator, so smooth lobes are about 4 N too bright (rms log ratio .78, range .15-4.4, exitance up to 3.89). No
// epsilon, because the article has none: in half it is inf for R <= .0625 at RoL = 1 and NaN for R <= .0574, where c is
// inf (docs/shading.md 4). RoL above 1 by a rounding makes 2^(c RoL - c) grow: inf up to roughness .13 in half, .006 in
// single.
FN real D_Approx(real Roughness, real RoL) {
  PRECISE real a = Roughness * Roughness;
  PRECISE real a2 = a * a;
  PRECISE real32 rcp_a2 = R32(1.0) / real32(a2);
  PRECISE real32 c32 = R32(0.72134752) * rcp_a2 + R32(0.39674113);
  PRECISE real c = real(c32);
  PRECISE real x = c * RoL - c;
  PRECISE real32 d = rcp_a2 * real32(exp2(x));
  return real(d);
}

// D_Approx as the engine ships it, with the types that it prints, all of them half:
//   a = max(Roughness^2, 0.008),  D = min(2^(c RoL - c) / a^2, 1 / a^2),  c = 0.5/ln2 / a^2 + 0.275/ln2
// PhongApprox of Unreal Engine 4's BRDF.ush (2015 to 2021), from memory of the published source: no article prints it.
// Roughness in [0, 1], RoL in [0, 1], where the engine's base pass cuts it off, and above by a rounding.
// 0.008: its square, 6.4e-5, is above 2^-14 = 6.1e-5, the smallest normal half, so that 1 / a^2 is at most 15625 and
// finite also where denormals are flushed; it acts for Roughness <= .0894, where the lobe stays as wide as there.
// min(., 1 / a^2): the peak is at RoL = 1; where RoL rounds to above 1, 2^(c RoL - c) grows without bound (the engine: "Avoid
// overflow/underflow on Mali GPUs"). From D_Approx it differs by the floor and the bound alone, so it lacks the same 1/4.
FN real PhongApprox(real Roughness, real RoL) {
  PRECISE real squared = Roughness * Roughness;
  PRECISE real a = max(squared, R(0.008));
  PRECISE real a2 = a * a;
  PRECISE real rcp_a2 = R(1.0) / a2;
  PRECISE real c = R(0.72134752) * rcp_a2 + R(0.39674113);
  PRECISE real x = c * RoL - c;
  PRECISE real p = rcp_a2 * exp2(x);
  return min(p, rcp_a2);
}

// pi D_GGX, clamped so that a bright environment does not overflow:
//   D = min((a / (1 - NoH^2 + (NoH a)^2))^2, 2048),  a = Roughness^2
// Walter et al. 2007, eq. 33, as UE4's MobileGGX.ush (2020) writes it. Roughness in [0.015625, 1], NoH in [0, 1] and in
// fp32: 1 - NoH^2 in half is more than 10 % wrong on 94 % of the lobe at R = .1. The clamp acts for R <= .149 and leaves
// 70 % of the energy at R = .1, 21 % at R = .05. Roughness 0 at NoH = 1 is 0/0: the caller's floor of 0.015625
// (0.015625^4 = 2^-24, the smallest half denormal) is part of the formula.
FN real GGX_Mobile(real Roughness, real32 NoH) {
  PRECISE real32 OneMinusNoHSqr = R32(1.0) - NoH * NoH;
  PRECISE real a = Roughness * Roughness;
  PRECISE real n = real(NoH * real32(a));
  PRECISE real nn = n * n;
  PRECISE real32 p32 = real32(a) / (OneMinusNoHSqr + real32(nn));
  PRECISE real p = real(p32);
  PRECISE real d = p * p;
  return min(d, R(2048.0));
}

// The whole specular of UE4's mobile lights but for SpecularColor and NoL: Fresnel and visibility are 1/4 + R/4.
//   (R/4 + 1/4) GGX_Mobile
// MobileShadingModels.ush (2020). Ranges as GGX_Mobile. Goes like N^2 where smooth: grazing views lose 90-99 % (rms log
// ratio 1.67, range .009-1.17).
FN real CalcSpecular(real Roughness, real32 NoH) {
  PRECISE real v = Roughness * R(0.25) + R(0.25);
  PRECISE real s = v * GGX_Mobile(Roughness, NoH);
  return s;
}

#endif
