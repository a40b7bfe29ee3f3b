// The mobile path: Karis 2014 ("Physically Based Shading on Mobile") and Unreal Engine 4's mobile base pass (2020), in the order in
// which the base pass accumulates. fp32.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/path.glsl"
#include "shading/env_brdf.glsl"
#include "shading/mobile_direct.glsl"

layout(constant_id = 8) const uint kPreset = 1u; // kPreset... of interface.h

void main() {
  uint local = entryIndex();
  if (local >= count) return;
  uint i = first + local;
  Point p = makePoint(i);
  Resolved m = resolveMaterial(p, i);
  Terms terms = noTerms();
  if (hasFeature(kFeatureUnlit, p.material)) {
    terms.t[kTermEmissive] = m.baseColor;
    writeResult(i, premultiply(seenThrough(vertexFog(i), terms), m.opacity), m.opacity);
    return;
  }

  // InitShadingModelContext. The base pass keeps roughness off 0 ("1/Roughness^4"); the article prints no floor, and has none here.
  float Roughness = kPreset == kPresetKaris2014 ? m.roughness : max(0.015625, m.roughness);
  vec3 N = m.normal, V = p.V;
  float NoV = max(dot(N, V), 0.0);
  vec3 DiffuseColor = diffuseColor(m.baseColor, m.metallic);
  vec3 SpecularColor = specularColor(m.F0, m.baseColor, m.metallic); // SpecPreEnvBrdf
  bool fullyRough = hasFeature(kFeatureFullyRough, p.material);
  if (fullyRough) {
    Roughness = 1.0;
    FullyRough(DiffuseColor, SpecularColor);
  } else if (hasFeature(kFeatureNonmetal, p.material)) {
    SpecularColor = vec3(EnvBRDFApproxNonmetal(Roughness, NoV));
  } else if (kPreset == kPresetKaris2014) {
    SpecularColor = EnvBRDFApprox(SpecularColor, Roughness, NoV);
  } else {
    SpecularColor = EnvBRDFApproxUE4(SpecularColor, Roughness, NoV);
  }
  vec3 R = 2.0 * dot(N, V) * N - V;

  // The one directional light; 1/pi is in its colour.
  if (kDirectionalCount != 0u) {
    vec3 L = -lights[0].directionCosOuter.xyz;
    vec3 color = lights[0].colorRange.xyz * kInvPi;
    float NoL = max(0.0, dot(N, L));
    terms.t[kTermSunDiffuse] = color * (NoL * DiffuseColor);
    if (!fullyRough && NoL > 0.0) {
      float specular;
      if (kPreset == kPresetKaris2014) {
        specular = D_Approx(Roughness, dot(R, L));
      } else {
        float NoH = max(0.0, dot(N, safeNormalize(V + L, N)));
        specular = CalcSpecular(Roughness, NoH);
      }
      terms.t[kTermSunSpecular] = color * (SpecularColor * (NoL * specular)) * lights[0].cone.y;
    }
  }

  // SpecularIBL: one fetch, none for fully rough materials. Material AO takes the place of its effect on IndirectIrradiance.
  if (kHasEnvironment != 0u && !fullyRough) terms.t[kTermSkySpecular] = skyRadiance(R, Roughness) * SpecularColor * m.occlusion;

  // AccumulateLightingOfDynamicPointLight, for the lights chosen per object.
  if (kLocalCount != 0u && kPreset != kPresetKaris2014) {
    for (uint k = 0u; k < kLightsPerObject; ++k) {
      uint index = pathData[p.instance * kLightsPerObject + k];
      if (index == kNoLight) break;
      GpuLight light = lights[index];
      vec3 d = light.positionKind.xyz - p.position;
      vec3 L = safeNormalize(d, -light.directionCosOuter.xyz);
      float attenuation = squareFalloffUE4(dot(d, d), light.colorRange.w);
      if (uint(light.positionKind.w) == kLightSpot) attenuation *= spotAttenuation(dot(-L, light.directionCosOuter.xyz), light.cone.x, light.directionCosOuter.w);
      vec3 color = light.colorRange.xyz * (attenuation * kInvPi);
      float NoL = max(0.0, dot(N, L));
      float NoH = max(0.0, dot(N, safeNormalize(V + L, N)));
      vec3 diffuse = color * (NoL * DiffuseColor);
      vec3 specular = fullyRough ? vec3(0.0) : color * (SpecularColor * (NoL * CalcSpecular(Roughness, NoH))) * light.cone.y;
      // The clamp is on their sum; both are scaled by what it leaves.
      vec3 sum = diffuse + specular;
      vec3 kept = clampContribution65000(sum);
      vec3 share = vec3(sum.x > 0.0 ? kept.x / sum.x : 1.0, sum.y > 0.0 ? kept.y / sum.y : 1.0, sum.z > 0.0 ? kept.z / sum.z : 1.0);
      terms.t[kTermLocalDiffuse] += diffuse * share;
      terms.t[kTermLocalSpecular] += specular * share;
    }
  }

  if (kHasEnvironment != 0u) terms.t[kTermSkyDiffuse] = skyIrradianceOverPi(N) * view.skyLightColor.xyz * DiffuseColor * m.occlusion;
  terms.t[kTermEmissive] = m.emissive;
  writeResult(i, premultiply(seenThrough(vertexFog(i), terms), m.opacity), m.opacity);
}
