// The formulas of Filament, Google's renderer, as it publishes them for phones.
//
// Sources: Romain Guy and Mathias Agopian, "Physically Based Rendering in Filament" (2018 and later). Shaders of
// google/filament: brdf.fs (now surface_brdf.fs), light_punctual.fs (now surface_light_punctual.fs), light_indirect.fs
// and common_material.fs. LightManager.cpp for the cone of spot lights.
//
// Deviations:
// - The engine reads A and B from a table. The document names the analytic fit of Karis 2014 as an alternative where
//   samplers are scarce. This folder takes the fit, as the mobile path has no table. The document says that the fit
//   does not go with the compensation of light that scatters more than once, so there is none.
// - The engine picks the mip Roughness (2 - Roughness) of its own filtered cube. The path keeps its own mips, which are
//   filtered otherwise. The engine also leans the reflected direction towards the normal: here it is the mirror's.
// - F90 is saturate(dot(F0, 50 * 0.33)), as the document has it. That is the quality level normal. The level low, which
//   materials for phones have by default, has F90 = 1. Both differ where F0 is below 0.0202 on average.
// - Products of D, V and N.L are fp32 and saturate. In half, as in the source, D V may be infinite at grazing views.
// - D saturates at 65504 in either precision (saturateMediump of earlier releases). Newer releases bound the root of
//   pi D by 453.5 instead, which is the same to 0.1 %. With the roughness floor of preset.toml neither acts. Without
//   a floor roughness 0 is 0/0, as in the source.
// - Lights keep their falloff where it has an exponent. The lights' fade by the distance to the camera is left out.
// - The diffuse lobe is the path's, Lambert like the source's. Coats, brushed metal and glass are the path's.
// - The sky light has four coefficients. Newer releases have nine on phones, too: sky_sh = "9".

// PrefilteredDFG_Karis: Karis 2014, "Physically Based Shading on Mobile". F90 is 1.
real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV) {
  PRECISE real smoothness = R(1.0) - Roughness;
  PRECISE real base = R(0.0425) - R(0.0275) * Roughness;
  PRECISE real e = R(-9.28) * NoV;
  PRECISE real a004 = min(smoothness * smoothness, exp2(e)) * smoothness + base;
  PRECISE real A = R(1.04) - R(0.572) * Roughness - R(1.04) * a004;
  PRECISE real B = R(0.022) * Roughness - R(0.04) + R(1.04) * a004;
  return real2(A, B);
}

// The distribution of GGX. |N x H|^2 is 1 - N.H^2 by Lagrange's identity: in half it keeps the digits that the
// difference loses near the peak.
real filamentD(real alpha, real3 N, real3 H) {
  PRECISE real3 NxH = real3(N.y * H.z - N.z * H.y, N.z * H.x - N.x * H.z, N.x * H.y - N.y * H.x);
  PRECISE real n = saturate(dot3(N, H)) * alpha;
  PRECISE real k = alpha / (dot3(NxH, NxH) + n * n);
  PRECISE real d = k * (k * kInvPi);
  return min(d, R(65504.0));
}

// Visibility, Hammon 2017 ("PBR Diffuse Lighting for GGX+Smith Microsurfaces"): Smith's height-correlated term without
// its roots.
real filamentV(real alpha, real NoV, real NoL) {
  PRECISE real smoothPart = R(2.0) * NoL * NoV;
  PRECISE real roughPart = NoL + NoV;
  PRECISE real v = R(0.5) / (smoothPart + (roughPart - smoothPart) * alpha);
  return min(v, R(65504.0));
}

// Schlick's curve from F0 to F90. F0 below 2 % means that something is in the way, and F90 fades out with it.
real3 filamentF(real3 F0, real LoH) {
  PRECISE real F90 = saturate(R(16.5) * F0.x + R(16.5) * F0.y + R(16.5) * F0.z);
  PRECISE real x = R(1.0) - LoH;
  PRECISE real x2 = x * x;
  PRECISE real x5 = x2 * x2 * x;
  PRECISE real3 F = real3(F0.x + (F90 - F0.x) * x5, F0.y + (F90 - F0.y) * x5, F0.z + (F90 - F0.z) * x5);
  return F;
}

real3 presetDirectLobe(MobileShadingModelContext c, MobileFrame f, real32x3 L, real NoL) {
  real3 H = halfVector(f.N, f.V, L);
  real NoV = max(dot3(f.N, f.V), R(1e-4));
  real LoH = saturate(real(dot32(L, widen(H))));
  PRECISE real alpha = c.Roughness * c.Roughness;
  real3 F = filamentF(c.SpecPreEnvBrdf, LoH);
  real32 D = real32(filamentD(alpha, f.N, H)), V = real32(filamentV(alpha, NoV, NoL));
  PRECISE real32 lobe = D * V * real32(NoL) * R32(3.14159265);
  PRECISE real32x3 specular = real32x3(real32(F.x) * lobe, real32(F.y) * lobe, real32(F.z) * lobe);
  return narrow(specular);
}

// getSquareFalloffAttenuation over the squared distance, which is at least (1 cm)^2. The window is squared:
// KHR_lights_punctual's is not.
real32 presetDistanceFalloff(int falloff, real32 d2, real32 range, real32 exponent) {
  if (falloff == kFalloffExponent) return exponentFalloff(d2, range, exponent);
  real32 window = R32(1.0);
  if (range > R32(0.0)) {
    PRECISE real32 q = d2 / range / range;
    PRECISE real32 w = R32(1.0) - q * q;
    window = max(w, R32(0.0));
  }
  PRECISE real32 attenuation = window * window / max(d2, R32(1e-4));
  return attenuation;
}

// getAngleAttenuation, with the scale and the offset of setSpotLightCone, which are fp32. The cosines come in the
// working precision.
real presetSpotCone(real cosAngle, real cosInner, real cosOuter) {
  PRECISE real32 scale = R32(1.0) / max(real32(cosInner) - real32(cosOuter), R32(9.765625e-4)); // 1 / 1024
  PRECISE real32 offset = -real32(cosOuter) * scale;
  PRECISE real32 x = real32(cosAngle) * scale + offset;
  real s = real(min(max(x, R32(0.0)), R32(1.0)));
  return s * s;
}
