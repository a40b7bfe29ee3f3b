// The mobile preset `refit`: as cheap as Unreal Engine 4's mobile formulas, and close to this program's own high-end path
// as it is by default: GGX, height-correlated Smith, Schlick's Fresnel, what scatters more than once after Kulla and
// Conty, balanced diffuse light, off-specular reads of the environment.
//
// All constants are printed by build/fit_refit (study/fit), which says what is fitted to what; docs/refit.md has the errors
// of every form. Everything is finite and not negative for roughness, F0 <= F90 and cosines in [0, 1], in f64, f32 and half
// with or without denormals.
#ifndef PARITY_SHADING_REFIT
#define PARITY_SHADING_REFIT

#include "shading/real.glsl"

// The high-end path's floor for lights, 1/64, as alpha: half holds it as a normal number.
CONSTANT real kRefitLeastAlpha = R(2.44140625e-4);
// Where a peak is cut off: in half it would be infinite otherwise. 0.9: F may round to above 1.
CONSTANT real32 kRefitMost = real32(kLargest) * R32(0.9);

// The specular lobe at one view: what does not depend on the light.
struct RefitLobe {
  real3 single;   // directional albedo of light scattered once: F0 A + F90 B; the factor of what refitTap says
  real3 multiple; // of what scatters more than once: the factor of the irradiance over pi
  real3 F0;
  real3 rise; // F90 - F0
  real alpha;
  real NoV;
  real rootV; // refitRoot of NoV
};

// alpha = max(Roughness^2, 2^-12). The lobe and the read share it.
FN real refitAlpha(real Roughness) {
  PRECISE real alpha = Roughness * Roughness;
  return max(alpha, kRefitLeastAlpha);
}

// B of the environment BRDF, the part of F90:
//   B = 2^(R (b0 + R (b1 + b2 R)) + N (b3 + R (b4 + b5 R) + b6 N))
// and w = 1 - A - B, what is lost between microfacets at F = 1, with t = N / alpha:
//   w = N / (w0 + t (w1 + w2 t))
// Both in [0, 1].
FN real refitB(real Roughness, real NoV) {
  PRECISE real r = Roughness * (R(-1.6362) + Roughness * (R(-10.4728) + R(7.36178) * Roughness));
  PRECISE real n = R(-6.30003) + Roughness * (R(14.0948) + R(-10.3549) * Roughness) + R(-8.5954) * NoV;
  PRECISE real e = r + n * NoV;
  return exp2(e);
}

// In half t^2 of a smooth surface is infinite, and w then 0. alpha in [kRefitLeastAlpha, 1].
FN real refitLoss(real alpha, real NoV) {
  PRECISE real t = NoV / alpha;
  PRECISE real w = NoV / (R(0.500909) + t * (R(0.651395) + R(0.413968) * t));
  return w;
}

// sqrt(alpha^2 + (1 - alpha^2) cosine^2), of Smith's term.
FN real refitRoot(real alpha, real cosine) {
  PRECISE real a2 = alpha * alpha;
  PRECISE real s = (cosine - a2 * cosine) * cosine + a2;
  return sqrt(s);
}

// The lobe of a material at a view. F0 <= F90 in [0, 1] (F90 is 1 but for KHR_materials_specular); Roughness, NoV in [0,
// 1]. With single scattering S = F0 (1 - w) + (F90 - F0) B and Kulla and Conty's sum replaced by
//   M = w F0^2 (1 - k (F90 - F0)),  k = c alpha
// S + M is 1 at F0 = 1 for every view, as it must be. Written as polynomials of F0, whose coefficients are the same for
// every channel; S is not negative, as F0 (1 - w - B) is never below -F90 B, rounded or not.
FN RefitLobe refitLobe(real3 F0, real F90, real Roughness, real NoV) {
  RefitLobe lobe;
  real alpha = refitAlpha(Roughness);
  real B = refitB(Roughness, NoV);
  real w = refitLoss(alpha, NoV);
  PRECISE real k = R(0.726701) * alpha;
  PRECISE real s1 = R(1.0) - w - B;
  PRECISE real s0 = F90 * B;
  PRECISE real m2 = w * (R(1.0) - k * F90);
  PRECISE real m3 = w * k;
  PRECISE real3 single = real3(F0.x * s1 + s0, F0.y * s1 + s0, F0.z * s1 + s0);
  PRECISE real3 multiple = real3(F0.x * F0.x * (m3 * F0.x + m2), F0.y * F0.y * (m3 * F0.y + m2), F0.z * F0.z * (m3 * F0.z + m2));
  PRECISE real3 rise = real3(F90 - F0.x, F90 - F0.y, F90 - F0.z);
  lobe.single = single;
  lobe.multiple = multiple;
  lobe.F0 = F0;
  lobe.rise = rise;
  lobe.alpha = alpha;
  lobe.NoV = NoV;
  lobe.rootV = refitRoot(alpha, NoV);
  return lobe;
}

// The same where F0 is known to be .04 and grey and F90 1, bit for bit, but that `multiple`, which is below .0011, is 0.
FN RefitLobe refitNonmetalLobe(real Roughness, real NoV) {
  RefitLobe lobe;
  real alpha = refitAlpha(Roughness);
  PRECISE real rise = R(1.0) - R(0.04);
  real B = refitB(Roughness, NoV);
  PRECISE real s1 = R(1.0) - refitLoss(alpha, NoV) - B;
  PRECISE real E = R(0.04) * s1 + B;
  lobe.single = real3(E, E, E);
  lobe.multiple = real3(R(0.0), R(0.0), R(0.0));
  lobe.F0 = real3(R(0.04), R(0.04), R(0.04));
  lobe.rise = real3(rise, rise, rise);
  lobe.alpha = alpha;
  lobe.NoV = NoV;
  lobe.rootV = refitRoot(alpha, NoV);
  return lobe;
}

// What the diffuse lobe gets of a channel's light, 1 - (S + M).
FN real refitDiffuseShare(real single, real multiple) {
  PRECISE real rest = R(1.0) - (single + multiple);
  return max(rest, R(0.0));
}

// specularColor by fewer operations: DielectricSpecular (1 - Metallic) + BaseColor Metallic.
FN real3 refitSpecularColor(real3 DielectricSpecular, real3 BaseColor, real Metallic) {
  PRECISE real keep = R(1.0) - Metallic;
  PRECISE real3 F0 = real3(DielectricSpecular.x * keep + BaseColor.x * Metallic, DielectricSpecular.y * keep + BaseColor.y * Metallic,
                           DielectricSpecular.z * keep + BaseColor.z * Metallic);
  return F0;
}

// What is left of the base colour for diffuse light: BaseColor (1 - Metallic) share.
FN real3 refitDiffuseColor(real3 BaseColor, real Metallic, real3 share) {
  PRECISE real keep = R(1.0) - Metallic;
  PRECISE real3 diffuse = real3(BaseColor.x * keep * share.x, BaseColor.y * keep * share.y, BaseColor.z * keep * share.z);
  return diffuse;
}

// What stands for the lobe's mean of the environment's light: a share `wide` of the irradiance over pi, which the diffuse
// lobe has evaluated anyway, for the lobe's wide part about the normal, and for the rest one read, trilinear between the
// mips of layer 0, not in V's mirror direction R at mipFromRoughness but along R + lean N (which needs no normalising):
//   lean = alpha (d0 + d1 NoV),  mip = m0 + m1 log2(alpha) + m2 NoV,  wide = saturate(s0 alpha + s1 + s2 NoV)
// docs/refit.md says how far this is from the lobe beside reads in the mirror and the GGX dominant direction (study/fit).
// mip runs from below 0 to above the last one: the sampler clamps it. Roughness, NoV in [0, 1]; wide in [0, 1].
struct RefitTap {
  real lean;
  real mip;
  real wide;
};
FN RefitTap refitTap(real Roughness, real NoV) {
  RefitTap tap;
  real alpha = refitAlpha(Roughness);
  PRECISE real lean = alpha * (R(1.48446) + R(-1.62534) * NoV);
  PRECISE real mip = R(3.9594) + R(0.608014) * log2(alpha) + R(1.11356) * NoV;
  PRECISE real wide = R(1.20622) * alpha + R(-0.0579479) + R(-0.122376) * NoV;
  tap.lean = lean;
  tap.mip = mip;
  tap.wide = min(max(wide, R(0.0)), R(1.0));
  return tap;
}

// R + lean N with R = 2 NoV N - V. NoV: N.V, 0 where that is negative.
FN real3 refitDirection(real3 N, real3 V, real NoV, real lean) {
  PRECISE real n = R(2.0) * NoV + lean;
  PRECISE real3 d = real3(n * N.x - V.x, n * N.y - V.y, n * N.z - V.z);
  return d;
}

// The half vector's cosines without the vector: with h = V + L,  NoH = N.h/|h|,  VoH = |h|/2. Unit vectors, in at least
// fp32: halves are unit to 5e-4 only, which is more than 1 - NoH over a smooth lobe. V = -L: both 0.
struct RefitHalfVector {
  real32 NoH;
  real32 VoH;
};
FN RefitHalfVector refitHalfVector(real32x3 N, real32x3 V, real32x3 L) {
  RefitHalfVector cosines;
  PRECISE real32x3 h = real32x3(V.x + L.x, V.y + L.y, V.z + L.z);
  real32 length = sqrt(dot32(h, h));
  PRECISE real32 NoH = dot32(N, h) / max(length, R32(1e-6));
  PRECISE real32 VoH = min(R32(0.5) * length, R32(1.0));
  cosines.NoH = min(NoH, R32(1.0));
  cosines.VoH = VoH;
  return cosines;
}

// pi D V NoL, D: GGX in fp32, as D_GGX; V: height-correlated Smith (V_SmithGGXCorrelated). In half a smooth peak is cut at
// 58954. NoL in [0, 1]; NoH in [-1, 1].
FN real refitPeak(RefitLobe lobe, real NoL, real32 NoH) {
  PRECISE real32 n = real32(lobe.alpha) * NoH;
  PRECISE real32 d = (R32(1.0) - NoH) * (R32(1.0) + NoH) + n * n;
  PRECISE real32 p = real32(lobe.alpha) / d;
  PRECISE real sum = NoL * lobe.rootV + lobe.NoV * refitRoot(lobe.alpha, NoL);
  PRECISE real V = R(0.5) * NoL / max(sum, kSmallest);
  PRECISE real32 peak = p * p * real32(V);
  return real(min(peak, kRefitMost));
}

// Schlick's (1 - VoH)^5. VoH in [0, 1] but for rounding.
FN real refitFresnel(real32 VoH) {
  PRECISE real x = R(1.0) - real(VoH);
  PRECISE real x2 = x * x;
  PRECISE real f = x2 * x2 * x;
  return f;
}

// pi times the specular BRDF, times NoL: 1/pi is in the light's colour.
//   F D V NoL pi + M (g0 + g1 NoL) NoL
// What scatters more than once leaves as g0 + g1 NoL, which integrates to 1, in place of Kulla and Conty's (1 - E(NoL)) /
// (1 - Eavg). Ranges as refitPeak and refitFresnel.
FN real3 refitLight(RefitLobe lobe, real NoL, RefitHalfVector cosines) {
  real peak = refitPeak(lobe, NoL, cosines.NoH);
  real f = refitFresnel(cosines.VoH);
  PRECISE real g = (R(0.637703) + R(0.543446) * NoL) * NoL;
  PRECISE real3 specular = real3((lobe.F0.x + lobe.rise.x * f) * peak + lobe.multiple.x * g,
                                 (lobe.F0.y + lobe.rise.y * f) * peak + lobe.multiple.y * g,
                                 (lobe.F0.z + lobe.rise.z * f) * peak + lobe.multiple.z * g);
  return specular;
}

// The same of refitNonmetalLobe, alike in every channel, bit for bit.
FN real refitNonmetalLight(RefitLobe lobe, real NoL, RefitHalfVector cosines) {
  PRECISE real specular = (lobe.F0.x + lobe.rise.x * refitFresnel(cosines.VoH)) * refitPeak(lobe, NoL, cosines.NoH);
  return specular;
}

#endif
