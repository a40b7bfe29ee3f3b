// The stretched GGX lobe of brushed surfaces (KHR_materials_anisotropy): distribution and two visibility terms.
//
// alphaT acts along the tangent T, alphaB along the bitangent B; T, B and N are orthonormal. XoY is the dot product of
// X and Y, in [-1, 1] for T and B. Where alphaT = alphaB each function is that of shading/brdf.glsl.
#ifndef PARITY_SHADING_ANISOTROPIC_BRDF
#define PARITY_SHADING_ANISOTROPIC_BRDF

#include "shading/real.glsl"

// alphaT of the surface's alpha, which stays alphaB:
//   alphaT = mix(alpha, 1, strength^2)
// KHR_materials_anisotropy, "Anisotropy". alpha and strength in [0, 1]. Exactly alpha at strength 0, exactly 1 at 1.
FN real anisotropicAlpha(real alpha, real strength) {
  PRECISE real s2 = strength * strength;
  PRECISE real alphaT = alpha * (R(1.0) - s2) + s2;
  return alphaT;
}

// Distribution of normals, per steradian:
//   D = 1 / (pi alphaT alphaB ((t.h)^2 / alphaT^2 + (b.h)^2 / alphaB^2 + (n.h)^2)^2)
// Burley 2012, appendix B; Heitz 2014, eq. 85. alphaB <= alphaT in [0, 1], NoH in [0, 1].
// Written as (g / d)^2 / pi with q = sqrt(alphaT / alphaB), g = alphaB q = sqrt(alphaT alphaB) and
//   d = (t.h / q)^2 + (b.h q)^2 + (g n.h)^2,
// the form of D_GGX: nothing cancels, and no alpha is squared but by g, so half has the digits that D_GGX has there.
// max(., kSmallest): alphas of 0 give 0 and no 0/0; D is bounded by 1 / (pi kSmallest), so half never overflows.
FN real D_GGXAnisotropic(real alphaT, real alphaB, real ToH, real BoH, real NoH) {
  PRECISE real q = sqrt(alphaT / max(alphaB, kSmallest));
  PRECISE real g = alphaB * q;
  PRECISE real t = ToH / max(q, kSmallest);
  PRECISE real b = BoH * q;
  PRECISE real n = g * NoH;
  PRECISE real d = t * t + b * b + n * n;
  PRECISE real k = g / max(d, kSmallest);
  PRECISE real D = k * k * kInvPi;
  return D;
}

// sqrt(alphaT^2 (t.v)^2 + alphaB^2 (b.v)^2 + (n.v)^2): how long a direction is once the lobe is shrunk to a mirror's
// hemisphere. Smith's Lambda is (this / n.v - 1) / 2: Heitz 2014, eq. 72 and 86.
FN real anisotropicLength(real alphaT, real alphaB, real ToV, real BoV, real NoV) {
  PRECISE real t = alphaT * ToV;
  PRECISE real b = alphaB * BoV;
  PRECISE real s = t * t + b * b + NoV * NoV;
  return sqrt(s);
}

// Visibility V = G2 / (4 NoL NoV) with the height-correlated Smith masking-shadowing of the stretched lobe:
//   V = 1/2 / (NoL length(V) + NoV length(L)),  length: anisotropicLength
// Heitz 2014, eq. 86 and 99. Alphas in [0, 1], NoV and NoL in [0, 1].
// max(., kSmallest): as in V_SmithGGXCorrelated. The example of KHR_materials_anisotropy clamps V to 1, which this does
// not: V is above 1 at grazing views of a smooth surface.
FN real V_SmithGGXAnisotropic(real alphaT, real alphaB, real ToV, real BoV, real NoV, real ToL, real BoL, real NoL) {
  PRECISE real lambdaV = NoL * anisotropicLength(alphaT, alphaB, ToV, BoV, NoV);
  PRECISE real lambdaL = NoV * anisotropicLength(alphaT, alphaB, ToL, BoL, NoL);
  PRECISE real sum = lambdaV + lambdaL;
  PRECISE real V = R(0.5) / max(sum, kSmallest);
  return V;
}

// The alpha that the lobe has as seen from V:
//   alpha = sqrt((alphaT^2 (t.v)^2 + alphaB^2 (b.v)^2) / ((t.v)^2 + (b.v)^2))
// Heitz 2014, eq. 86. Alphas in [0, 1]; the result lies between them.
// ToV and BoV are divided by the larger and the alphas likewise, so that no square underflows. At
// the normal, where the direction says nothing, both count alike.
FN real projectedAlpha(real alphaT, real alphaB, real ToV, real BoV) {
  PRECISE real most = max(max(ToV, -ToV), max(BoV, -BoV));
  PRECISE real t = R(1.0);
  PRECISE real b = R(1.0);
  if (most > R(0.0)) {
    t = ToV / most;
    b = BoV / most;
  }
  PRECISE real largest = max(max(alphaT, alphaB), kSmallest);
  PRECISE real x = alphaT / largest * t;
  PRECISE real y = alphaB / largest * b;
  PRECISE real share = (x * x + y * y) / (t * t + b * b);
  PRECISE real alpha = largest * sqrt(share);
  return alpha;
}

// V_SchlickSmith of a stretched lobe: k = projectedAlpha / 2 for each direction,
//   V = 1/4 / ((NoV (1 - kV) + kV) (NoL (1 - kL) + kL))
// Karis 2013, eq. 4, for Heitz's projected alphas: no source has this term for anisotropy. alphaV, alphaL: projected
// at V and L, in [0, 1]; NoV and NoL in [0, 1]. max(., kSmallest): as in V_SchlickSmith.
FN real V_SchlickSmithAnisotropic(real alphaV, real alphaL, real NoV, real NoL) {
  PRECISE real kV = alphaV * R(0.5);
  PRECISE real kL = alphaL * R(0.5);
  PRECISE real v = NoV * (R(1.0) - kV) + kV;
  PRECISE real l = NoL * (R(1.0) - kL) + kL;
  PRECISE real vl = v * l;
  PRECISE real V = R(0.25) / max(vl, kSmallest);
  return V;
}

#endif
