// Visibility to surface: intersects each listed pixel's ray with its triangle, interpolates the attributes there, and
// differentiates the uvs in texture space by the exact ray differentials of the pixel (Igehy 1999).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/geometry.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kVertexData = 0u; // kVertex... bits

layout(set = 0, binding = 7, std430) readonly buffer Entries { uvec4 entries[]; }; // x | y << 16, instance, triangle, 0
layout(set = 0, binding = 8, std140) uniform View { GpuView view; };
#define PARITY_SURFACE_ACCESS writeonly
#define PARITY_SURFACE_BINDING 9
#include "gpu/shaders/surface.glsl"
layout(set = 0, binding = 18, std430) readonly buffer LightmapCorners { vec2 lightmapCorners[]; }; // of triangles, in order
#include "gpu/shaders/fog.glsl"

layout(push_constant) uniform Push {
  uint count;
  float jitterX, jitterY; // of the sample in the pixel, [0,1)
};

vec3 safeNormal(vec3 n, vec3 fallback) {
  float l2 = dot(n, n);
  return l2 > 0.0 && l2 < 3e38 ? n * inversesqrt(l2) : fallback; // a comparison with NaN is false
}

void main() {
  uint i = (gl_WorkGroupID.y * kMaxGroupsInRow + gl_WorkGroupID.x) * kGroupSize + gl_LocalInvocationID.x;
  if (i >= count) return;
  uvec4 entry = entries[i];
  float x = float(entry.x & 0xffffu) + jitterX, y = float(entry.x >> 16) + jitterY;
  GpuInstance instance = instances[entry.y];
  uint first = instance.geometry.x + 3u * entry.z;
  uint i0 = instance.geometry.y + indices[first], i1 = instance.geometry.y + indices[first + 1u],
       i2 = instance.geometry.y + indices[first + 2u];

  // Moller and Trumbore 1997, relative to the eye: u = P.T/det, v = d.Q/det, with P = d x e2, T = o - v0, Q = T x e1.
  vec3 v0 = transformPoint(instance.toWorld, positionOf(i0)) - view.eye.xyz;
  vec3 e1 = transformPoint(instance.toWorld, positionOf(i1)) - view.eye.xyz - v0;
  vec3 e2 = transformPoint(instance.toWorld, positionOf(i2)) - view.eye.xyz - v0;
  vec3 o = view.origin.xyz + x * view.originX.xyz + y * view.originY.xyz;
  vec3 d = view.direction.xyz + x * view.directionX.xyz + y * view.directionY.xyz;
  vec3 P = cross(d, e2), T = o - v0, Q = cross(T, e1);
  float det = dot(e1, P);
  float rcpDet = det != 0.0 ? 1.0 / det : 0.0; // a triangle seen edge-on: its first vertex
  float u = dot(P, T) * rcpDet, v = dot(d, Q) * rcpDet;

  vec3 P_x = cross(view.directionX.xyz, e2), P_y = cross(view.directionY.xyz, e2);
  float det_x = dot(e1, P_x), det_y = dot(e1, P_y);
  float u_x = (dot(P_x, T) + dot(P, view.originX.xyz) - u * det_x) * rcpDet;
  float u_y = (dot(P_y, T) + dot(P, view.originY.xyz) - u * det_y) * rcpDet;
  float v_x = (dot(view.directionX.xyz, Q) + dot(d, cross(view.originX.xyz, e1)) - v * det_x) * rcpDet;
  float v_y = (dot(view.directionY.xyz, Q) + dot(d, cross(view.originY.xyz, e1)) - v * det_y) * rcpDet;

  // A pixel centre may lie a rounding outside its triangle: attributes are not extrapolated.
  float uc = clamp(u, 0.0, 1.0), vc = clamp(v, 0.0, 1.0 - uc), wc = 1.0 - uc - vc;

  vec3 geometric = safeNormal(cross(e1, e2) * instance.normalToWorld[0].w, safeNormal(-d, vec3(0.0, 0.0, 1.0)));
  // A back face (only double-sided materials show one) turns its whole frame round: normal, tangent and bitangent.
  float side = dot(geometric, d) > 0.0 ? -1.0 : 1.0;
  geometric *= side;
  vec3 normal = transformVector(instance.normalToWorld, wc * normalOf(i0) + uc * normalOf(i1) + vc * normalOf(i2));
  normal = safeNormal(side * normal, geometric);

  // As a vertex shader does it, so that a coarse mesh shows it coarsely; the barycentrics are perspective-correct.
  if ((kVertexData & kVertexFog) != 0u) surfaceFog[i] = wc * fogAt(v0 + view.eye.xyz) + uc * fogAt(v0 + e1 + view.eye.xyz) + vc * fogAt(v0 + e2 + view.eye.xyz);
  vec3 position = v0 + uc * e1 + vc * e2 + view.eye.xyz;
  surfacePosition[i] = uvec4(floatBitsToUint(position), entry.y);
  surfaceNormal[i] = uvec4(floatBitsToUint(normal), packOctahedral(geometric));
  if ((kVertexData & kVertexColors) != 0u) surfaceColor[i] = wc * colors[i0] + uc * colors[i1] + vc * colors[i2];
  if ((kVertexData & kVertexUvs) != 0u) {
    vec4 uv0 = uvs[i0], du = uvs[i1] - uv0, dv = uvs[i2] - uv0;
    surfaceUv[i] = uv0 + uc * du + vc * dv;
    vec4 uv_x = u_x * du + v_x * dv, uv_y = u_y * du + v_y * dv;
    surfaceUv0Derivatives[i] = vec4(uv_x.xy, uv_y.xy);
    if ((kVertexData & kVertexSecondUv) != 0u) surfaceUv1Derivatives[i] = vec4(uv_x.zw, uv_y.zw);
  }
  if ((kVertexData & kVertexLightmap) != 0u) {
    vec2 uv = vec2(0.0);
    if (instance.baked.y != 0u) {
      uint corner = instance.baked.x + 3u * entry.z;
      uv = wc * lightmapCorners[corner] + uc * lightmapCorners[corner + 1u] + vc * lightmapCorners[corner + 2u];
      uv += instance.lightmap.xy;
    }
    surfaceLightmap[i] = vec4(uv, float(instance.baked.y), side);
  }
  if ((kVertexData & kVertexTangents) != 0u) {
    vec3 t = transformVector(instance.toWorld, wc * tangents[i0].xyz + uc * tangents[i1].xyz + vc * tangents[i2].xyz);
    // bitangent = w * cross(n, t): turning n and t round leaves it, so w turns too. A mirroring transform turns the cross product.
    float w = tangents[i0].w * side * instance.normalToWorld[0].w;
    surfaceTangent[i] = vec4(side * safeNormal(t, vec3(0.0)), w);
  }
}
