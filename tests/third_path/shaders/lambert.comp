// A toy path: Lambert alone, under directional lights and the sky's first SH coefficients.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/path.glsl"
#include "shading/sky_sh.glsl"

layout(constant_id = 8) const float kAlbedoScale = 1.0; // its one knob

void main() {
  uint i = surfaceEntry();
  Point p = makePoint(i);
  Resolved m = resolveMaterial(p, i);
  Terms terms = noTerms();
  if (hasFeature(kFeatureUnlit, p.material)) {
    terms.t[kTermEmissive] = m.baseColor;
    writeResult(i, terms, m.opacity);
    return;
  }
  vec3 albedo = m.baseColor * kAlbedoScale;
  for (uint k = 0u; k < directionalCount(); ++k)
    terms.t[kTermSunDiffuse] += albedo * kInvPi * lights[k].colorRange.xyz *
                                max(dot(m.normal, -lights[k].directionCosOuter.xyz), 0.0);
  SkySh sky;
  for (int k = 0; k < 9; ++k) sky.c[k] = view.path[kPathSkySh + k].xyz;
  terms.t[kTermSkyDiffuse] = albedo * view.skyLightColor.xyz * m.occlusion * GetSkySHDiffuseSimple(sky, m.normal);
  terms.t[kTermEmissive] = m.emissive;
  writeResult(i, terms, m.opacity);
}
