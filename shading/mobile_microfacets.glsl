// Anisotropy and thin films of the mobile path, in cheap forms. They belong to no engine's mobile renderer: Unreal Engine 4's
// has neither.
#ifndef PARITY_SHADING_MOBILE_MICROFACETS
#define PARITY_SHADING_MOBILE_MICROFACETS

#include "shading/mobile_direct.glsl"
#include "shading/real.glsl"
#include "shading/refit.glsl"

// Which form of anisotropy.
CONSTANT int kAnisotropyNone = 0;
CONSTANT int kAnisotropyBent = 1;

// Which form of thin films.
CONSTANT int kIridescenceNone = 0;
CONSTANT int kIridescenceTint = 1;

// alpha along the tangent, mix(alpha, 1, strength^2) (KHR_materials_anisotropy), and across it. The round lobe that
// stands for both has the geometric mean of them.
struct MobileAnisotropy {
  real Roughness; // of that round lobe: (alphaT alphaB)^(1/4)
  real readRoughness; // of the level that is read: alpha is at least alphaT / 4, as one read is one spot of a streak
  real share;     // of the bent normal
  real32 squeeze; // alphaB / alphaT
};
FN MobileAnisotropy mobileAnisotropy(real Roughness, real strength) {
  PRECISE real32 r = real32(max(Roughness, R(0.015625)));
  PRECISE real32 s2 = real32(strength) * real32(strength);
  PRECISE real32 alpha = r * r;
  PRECISE real32 along = alpha + (R32(1.0) - alpha) * s2;
  PRECISE real32 share = (along - alpha) / (along + alpha);
  MobileAnisotropy m;
  real32 mean = sqrt(alpha * along);
  m.Roughness = real(sqrt(mean));
  m.readRoughness = real(sqrt(max(mean, R32(0.25) * along)));
  m.share = real(share);
  m.squeeze = alpha / along;
  return m;
}

// The normal about which the environment is read: between N and the normal that fibres along the bitangent B show to the
// eye, V without its part along B. Roughness grows across the fibres, along the tangent. McAllister, Lastra and Heidrich
// 2002 ("Efficient Rendering of Spatial Bi-directional Reflectance Distribution Functions") and Revie 2012; the share is the
// project's own, (alphaT - alphaB) / (alphaT + alphaB). N, B, V unit. V along B: N.
FN real32x3 bentNormal(real32x3 N, real32x3 B, real32x3 V, real32 share) {
  real32 along = dot32(B, V);
  PRECISE real32x3 seen = real32x3(V.x - B.x * along, V.y - B.y * along, V.z - B.z * along);
  real32x3 n = safeNormalize(seen, N);
  PRECISE real32x3 bent = real32x3(N.x + (n.x - N.x) * share, N.y + (n.y - N.y) * share, N.z + (n.z - N.z) * share);
  return safeNormalize(bent, N);
}

// What stands for 1 - NoH^2 in the round lobe, so that it has the values of GGX with two alphas: with x = T.H, y = B.H
//   D = 1 / (pi alphaT alphaB (x^2 / alphaT^2 + y^2 / alphaB^2 + NoH^2)^2),  sin2 = squeeze x^2 + y^2 / squeeze
// Burley 2012 ("Physically-Based Shading at Disney"), appendix B. squeeze in (0, 1].
FN real32 squeezedSin2(real32 x, real32 y, real32 squeeze) {
  PRECISE real32 sin2 = squeeze * x * x + y * y / squeeze;
  return sin2;
}

// refitPeak with sin2 for 1 - NoH^2. The visibility is the round lobe's.
FN real squeezedRefitPeak(RefitLobe lobe, real NoL, real32 NoH, real32 sin2) {
  PRECISE real32 n = real32(lobe.alpha) * NoH;
  PRECISE real32 d = sin2 + n * n;
  PRECISE real32 p = real32(lobe.alpha) / max(d, R32(1e-12));
  PRECISE real sum = NoL * lobe.rootV + lobe.NoV * refitRoot(lobe.alpha, NoL);
  PRECISE real V = R(0.5) * NoL / max(sum, kSmallest);
  PRECISE real32 peak = p * p * real32(V);
  return real(min(peak, kRefitMost));
}

// refitLight with that peak.
FN real3 squeezedRefitLight(RefitLobe lobe, real NoL, RefitHalfVector cosines, real32 sin2) {
  real peak = squeezedRefitPeak(lobe, NoL, cosines.NoH, sin2);
  real f = refitFresnel(cosines.VoH);
  PRECISE real g = (R(0.637703) + R(0.543446) * NoL) * NoL;
  PRECISE real3 specular = real3((lobe.F0.x + lobe.rise.x * f) * peak + lobe.multiple.x * g,
                                 (lobe.F0.y + lobe.rise.y * f) * peak + lobe.multiple.y * g,
                                 (lobe.F0.z + lobe.rise.z * f) * peak + lobe.multiple.z * g);
  return specular;
}

// CalcSpecular with sin2 for 1 - NoH^2.
FN real squeezedCalcSpecular(real Roughness, real32 NoH, real32 sin2) {
  PRECISE real a = Roughness * Roughness;
  PRECISE real n = real(NoH * real32(a));
  PRECISE real nn = n * n;
  PRECISE real32 p32 = real32(a) / max(sin2 + real32(nn), R32(1e-7));
  PRECISE real32 d = min(p32 * p32, R32(2048.0));
  PRECISE real s = (Roughness * R(0.25) + R(0.25)) * real(d);
  return s;
}

// Reflectance of one wavelength by a film over a base, amplitudes at normal incidence (Airy 1833):
//   r1 = (n - 1) / (n + 1),  r2 = (nb - n) / (nb + n),  nb = (1 + sqrt(F0)) / (1 - sqrt(F0))
//   F = (r1^2 + r2^2 + x) / (1 + r1^2 r2^2 + x),  x = 2 r1 r2 cos(2 pi turns) 2^(-fade turns^2)
// turns: wavelengths on the way through the film and back. The fade is that of the eye's broad curves.
FN real32 filmReflectance(real32 filmIor, real32 F0, real32 turns, real32 fade) {
  PRECISE real32 root = sqrt(min(F0, R32(1.0)));
  PRECISE real32 r1 = (filmIor - R32(1.0)) / (filmIor + R32(1.0));
  PRECISE real32 less = filmIor * (R32(1.0) - root);
  PRECISE real32 r2 = (R32(1.0) + root - less) / (R32(1.0) + root + less);
  PRECISE real32 part = turns - floor(turns);
  PRECISE real32 x = R32(2.0) * r1 * r2 * cos(R32(6.28318531) * part) * exp2(-fade * turns * turns);
  PRECISE real32 product = r1 * r2;
  PRECISE real32 F = (r1 * r1 + r2 * r2 + x) / (R32(1.0) + product * product + x);
  return min(max(F, R32(0.0)), R32(1.0));
}

// The specular colour under a film, in place of F0: interference at three wavelengths, for the view's angle. They and the fades
// are fitted to thinFilmFresnel over n in [1.2, 2], 100 to 800 nm, F0 in [.02, .95], cosines in [.2, 1] (Schlick's curve over
// both): rms .08, without a film .15 (tests/shading/mobile_microfacets_test.cpp). thickness: nm. NoV in [0, 1].
FN real3 filmTint(real32 filmIor, real32 thickness, real3 F0, real NoV) {
  PRECISE real32 cosine = real32(NoV);
  PRECISE real32 sin2 = (R32(1.0) - cosine * cosine) / (filmIor * filmIor);
  PRECISE real32 path = R32(2.0) * filmIor * thickness * sqrt(max(R32(1.0) - sin2, R32(0.0)));
  return real3(real(filmReflectance(filmIor, real32(F0.x), path / R32(599.0), R32(0.02))),
               real(filmReflectance(filmIor, real32(F0.y), path / R32(547.0), R32(0.0303))),
               real(filmReflectance(filmIor, real32(F0.z), path / R32(452.0), R32(0.0335))));
}

// What is under a film, by its share of the surface.
FN real3 underFilm(real3 F0, real3 film, real share) {
  PRECISE real3 mixed = real3(F0.x + (film.x - F0.x) * share, F0.y + (film.y - F0.y) * share, F0.z + (film.z - F0.z) * share);
  return mixed;
}

#endif
