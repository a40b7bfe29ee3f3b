// The sheen of cloth (KHR_materials_sheen): distribution, two visibility terms, and the directional albedo of the lobe.
//
// The lobe is sheenColor D_Charlie V: it has no Fresnel term. alpha = sheenAlpha(sheenRoughness) throughout.
#ifndef PARITY_SHADING_SHEEN
#define PARITY_SHADING_SHEEN

#include "shading/real.glsl"

// The alpha of a perceptual roughness in [0, 1]: its square, of at least 0.07.
// KHR_materials_sheen, "Sheen distribution", squares it and leaves 0 open, where the lobe is 0/0. The floor is that of
// three.js and Filament; below it the lobe lies within 4 degrees of grazing half vectors. Result in [0.0049, 1].
FN real sheenAlpha(real sheenRoughness) {
  PRECISE real r = max(sheenRoughness, R(0.07));
  PRECISE real alpha = r * r;
  return alpha;
}

// Distribution of normals, per steradian: an inverted one, bright at grazing half vectors,
//   D = (2 + 1/alpha) sin(theta_h)^(1/alpha) / (2 pi)
// Estevez and Kulla 2017 ("Production Friendly Microfacet Sheen BRDF"). alpha in [0.0049, 1], NoH in [0, 1].
// sin^2 = (1 - NoH)(1 + NoH): 1 - NoH is exact for NoH >= 1/2. The result is at most 33.
FN real D_Charlie(real alpha, real NoH) {
  PRECISE real invAlpha = R(1.0) / alpha;
  PRECISE real sin2 = (R(1.0) - NoH) * (R(1.0) + NoH);
  PRECISE real D = (R(2.0) + invAlpha) * pow(sin2, R(0.5) * invAlpha) * (R(0.5) * kInvPi);
  return D;
}

// L(x) = a / (1 + b x^c) + d x + e, with the coefficients of alpha = 1 and 0 mixed by (1 - alpha)^2.
// Estevez and Kulla 2017, the fit of their shadowing term. alpha in [0, 1], x in [0, 1/2].
FN real charlieExponent(real alpha, real x) {
  PRECISE real s = R(1.0) - alpha;
  PRECISE real smoother = s * s;
  PRECISE real rougher = R(1.0) - smoother;
  PRECISE real a = R(21.5473) * rougher + R(25.3245) * smoother;
  PRECISE real b = R(3.82987) * rougher + R(3.32435) * smoother;
  PRECISE real c = R(0.19823) * rougher + R(0.16801) * smoother;
  PRECISE real d = R(-1.97760) * rougher + R(-1.27393) * smoother;
  PRECISE real e = R(-4.32054) * rougher + R(-4.85967) * smoother;
  PRECISE real p = pow(x, c);
  PRECISE real L = a / (R(1.0) + b * p) + d * x + e;
  return L;
}

// Smith's Lambda of D_Charlie, a fit:
//   exp(L(cosine)) below cosine 1/2, exp(2 L(1/2) - L(1 - cosine)) from there on
// Estevez and Kulla 2017. alpha, cosine in [0, 1].
// Within 0.04 of Smith's G1 from sheenRoughness 0.3 on; at 0.1 it lets twice as much through (docs/shading.md 10d).
// At most kLargest / 4, so that the sum of two is finite in half, where exp overflows below cosine 1e-5.
FN real charlieLambda(real alpha, real cosine) {
  PRECISE real L;
  if (cosine < R(0.5))
    L = charlieExponent(alpha, cosine);
  else
    L = R(2.0) * charlieExponent(alpha, R(0.5)) - charlieExponent(alpha, R(1.0) - cosine);
  PRECISE real scaled = L * R(1.44269504);
  return min(exp2(scaled), R(0.25) * kLargest);
}

// Visibility V = G2 / (4 NoL NoV) with height-correlated Smith masking-shadowing:
//   V = 1 / ((1 + Lambda(NoV) + Lambda(NoL)) 4 NoV NoL)
// Estevez and Kulla 2017, without their softened terminator, which KHR_materials_sheen leaves out. alpha in
// [0.0049, 1], NoV and NoL in [0, 1].
// max(., kSmallest): finite where a cosine is 0, so that V * NoL is 0 and not NaN.
FN real V_Charlie(real alpha, real NoV, real NoL) {
  PRECISE real sum = R(1.0) + charlieLambda(alpha, NoV) + charlieLambda(alpha, NoL);
  PRECISE real d = (NoV * sum) * (R(4.0) * NoL);
  PRECISE real V = R(1.0) / max(d, kSmallest);
  return V;
}

// Visibility for cloth without Lambda:
//   V = 1 / (4 (NoL + NoV - NoL NoV))
// Neubelt and Pettineo 2013 ("Crafting a Next-Gen Material Pipeline for The Order: 1886"). NoV and NoL
// in [0, 1]. max(., kSmallest): finite where both are 0.
FN real V_Neubelt(real NoV, real NoL) {
  PRECISE real both = NoL * NoV;
  PRECISE real d = NoL + NoV - both;
  PRECISE real V = R(0.25) / max(d, kSmallest);
  return V;
}

// Directional albedo of D_Charlie V_Charlie, clamped to 1: the share of light that a white sheen sends out. This
// project's own fit (study/fit/sheen_fit.h; 'parity fit' prints it): with r = max(sheenRoughness, 0.07), u = 1/r and N = NoV,
//   E = 2^(-2.0471 + 0.5047 u + 2.3955 r - 0.7013 r^2 + sqrt(N) (-0.1129 u^2 - 0.6 u - 0.8742 r)
//          + N (-1.0201 u + 0.2804 u^2) - 0.4386 N^2 u^2)
// Over NoV 0.02 to 1 and roughness 0.07 to 1 within 0.0425 of the integral, rms 0.0063; half adds 0.003
// (docs/shading.md 10e). sheenRoughness, NoV in [0, 1]; the result in [0, 1].
FN real sheenAlbedoFit(real sheenRoughness, real NoV) {
  PRECISE real r = max(sheenRoughness, R(0.07));
  PRECISE real u = R(1.0) / r;
  PRECISE real ofRoughness = R(-2.0471) + R(0.5047) * u + r * (R(2.3955) - R(0.7013) * r);
  PRECISE real ofRoot = sqrt(NoV) * (u * (R(-0.1129) * u - R(0.6)) - R(0.8742) * r);
  PRECISE real ofCosine = NoV * u * (R(-1.0201) + u * (R(0.2804) - R(0.4386) * NoV));
  PRECISE real exponent = ofRoughness + ofRoot + ofCosine;
  return saturate(exp2(exponent));
}

#endif
