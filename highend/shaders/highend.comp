// The high-end path: full GGX for every light, environment by prefiltered cube, tabulated environment BRDF and SH.
//
// Colour = diffuse + specular, added as Unreal Engine 4 adds them (no 1 - F on the diffuse lobe), so that the material model is the
// mobile path's own.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/path.glsl"
#include "shading/brdf.glsl"

layout(constant_id = 8) const uint kGeometryTerm = 0u;  // kGeometry... of interface.h
layout(constant_id = 9) const uint kCompensate = 1u;    // energy compensation for multiple scattering

// Of analytic lights only: alpha = 2.4e-4 keeps the peak of D (5e6) far from overflow. The image light has no floor.
const float kMinLightRoughness = 0.015625;
// Grazing and back-facing shading normals: the lobe of the last visible direction.
const float kMinNoV = 1e-4;

struct Lobes {
  vec3 diffuse, specular;
};

struct Shader {
  vec3 N, V, diffuseColor, F0, compensation;
  float F90, NoV, alpha;
};

// Reflected radiance for an illuminance (on a surface facing the light) from direction L.
Lobes lit(Shader s, vec3 L, vec3 illuminance) {
  Lobes lobes = Lobes(vec3(0.0), vec3(0.0));
  float NoL = saturate(dot(s.N, L));
  if (NoL <= 0.0) return lobes;
  vec3 H = safeNormalize(s.V + L, s.N); // V = -L: the normal
  float NoH = saturate(dot(s.N, H)), VoH = saturate(dot(s.V, H));
  float V = kGeometryTerm == kGeometryHeightCorrelated ? V_SmithGGXCorrelated(s.alpha, s.NoV, NoL) : V_SchlickSmith(s.alpha, s.NoV, NoL);
  // F_Schlick with the material's F90: F_Schlick itself where that is 1.
  float f = F_Schlick(vec3(0.0), VoH).x;
  vec3 F = s.F0 * (1.0 - f) + s.F90 * f;
  vec3 E = illuminance * NoL;
  lobes.diffuse = E * s.diffuseColor * Fd_Lambert();
  lobes.specular = E * (D_GGX(s.alpha, NoH) * V) * F * s.compensation;
  return lobes;
}

// Direction to a point or spot light, and its illuminance at the point (KHR_lights_punctual: candela over metres squared, range, cone).
vec3 localLight(GpuLight light, vec3 position, out vec3 L) {
  vec3 d = light.positionKind.xyz - position;
  float d2 = dot(d, d);
  L = safeNormalize(d, -light.directionCosOuter.xyz); // at the light itself: as if from its axis
  float attenuation = squareFalloff(d2, light.colorRange.w);
  if (uint(light.positionKind.w) == kLightSpot) attenuation *= spotAttenuation(dot(-L, light.directionCosOuter.xyz), light.cone.x, light.directionCosOuter.w);
  return light.colorRange.xyz * attenuation;
}

void main() {
  uint local = entryIndex();
  if (local >= count) return;
  uint i = first + local;
  Point p = makePoint(i);
  Resolved m = resolveMaterial(p, i);
  Terms terms = noTerms();
  if (hasFeature(kFeatureUnlit, p.material)) {
    terms.t[kTermEmissive] = m.baseColor;
    writeResult(i, terms, m.opacity);
    return;
  }

  Shader s;
  s.N = m.normal;
  s.V = p.V;
  s.NoV = clamp(dot(s.N, s.V), kMinNoV, 1.0);
  s.diffuseColor = diffuseColor(m.baseColor, m.metallic);
  s.F0 = specularColor(m.F0, m.baseColor, m.metallic);
  s.F90 = mix(m.F90, 1.0, m.metallic);
  vec2 AB = vec2(0.0);
  s.compensation = vec3(1.0);
  if (kHasEnvironment != 0u || kCompensate != 0u) AB = textureLod(pathTexture, vec2(s.NoV, m.roughness), 0.0).xy;
  if (kCompensate != 0u) s.compensation = energyCompensation(s.F0, AB);
  s.alpha = sqr(max(m.roughness, kMinLightRoughness));

  for (uint k = 0u; k < kDirectionalCount; ++k) {
    Lobes lobes = lit(s, -lights[k].directionCosOuter.xyz, lights[k].colorRange.xyz);
    terms.t[kTermSunDiffuse] += lobes.diffuse;
    terms.t[kTermSunSpecular] += lobes.specular;
  }
  for (uint k = kDirectionalCount; k < kDirectionalCount + kLocalCount; ++k) {
    vec3 L;
    vec3 illuminance = localLight(lights[k], p.position, L);
    Lobes lobes = lit(s, L, illuminance);
    terms.t[kTermLocalDiffuse] += lobes.diffuse;
    terms.t[kTermLocalSpecular] += lobes.specular;
  }
  if (kHasEnvironment != 0u) {
    terms.t[kTermSkyDiffuse] = skyIrradianceOverPi(s.N) * s.diffuseColor * m.occlusion;
    vec3 R = 2.0 * dot(s.N, s.V) * s.N - s.V;
    terms.t[kTermSkySpecular] = skyRadianceBetweenLevels(R, m.roughness) * (s.F0 * AB.x + s.F90 * AB.y) * s.compensation * m.occlusion;
  }
  terms.t[kTermEmissive] = m.emissive;
  writeResult(i, terms, m.opacity);
}
