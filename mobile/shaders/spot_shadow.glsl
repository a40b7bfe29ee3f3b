// The one spot light's shadow map (kSpotShadow), filtered over 2 x 2 texels as UE4's mobile path does. To be included behind
// path.glsl and gpu/shaders/shadow_map.glsl.
#include "shading/mobile_shadow.glsl"

// Texels over which a receiver darkens behind its caster; how far it is moved towards the light first, against acne.
const float kTransitionTexels = 2.0;
const float kBiasTexels = 1.5;
const float kMaxSlope = 8.0;

// 1 where the light has no map.
real spotShadow(GpuLight light, Point p) {
  if (light.cone.z == 0.0) return R(1.0);
  ShadowPoint s = shadowPointOf(light, p.position);
  if (!s.isSeen) return R(1.0);
  float texel = s.position.z / s.map.right.w; // metres
  // How much the receiver's plane falls off over a texel, in texels.
  vec3 n = vec3(dot(s.map.right.xyz, p.geometric), dot(s.map.up.xyz, p.geometric), dot(s.map.forward.xyz, p.geometric));
  float slope = min((abs(n.x) + abs(n.y)) * s.position.z / max(-dot(n, s.position), 1e-3 * s.position.z), kMaxSlope);
  float sceneDepth = s.position.z - kBiasTexels * texel * (1.0 + slope);
  vec2 at = s.map.tile.xy + s.position.xy * (s.map.right.w / s.position.z);
  vec2 corner = floor(at - 0.5), f = at - 0.5 - corner;
  vec4 stored = textureGather(shadowMaps, vec3((corner + 1.0) * s.map.tile.w, s.map.up.w), 0);
  real lit[4];
  for (int k = 0; k < 4; ++k) // a texel of nothing holds 0
    lit[k] = stored[k] > 0.0
                 ? shadowmapOcclusion(s.map.forward.w / stored[k], sceneDepth, 1.0 / (kTransitionTexels * texel))
                 : R(1.0);
  real u = real(f.x), v = real(f.y);
  PRECISE real below = lit[3] + (lit[2] - lit[3]) * u;
  PRECISE real above = lit[0] + (lit[1] - lit[0]) * u;
  PRECISE real Shadow = below + (above - below) * v;
  return sharpenedShadow(Shadow, R(1.0), R(1.0));
}
