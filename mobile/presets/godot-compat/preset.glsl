// The formulas of Godot 4's renderer for older phones and the web, "Compatibility".
//
// Sources: Juan Linietsky, Ariel Manzur and contributors, Godot Engine 4 (2023 and later; godotengine/godot):
// drivers/gles3/shaders/scene.glsl for light_compute, get_omni_spot_attenuation (get_omni_attenuation in the other
// renderers), light_process_spot and the reflections. modules/gltf/extensions/gltf_light.cpp for what an imported glTF
// light becomes.
//
// Deviations:
// - The shader's precision is highp. So the lobe and the environment BRDF are fp32 here with either precision, and
//   what they return is rounded. N.L, N.V, Roughness and the cosines of a cone come in the working precision.
// - F90 is clamp(50 F0.g, 0, 1), as scene.glsl has it. The environment BRDF's lower bound is Metallic there. No
//   function of the path is told Metallic, and 0 stands for it. That matters to metals whose green F0 is below 0.02.
//   The other renderers of Godot have clamp(dot(F0, 50 * 0.33), Metallic, 1) for lights.
// - Godot leans the reflected direction towards the normal by Roughness^2, and fades reflections that point below the
//   horizon. Here the direction is the mirror's, and nothing fades.
// - Godot reads the mip sqrt(Roughness) of its own filtered sky. The path keeps its own mips, which are filtered
//   otherwise.
// - Godot's materials have Burley's diffuse lobe unless they ask for another. The path has Lambert's.
// - Godot multiplies the energy of lights by pi outside of these functions. The path's lights keep lux and candela.
// - Lights have no size. They keep their falloff where it has an exponent.
// - Coats, brushed metal and glass are the path's.

// Karis 2014, "Physically Based Shading on Mobile". B fades out below F0 = 2 %.
real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV) {
  real32 rough = real32(Roughness);
  PRECISE real32 smoothness = R32(1.0) - rough;
  PRECISE real32 e = R32(-9.28) * real32(NoV);
  PRECISE real32 a004 = min(smoothness * smoothness, exp2(e)) * smoothness + (R32(0.0425) - R32(0.0275) * rough);
  PRECISE real32 A = R32(1.04) - R32(0.572) * rough - R32(1.04) * a004;
  PRECISE real32 B = R32(0.022) * rough - R32(0.04) + R32(1.04) * a004;
  PRECISE real32 F90 = min(R32(50.0) * real32(SpecularColor.y), R32(1.0));
  PRECISE real32 faded = B * F90;
  return real2(real(A), real(faded));
}

// GGX; the visibility of Hammon 2017 ("PBR Diffuse Lighting for GGX+Smith Microsurfaces"); Schlick's curve to F90. The
// source has no specular light where the roughness is 0.
real3 presetDirectLobe(MobileShadingModelContext c, MobileFrame f, real32x3 L, real NoL) {
  if (c.Roughness <= R(0.0) || NoL <= R(0.0)) return real3(R(0.0));
  real32 cosL = real32(NoL), cosV = max(dot32(f.N32, f.V32), R32(1e-4));
  real32x3 H = safeNormalize(f.V32 + L, f.N32);
  real32 NoH = min(max(dot32(f.N32, H), R32(0.0)), R32(1.0));
  real32 LoH = min(max(dot32(L, H), R32(0.0)), R32(1.0));
  PRECISE real32 alpha = real32(c.Roughness) * real32(c.Roughness);
  PRECISE real32 n = NoH * alpha;
  PRECISE real32 k = alpha / (R32(1.0) - NoH * NoH + n * n); // its square is pi D
  PRECISE real32 smoothPart = R32(2.0) * cosL * cosV;
  PRECISE real32 roughPart = cosL + cosV;
  PRECISE real32 V = R32(0.5) / (smoothPart + (roughPart - smoothPart) * alpha);
  PRECISE real32 x = R32(1.0) - LoH;
  PRECISE real32 x2 = x * x;
  PRECISE real32 x5 = x2 * x2 * x;
  real32x3 F0 = widen(c.SpecPreEnvBrdf);
  real32 F90 = min(max(R32(50.0) * F0.y, R32(0.0)), R32(1.0));
  PRECISE real32x3 F = F0 + (F90 - F0) * x5;
  PRECISE real32x3 specular = F * (cosL * V * (k * k));
  return narrow(specular);
}

// get_omni_spot_attenuation: the window is squared, and the decay is 2, which imported glTF lights have. A light of
// Godot's own has 1 by default. The importer keeps the range within 4096 m; a light without range gets that.
real32 presetDistanceFalloff(int falloff, real32 d2, real32 range, real32 exponent) {
  if (falloff == kFalloffExponent) return exponentFalloff(d2, range, exponent);
  real32 reach = R32(4096.0);
  if (range > R32(0.0)) reach = min(max(range, R32(0.001)), R32(4096.0));
  PRECISE real32 q = d2 / reach / reach;
  PRECISE real32 w = max(R32(1.0) - q * q, R32(0.0));
  PRECISE real32 attenuation = w * w / max(d2, R32(1e-8)); // (0.1 mm)^2
  return attenuation;
}

// light_process_spot: 1 - rim^p, where the rim is 0 at the axis and 1 at the outer angle, measured in cosines. So the
// light dims from the axis on, not from the inner angle on. The importer makes p of the two angles:
// 0.2 / (1 - inner / outer) - 0.1. Where they are the same that is infinite. Here it is 2000, and the edge is as hard.
real presetSpotCone(real cosAngle, real cosInner, real cosOuter) {
  real32 outer = acos(min(max(real32(cosOuter), R32(-1.0)), R32(1.0)));
  real32 inner = acos(min(max(real32(cosInner), R32(-1.0)), R32(1.0)));
  PRECISE real32 soft = R32(1.0) - inner / max(outer, R32(1e-4));
  PRECISE real32 power = R32(0.2) / max(soft, R32(1e-4)) - R32(0.1);
  real32 across = max(real32(cosAngle), real32(cosOuter));
  PRECISE real32 rim = (R32(1.0) - across) / max(R32(1.0) - real32(cosOuter), R32(1e-6));
  PRECISE real32 attenuation = R32(1.0) - pow(max(rim, R32(0.0001)), power);
  return real(min(max(attenuation, R32(0.0)), R32(1.0)));
}
