// The shadow maps of the one spot light and of the sun (kShadowMaps), filtered over 2 x 2 texels as UE4's mobile path
// does. To be included behind path.glsl and gpu/shaders/shadow_map.glsl.
#include "shading/mobile_shadow.glsl"

// Bits of kShadowMaps (mobile/renderer.cpp).
const uint kShadowOfSpot = 1u;
const uint kShadowOfSun = 2u;

// Texels over which a receiver darkens behind its caster; how far it is moved towards the light first, against acne.
const float kTransitionTexels = 2.0;
const float kBiasTexels = 1.5;
const float kMaxSlope = 8.0;

// Share of the light that comes through; 1 where the light has no map, or beyond it.
real filteredShadow(GpuLight light, Point p) {
  if (light.cone.z == 0.0) return R(1.0);
  ShadowPoint s = shadowPointOf(light, p.position);
  if (!s.isSeen) return R(1.0);
  bool orthographic = isOrthographic(s.map);
  float distance = orthographic ? 1.0 : s.position.z; // at which a texel is as wide as its map says
  float texel = distance / s.map.right.w;             // metres
  vec2 place = s.position.xy / texel;
  if (max(abs(place.x), abs(place.y)) > s.map.tile.z - 1.0) return R(1.0);
  // How much the receiver's plane falls off over a texel, in texels.
  vec3 n = vec3(dot(s.map.right.xyz, p.geometric), dot(s.map.up.xyz, p.geometric), dot(s.map.forward.xyz, p.geometric));
  float facing = orthographic ? -n.z : -dot(n, s.position);
  float slope = min((abs(n.x) + abs(n.y)) * distance / max(facing, 1e-3 * distance), kMaxSlope);
  float sceneDepth = s.position.z - kBiasTexels * texel * (1.0 + slope);
  vec2 at = s.map.tile.xy + place;
  vec2 corner = floor(at - 0.5), f = at - 0.5 - corner;
  vec4 stored = textureGather(shadowMaps, vec3((corner + 1.0) * s.map.tile.w, s.map.up.w), 0);
  real lit[4];
  for (int k = 0; k < 4; ++k) { // a texel of nothing holds 0
    float casterDepth = orthographic ? (stored[k] - 1.0) / s.map.forward.w : s.map.forward.w / stored[k];
    lit[k] = stored[k] > 0.0 ? shadowmapOcclusion(casterDepth, sceneDepth, 1.0 / (kTransitionTexels * texel)) : R(1.0);
  }
  real u = real(f.x), v = real(f.y);
  PRECISE real below = lit[3] + (lit[2] - lit[3]) * u;
  PRECISE real above = lit[0] + (lit[1] - lit[0]) * u;
  PRECISE real Shadow = below + (above - below) * v;
  return Shadow;
}

real spotShadow(GpuLight light, Point p) {
  return sharpenedShadow(filteredShadow(light, p), real(view.path[kPathShadows].z), real(view.path[kPathShadows].w));
}

real sunShadow(GpuLight light, Point p) {
  DistanceFade MAD = DistanceFade(view.path[kPathShadows].x, view.path[kPathShadows].y);
  return distanceFadedShadow(filteredShadow(light, p), dot(view.forward.xyz, p.position) - view.forward.w, MAD);
}
