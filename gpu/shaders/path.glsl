// PARITY_LOBES: the shader is for scenes with lobes beside the base's own (kFeatureLobes). Others have one without them,
// which is smaller.
//
// What every path's shader begins with: the surface entry, the material resolved from its textures, the outputs. In fp32
// whatever the path's own precision: of the shading maths it calls only what is in real32.
#include "gpu/shaders/interface.h"
#include "shading/real.glsl"
#include "shading/material.glsl"
#include "shading/light.glsl"
#include "shading/specular_aa.glsl"
#include "shading/terms.glsl"

layout(local_size_x = 64) in;

// In the order in which gpu/surface/shading_pass.cpp gives their values; a path's own follow from 8.
layout(constant_id = 0) const uint kTextures = 0u;
layout(constant_id = 1) const uint kMayFeatures = 0u;
layout(constant_id = 2) const uint kMustFeatures = 0u;
layout(constant_id = 3) const uint kDirectionalCount = 0u; // these three may be kUnknown
layout(constant_id = 4) const uint kLocalCount = 0u; // or kListed
layout(constant_id = 5) const uint kHasEnvironment = 0u;
layout(constant_id = 6) const uint kWriteTerms = 0u; // a bit for each term
layout(constant_id = 7) const uint kVertexData = 0u; // what some scenes have, and what all have, above kVertexMustShift

layout(set = 0, binding = 0, std140) uniform View { GpuView view; };
layout(set = 0, binding = 1, std430) readonly buffer Materials { GpuMaterial materials[]; };
layout(set = 0, binding = 2, std430) readonly buffer Instances { GpuInstance instances[]; };
layout(set = 0, binding = 3, std430) readonly buffer Lights { GpuLight lights[]; }; // directional ones first
// sceneCounts: directional lights, local lights, 1 with an environment, kVertex... bits. Branches depend on them: not in
// GpuView.
layout(set = 0, binding = 4, std430) readonly buffer PathData { uvec4 sceneCounts; uint pathData[]; };
#define PARITY_SURFACE_ACCESS readonly
#define PARITY_SURFACE_BINDING 5
#include "gpu/shaders/surface.glsl"
layout(set = 0, binding = 14, std430) writeonly buffer OutColor { vec4 outColor[]; };   // radiance, opacity
layout(set = 0, binding = 15, std430) writeonly buffer OutTermsA { vec4 outTermsA[]; }; // terms 0..4, a plane each
layout(set = 0, binding = 16, std430) writeonly buffer OutTermsB { vec4 outTermsB[]; }; // the terms after them
layout(set = 0, binding = 17) uniform samplerCubeArray prefilteredEnvironment;
layout(set = 0, binding = 18) uniform sampler2D pathTexture; // the path's own table, if it has one
layout(set = 0, binding = 19) uniform sampler2DArray shadowMaps;
layout(set = 0, binding = 20, std430) readonly buffer ShadowViews { GpuShadowView shadowViews[]; };
layout(set = 0, binding = 21) uniform sampler2DArray lightmapPages; // of two halves, one above the other
layout(set = 0, binding = 22) uniform sampler2DArray sunShadowPages;
layout(set = 0, binding = 23, std430) readonly buffer Captures { uvec4 captureHead; GpuCapture captures[]; }; // head: how many
layout(set = 0, binding = 24, std430) readonly buffer LightmapScaling { GpuLightmapScales lightmapScales[]; }; // of instances

layout(set = 0, binding = 25) uniform samplerCubeArray environmentIrradiance; // over pi; an array of one
layout(set = 0, binding = 26) uniform sampler2D panorama; // lighting/environment/panorama_cells.h
// At least one. Not a storage buffer: lavapipe reads those lane by lane.
layout(set = 0, binding = 27, std140) uniform Lamps { GpuLamp lamps[kMaxLamps]; };

#ifdef PARITY_LOBES
layout(set = 0, binding = 28, std140) uniform EnvironmentPoints { GpuEnvironmentPoint environmentPoints[kEnvironmentPoints]; };
layout(set = 0, binding = 29) uniform sampler2DArray backdrop; // gpu/surface/backdrop.h
#endif

layout(set = 1, binding = 0) uniform sampler2D baseColorTexture;
layout(set = 1, binding = 1) uniform sampler2D metallicRoughnessTexture;
layout(set = 1, binding = 2) uniform sampler2D normalTexture;
layout(set = 1, binding = 3) uniform sampler2D occlusionTexture;
layout(set = 1, binding = 4) uniform sampler2D emissiveTexture;
layout(set = 1, binding = 5) uniform sampler2D specularTexture;
layout(set = 1, binding = 6) uniform sampler2D specularColorTexture;
#ifdef PARITY_LOBES
layout(set = 1, binding = 7) uniform sampler2D coatTexture;
layout(set = 1, binding = 8) uniform sampler2D coatRoughnessTexture;
layout(set = 1, binding = 9) uniform sampler2D coatNormalTexture;
layout(set = 1, binding = 10) uniform sampler2D sheenColorTexture;
layout(set = 1, binding = 11) uniform sampler2D sheenRoughnessTexture;
layout(set = 1, binding = 12) uniform sampler2D anisotropyTexture;
layout(set = 1, binding = 13) uniform sampler2D iridescenceTexture;
layout(set = 1, binding = 14) uniform sampler2D iridescenceThicknessTexture;
layout(set = 1, binding = 15) uniform sampler2D transmissionTexture;
layout(set = 1, binding = 16) uniform sampler2D thicknessTexture;
layout(set = 1, binding = 17) uniform sampler2D diffuseTransmissionTexture;
layout(set = 1, binding = 18) uniform sampler2D diffuseTransmissionColorTexture;
#endif

layout(push_constant) uniform Push {
  uint first, count; // the bin's entries
  uint planeSize;    // entries of the surface: stride of the term planes
  uint firstGroup;   // of the bin, counted over all bins of the surface
};

struct Point {
  vec3 position, V;         // world; V unit, towards the eye
  vec3 normal, geometric;   // unit
  uint instance, material;
};

struct Resolved {
  vec3 baseColor;
  float opacity, metallic, roughness, occlusion;
  vec3 F0;      // of the dielectric, linear RGB
  float F90;    // of the dielectric: KHR_materials_specular's factor
  vec3 normal;  // after normal mapping, unit
  vec3 emissive;
#ifdef PARITY_LOBES
  float coat, coatRoughness; // coat 0: none
  vec3 coatNormal;           // unit
  vec3 sheenColor;           // black: none
  float sheenRoughness;
  float anisotropy;          // 0: none
  vec3 tangent;              // of the anisotropy, unit, perpendicular to the normal
  float iridescence;         // 0: none
  float filmIor, filmThickness; // nm
  float transmission;        // 0: none
  float diffuseTransmission; // 0: none
  vec3 diffuseTransmissionColor;
  float ior, thickness;      // of a body, at least 1; metres of the world, 0: a thin wall
  vec3 absorption;           // of a body, 1 / metre
  float dispersion;          // 20 / Abbe number
#endif
};

// Whether the material has the feature: known at compile time where all or none of the permutation's have.
bool hasFeature(uint feature, uint material) {
  if ((kMustFeatures & feature) != 0u) return true;
  if ((kMayFeatures & feature) == 0u) return false;
  return (materials[material].flags.x & feature) != 0u;
}

uint directionalCount() { return kDirectionalCount == kUnknown ? sceneCounts.x : kDirectionalCount; }
uint localCount() { return kLocalCount == kUnknown ? sceneCounts.y : kLocalCount; }
bool hasEnvironment() { return kHasEnvironment == kUnknown ? sceneCounts.z != 0u : kHasEnvironment != 0u; }
bool hasVertexData(uint bits) {
  if ((kVertexData & (bits << kVertexMustShift)) != 0u) return true;
  if ((kVertexData & bits) == 0u) return false;
  return (sceneCounts.w & bits) != 0u;
}

// Known at compile time where all of the permutation's materials have the same textures.
bool hasTexture(int slot, uint material) {
  if ((kTextures & (1u << slot)) == 0u) return false;
  if ((kTextures & kTexturesVary) == 0u) return true;
  return materials[material].slots[slot].uvRow1.w > 0.5;
}

// The uvs of the entry, read once for all textures. A scene without uvs is read at (0,0).
vec4 entryUv = vec4(0.0); // both sets
vec4 entryDerivatives[2] = vec4[](vec4(0.0), vec4(0.0)); // of a set: d/dx, d/dy in pixels

void readUvs(uint i) {
  if (kTextures == 0u || !hasVertexData(kVertexUvs)) return;
  entryUv = surfaceUv[i];
  entryDerivatives[0] = surfaceUv0Derivatives[i];
  if (hasVertexData(kVertexSecondUv)) entryDerivatives[1] = surfaceUv1Derivatives[i];
}

// A texture at readUvs' place, by explicit derivatives: entries of a list have no neighbours.
vec4 fetch(sampler2D tex, int slot, uint material) {
  if ((kTextures & kTransformedUvs) == 0u) return textureGrad(tex, entryUv.xy, entryDerivatives[0].xy, entryDerivatives[0].zw);
  GpuTextureSlot s = materials[material].slots[slot];
  bool isSecond = hasVertexData(kVertexSecondUv) && s.uvRow0.w > 0.5;
  vec2 uv = isSecond ? entryUv.zw : entryUv.xy;
  vec4 d = isSecond ? entryDerivatives[1] : entryDerivatives[0];
  vec2 st = vec2(dot(s.uvRow0.xyz, vec3(uv, 1.0)), dot(s.uvRow1.xyz, vec3(uv, 1.0)));
  vec2 dx = vec2(dot(s.uvRow0.xy, d.xy), dot(s.uvRow1.xy, d.xy));
  vec2 dy = vec2(dot(s.uvRow0.xy, d.zw), dot(s.uvRow1.xy, d.zw));
  return textureGrad(tex, st, dx, dy);
}

Point makePoint(uint i) {
  Point p;
  uvec4 position = surfacePosition[i], normal = surfaceNormal[i];
  p.position = uintBitsToFloat(position.xyz);
  p.instance = position.w;
  p.material = instances[p.instance].geometry.z;
  p.normal = uintBitsToFloat(normal.xyz);
  p.geometric = unpackOctahedral(normal.w);
  p.V = normalize(view.viewer.xyz - view.viewer.w * p.position);
  return p;
}

// The fog of the triangle's vertices, interpolated: inscattered radiance, transmittance.
vec4 vertexFog(uint i) {
  if (!hasVertexData(kVertexFog)) return vec4(0.0, 0.0, 0.0, 1.0);
  return surfaceFog[i];
}

// Any two axes that make a right-handed frame with n (Duff et al. 2017).
vec3 anyTangent(vec3 n) {
  float s = n.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + n.z);
  return vec3(1.0 + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}

// Unit; w: the bitangent's sign.
vec4 tangentOf(Point p, uint i) {
  vec4 tangent = hasVertexData(kVertexTangents) ? surfaceTangent[i] : vec4(0.0);
  if (dot(tangent.xyz, tangent.xyz) < 0.5) tangent = vec4(anyTangent(p.normal), 1.0);
  return tangent;
}

// texel: of the normal map; scale: of its slopes.
vec3 mapNormal(Point p, uint i, vec4 texel, float scale) {
  vec4 tangent = tangentOf(p, i);
  vec3 bitangent = tangent.w * cross(p.normal, tangent.xyz);
  vec3 t = texel.xyz * 2.0 - 1.0;
  t.xy *= scale;
  return safeNormalize(t.x * tangent.xyz + t.y * bitangent + t.z * p.normal, p.geometric);
}

// Roughness that grows with the spread of the normals where the map's alpha holds it. Slopes, and so the root of their
// variance, scale with `scale`.
float widenBySpread(float roughness, vec4 texel, float scale) {
  if ((kTextures & kNormalVariance) == 0u) return roughness;
  return widenRoughness(roughness, clamp(texel.w * texel.w * scale * scale, 0.0, 1.0));
}

#ifdef PARITY_LOBES
void resolveCoat(inout Resolved r, Point p, uint i) {
  uint m = p.material;
  r.coat = r.coatRoughness = 0.0;
  r.coatNormal = p.normal; // the coat does not follow the base's normal map
  if (!hasFeature(kFeatureCoat, m)) return;
  r.coat = materials[m].coat.x;
  r.coatRoughness = materials[m].coat.y;
  if (hasTexture(kSlotCoat, m)) r.coat *= fetch(coatTexture, kSlotCoat, m).x;
  if (hasTexture(kSlotCoatRoughness, m)) r.coatRoughness *= fetch(coatRoughnessTexture, kSlotCoatRoughness, m).y;
  if (!hasTexture(kSlotCoatNormal, m)) return;
  vec4 texel = fetch(coatNormalTexture, kSlotCoatNormal, m);
  r.coatNormal = mapNormal(p, i, texel, materials[m].coat.z);
  r.coatRoughness = widenBySpread(r.coatRoughness, texel, materials[m].coat.z);
}

void resolveSheen(inout Resolved r, uint m) {
  r.sheenColor = vec3(0.0);
  r.sheenRoughness = 0.0;
  if (!hasFeature(kFeatureSheen, m)) return;
  r.sheenColor = materials[m].sheen.xyz;
  r.sheenRoughness = materials[m].sheen.w;
  if (hasTexture(kSlotSheenColor, m)) r.sheenColor *= fetch(sheenColorTexture, kSlotSheenColor, m).xyz;
  if (hasTexture(kSlotSheenRoughness, m)) r.sheenRoughness *= fetch(sheenRoughnessTexture, kSlotSheenRoughness, m).w;
}

// KHR_materials_anisotropy. The direction is turned into the plane of the shading normal.
void resolveAnisotropy(inout Resolved r, Point p, uint i) {
  uint m = p.material;
  r.anisotropy = 0.0;
  r.tangent = anyTangent(r.normal);
  if (!hasFeature(kFeatureAnisotropy, m)) return;
  r.anisotropy = materials[m].anisotropy.x;
  vec2 direction = vec2(1.0, 0.0);
  if (hasTexture(kSlotAnisotropy, m)) {
    vec3 texel = fetch(anisotropyTexture, kSlotAnisotropy, m).xyz;
    vec2 d = texel.xy * 2.0 - 1.0;
    if (dot(d, d) > 1e-4) direction = normalize(d);
    r.anisotropy *= texel.z;
  }
  vec2 turn = materials[m].anisotropy.yz;
  direction = vec2(turn.x * direction.x - turn.y * direction.y, turn.y * direction.x + turn.x * direction.y);
  vec4 tangent = tangentOf(p, i);
  vec3 t = direction.x * tangent.xyz + (direction.y * tangent.w) * cross(p.normal, tangent.xyz);
  r.tangent = safeNormalize(t - dot(t, r.normal) * r.normal, r.tangent);
}

// KHR_materials_iridescence.
void resolveFilm(inout Resolved r, uint m) {
  r.iridescence = 0.0;
  r.filmIor = materials[m].film.y;
  r.filmThickness = materials[m].film.w;
  if (!hasFeature(kFeatureIridescence, m)) return;
  r.iridescence = materials[m].film.x;
  if (hasTexture(kSlotIridescence, m)) r.iridescence *= fetch(iridescenceTexture, kSlotIridescence, m).x;
  if (hasTexture(kSlotIridescenceThickness, m)) {
    float share = fetch(iridescenceThicknessTexture, kSlotIridescenceThickness, m).y;
    r.filmThickness = mix(materials[m].film.z, materials[m].film.w, share);
  }
}

// KHR_materials_transmission, _volume, _dispersion and _diffuse_transmission. The body's thickness grows with the object as the
// cube root of its volume.
void resolveThrough(inout Resolved r, Point p) {
  uint m = p.material;
  r.transmission = r.diffuseTransmission = r.thickness = r.dispersion = 0.0;
  r.diffuseTransmissionColor = materials[m].diffuseThrough.xyz;
  r.ior = materials[m].through.y;
  r.absorption = vec3(0.0);
  if (hasFeature(kFeatureTransmission, m)) {
    r.transmission = materials[m].through.x;
    if (hasTexture(kSlotTransmission, m)) r.transmission *= fetch(transmissionTexture, kSlotTransmission, m).x;
  }
  if (hasFeature(kFeatureDiffuseTransmission, m)) {
    r.diffuseTransmission = materials[m].through.w;
    if (hasTexture(kSlotDiffuseTransmission, m))
      r.diffuseTransmission *= fetch(diffuseTransmissionTexture, kSlotDiffuseTransmission, m).w;
    if (hasTexture(kSlotDiffuseTransmissionColor, m))
      r.diffuseTransmissionColor *= fetch(diffuseTransmissionColorTexture, kSlotDiffuseTransmissionColor, m).xyz;
  }
  if (!hasFeature(kFeatureVolume, m)) return;
  vec4 rows[3] = instances[p.instance].toWorld;
  float volume = abs(dot(rows[0].xyz, cross(rows[1].xyz, rows[2].xyz)));
  r.thickness = materials[m].through.z * pow(volume, 1.0 / 3.0);
  if (hasTexture(kSlotThickness, m)) r.thickness *= fetch(thicknessTexture, kSlotThickness, m).y;
  r.absorption = materials[m].absorption.xyz;
  r.dispersion = materials[m].absorption.w;
}
#endif

Resolved resolveMaterial(Point p, uint i) {
  uint m = p.material;
  readUvs(i);
  vec4 base = materials[m].baseColor, emissiveMetallic = materials[m].emissiveMetallic;
  vec4 f0Roughness = materials[m].f0Roughness, factors = materials[m].factors;
  if (hasVertexData(kVertexColors)) base *= surfaceColor[i];
  if (hasTexture(kSlotBaseColor, m)) base *= fetch(baseColorTexture, kSlotBaseColor, m);

  Resolved r;
  r.baseColor = base.xyz;
  r.opacity = hasFeature(kFeatureBlend, m) ? clamp(base.w, 0.0, 1.0) : 1.0;
  r.metallic = emissiveMetallic.w;
  r.roughness = f0Roughness.w;
  vec4 orm = vec4(1.0);
  if (hasTexture(kSlotMetallicRoughness, m)) {
    orm = fetch(metallicRoughnessTexture, kSlotMetallicRoughness, m);
    r.metallic *= orm.z;
    r.roughness *= orm.y;
  }
  r.roughness = clamp(r.roughness, 0.0, 1.0);
  r.occlusion = 1.0;
  if (hasTexture(kSlotOcclusion, m)) {
    if ((kTextures & kOcclusionApart) != 0u) orm = fetch(occlusionTexture, kSlotOcclusion, m);
    r.occlusion = 1.0 + factors.y * (orm.x - 1.0);
  }
  r.emissive = emissiveMetallic.xyz;
  if (hasTexture(kSlotEmissive, m)) r.emissive *= fetch(emissiveTexture, kSlotEmissive, m).xyz;

  // KHR_materials_specular: F0 = min(F0(ior) specularColor, 1) specular; F90 = specular.
  r.F0 = f0Roughness.xyz;
  if (hasTexture(kSlotSpecularColor, m)) r.F0 *= fetch(specularColorTexture, kSlotSpecularColor, m).xyz;
  r.F90 = factors.z;
  if (hasTexture(kSlotSpecular, m)) r.F90 *= fetch(specularTexture, kSlotSpecular, m).w;
  r.F0 = min(r.F0, vec3(1.0)) * r.F90;
  r.normal = p.normal;
  if (hasTexture(kSlotNormal, m)) {
    vec4 texel = fetch(normalTexture, kSlotNormal, m);
    r.normal = mapNormal(p, i, texel, factors.x);
    r.roughness = widenBySpread(r.roughness, texel, factors.x);
  }
#ifdef PARITY_LOBES
  resolveCoat(r, p, i);
  resolveSheen(r, m);
  resolveAnisotropy(r, p, i);
  resolveFilm(r, m);
  resolveThrough(r, p);
#endif
  return r;
}

struct Terms {
  vec3 t[kTermCount];
};

Terms noTerms() {
  Terms terms;
  for (int k = 0; k < kTermCount; ++k) terms.t[k] = vec3(0.0);
  return terms;
}

// Behind fog (inscattered radiance, transmittance): what the other terms have left of them, and its own.
Terms seenThrough(vec4 fog, Terms terms) {
  for (int k = 0; k < kTermCount; ++k) terms.t[k] *= fog.w;
  terms.t[kTermFog] = fog.xyz;
  return terms;
}

uint groupInBin() { return gl_WorkGroupID.y * kMaxGroupsInRow + gl_WorkGroupID.x; }
uint entryInBin() { return groupInBin() * kGroupSize + gl_LocalInvocationID.x; }

// Invocations behind the bin's last entry have that one, too, and may not write: paths shade it once more. With an early
// return lavapipe would read what all invocations read alike lane by lane, as it does within branches. count > 0.
uint entryToShade() { return min(entryInBin(), count - 1u); } // in the bin
bool mayWrite() { return entryInBin() < count; }
uint surfaceEntry() { return first + entryToShade(); }

bool writesTerm(uint k) { return (kWriteTerms >> k & 1u) != 0u; }

void writeColor(uint i, vec3 color, float opacity) {
  if (mayWrite()) outColor[i] = vec4(color, opacity);
}

void writeTerms(uint i, Terms terms) {
  if (kWriteTerms == 0u || !mayWrite()) return;
  for (uint k = 0u; k < kTermsInA; ++k)
    if (writesTerm(k)) outTermsA[k * planeSize + i] = vec4(terms.t[k], 0.0);
  for (uint k = kTermsInA; k < uint(kTermCount); ++k)
    if (writesTerm(k)) outTermsB[(k - kTermsInA) * planeSize + i] = vec4(terms.t[k], 0.0);
}

// The sum of the terms, added in their order.
vec3 sumOf(Terms terms) {
  vec3 color = vec3(0.0);
  for (int k = 0; k < kTermCount; ++k) color += terms.t[k];
  return color;
}

// The colour is the sum of the terms.
void writeResult(uint i, Terms terms, float opacity) {
  writeColor(i, sumOf(terms), opacity);
  writeTerms(i, terms);
}

// Writes a picture into the plane of a term.
void writePicture(uint i, uint picture, Terms terms, float opacity) {
  if (!mayWrite()) return;
  vec4 color = vec4(sumOf(terms), opacity);
  if (picture < kTermsInA)
    outTermsA[picture * planeSize + i] = color;
  else
    outTermsB[(picture - kTermsInA) * planeSize + i] = color;
}
