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
// alpha^2 is a half denormal, docs/shading.md 4).
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
// From V_SmithGGXCorrelated the preintegrated A and B differ by up to 0.34 and 0.25 (docs/shading.md 1).
FN real V_SchlickSmith(real alpha, real NoV, real NoL) {
  PRECISE real k = alpha * R(0.5);
  PRECISE real v = NoV * (R(1.0) - k) + k;
  PRECISE real l = NoL * (R(1.0) - k) + k;
  PRECISE real vl = v * l;
  PRECISE real V = R(0.25) / max(vl, kSmallest);
  return V;
}

// Fresnel's reflectance runs from F0 to F90: F = F0 (1 - f) + F90 f. The weight f of VoH in [0, 1] by three curves.

// f = (1 - VoH)^5. Schlick 1994, eq. 15.
FN real schlickWeight(real VoH) {
  PRECISE real x = R(1.0) - VoH;
  PRECISE real x2 = x * x;
  PRECISE real f = x2 * x2 * x;
  return f;
}

// f = 2^((-5.55473 VoH - 6.98316) VoH). Karis 2013, eq. 5: Schlick's power by a spherical Gaussian, within 0.004.
FN real sphericalGaussianWeight(real VoH) {
  PRECISE real e = (R(-5.55473) * VoH - R(6.98316)) * VoH;
  return exp2(e);
}

// The unpolarised reflectance of a dielectric of index 1.5, scaled to run from 0 to 1:
//   F = ((g - c) / (g + c))^2 (1 + ((c (g + c) - 1) / (c (g - c) + 1))^2) / 2,  c = VoH, g^2 = 1.5^2 - 1 + c^2
//   f = (F - 0.04) / 0.96
// Cook and Torrance 1982, appendix. Exact at F0 = 0.04; Schlick's curve is within 0.04 of it.
FN real dielectricWeight(real VoH) {
  PRECISE real g = sqrt(R(1.25) + VoH * VoH);
  PRECISE real p = g + VoH;
  PRECISE real m = g - VoH;
  PRECISE real r = m / p;
  PRECISE real q = (VoH * p - R(1.0)) / (VoH * m + R(1.0));
  PRECISE real F = R(0.5) * r * r * (R(1.0) + q * q);
  PRECISE real f = (F - R(0.04)) / R(0.96);
  return max(f, R(0.0));
}

// Their cosine-weighted means, 2 integral f mu dmu: with mixFresnel the mean reflectance Favg.
FN real schlickMean() { return R(0.0476190476); }
FN real sphericalGaussianMean() { return R(0.0488637076); }
FN real dielectricMean() { return R(0.0539353743); }

// F0 + (F90 - F0) f, exactly F0 at f = 0 and F90 at f = 1. Each in [0, 1].
FN real3 mixFresnel(real3 F0, real F90, real f) {
  PRECISE real g = R(1.0) - f;
  PRECISE real h = F90 * f;
  PRECISE real3 F = real3(F0.x * g + h, F0.y * g + h, F0.z * g + h);
  return F;
}

// Fresnel reflectance by Schlick's curve, F90 = 1. F0 in [0, 1], VoH in [0, 1].
FN real3 F_Schlick(real3 F0, real VoH) { return mixFresnel(F0, R(1.0), schlickWeight(VoH)); }

// Diffuse reflection per unit of albedo, 1 / pi per steradian (Lambert 1760).
FN real Fd_Lambert() { return kInvPi; }

// What the diffuse lobe gets of the light: what the specular one does not send out,
//   1 - E,  E = directional albedo of the specular lobe at NoV
// The albedo scaling of layered models (Portsmouth, Kutz and Hill 2024, "OpenPBR Surface", section "Albedo scaling"): a
// white dielectric reflects no more than it receives. E may exceed 1 by rounding.
FN real3 albedoScaling(real3 E) {
  PRECISE real3 rest = real3(R(1.0) - E.x, R(1.0) - E.y, R(1.0) - E.z);
  return real3(saturate(rest.x), saturate(rest.y), saturate(rest.z));
}

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

// Directional albedo of what scatters more than once, as Fdez-Aguera 2019 ("A Multiple-Scattering Microfacet Model for
// Real-Time Image-based Lighting", section 3) has it:
//   Fms Ems,  Fms = FssEss Favg / (1 - Favg Ems),  FssEss = F0 A + F90 B,  Ems = 1 - (A + B)
// spread as by a Lambertian surface. dfg = (A, B), A + B in (0, 1]; Favg: cosine-weighted mean of Fresnel's reflectance.
// The divisor is written 1 - Favg + Favg (A + B), which does not cancel: else 0 for Favg = 1 and a small A + B. At F0 = 1
// what single scattering loses. From Kulla and Conty's (kullaContyAlbedo) it differs where A + B is far from its average.
FN real3 fdezAgueraAlbedo(real3 F0, real F90, real3 Favg, real2 dfg) {
  PRECISE real Ess = dfg.x + dfg.y;
  PRECISE real Ems = max(R(1.0) - Ess, R(0.0));
  PRECISE real h = F90 * dfg.y;
  PRECISE real3 Fss = real3(F0.x * dfg.x + h, F0.y * dfg.x + h, F0.z * dfg.x + h);
  PRECISE real3 E = real3(Fss.x * Favg.x * Ems / (R(1.0) - Favg.x + Favg.x * Ess), Fss.y * Favg.y * Ems / (R(1.0) - Favg.y + Favg.y * Ess),
                          Fss.z * Favg.z * Ems / (R(1.0) - Favg.z + Favg.z * Ess));
  return E;
}

// The same after Kulla and Conty 2017 ("Revisiting Physically Based Shading at Imageworks"), the bounces summed as Hill
// 2018 does ("A Multi-Faceted Exploration", part 3):
//   Favg^2 Eavg / (1 - Favg (1 - Eavg)) (1 - E),  E = A + B at NoV, Eavg = its cosine-weighted mean
// spread over light directions as (1 - E(NoL)) NoL / (pi (1 - Eavg)): see kullaContyLobe. E, Eavg in (0, 1]. The divisor as
// in fdezAgueraAlbedo.
FN real3 kullaContyAlbedo(real3 Favg, real E, real Eavg) {
  PRECISE real lost = max(R(1.0) - E, R(0.0));
  PRECISE real k = Eavg * lost;
  PRECISE real3 albedo = real3(Favg.x * Favg.x * k / (R(1.0) - Favg.x + Favg.x * Eavg),
                               Favg.y * Favg.y * k / (R(1.0) - Favg.y + Favg.y * Eavg),
                               Favg.z * Favg.z * k / (R(1.0) - Favg.z + Favg.z * Eavg));
  return albedo;
}

// How Kulla and Conty's light spreads, per steradian and without the cosine: (1 - E(NoL)) / (pi (1 - Eavg)). max(.,
// 2^-14): below roughness 0.055 the average of a table in single precision is 1 by rounding while E at grazing is not;
// what is lost there is under 1e-4 of the light.
FN real kullaContyLobe(real EofNoL, real Eavg) {
  PRECISE real lobe = max(R(1.0) - EofNoL, R(0.0)) / max(R(1.0) - Eavg, R(6.103515625e-5)) * kInvPi;
  return lobe;
}

#endif
