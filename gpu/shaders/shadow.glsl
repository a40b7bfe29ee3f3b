// How much of a light comes through to a point: its shadow map under percentage-closer filtering (Reeves, Salesin and
// Cook 1987), each texel compared with the depth that the receiver's own plane has there (Isidoro 2006, "Shadow Mapping:
// GPU-based Tips and Techniques"), the point moved along its normal first (Holbert 2011, "Saying Goodbye to Shadow Acne").
// To be included behind path.glsl. kShadows, a specialization constant: 0: no light has shadows; else 1 + the width of
// the filter in texels: 0, 1, 3, 5 or 7.

#include "gpu/shaders/shadow_map.glsl"

// The move, in texels times the sine of the light's angle: for receivers that bend, and for edges between triangles.
const float kNormalOffset = 0.5;
// Of the depth, besides the error of coordinates: the map's own rounding and what the rasteriser loses.
const float kPerspectiveBias = 4e-6;
const float kOrthographicBias = 1e-6;

// Share of the texels about `at` (in texels of the layer) in which nothing is nearer to the light than the receiver,
// whose depth there is depth + dot(slope, texel - at): a box of the filter's width, cut to the fraction of a texel. A
// texel without casters holds 0, and nothing is farther than that.
float litShare(vec2 at, float layer, float inverseSide, float depth, vec2 slope) {
  const int kFilter = int(kShadows) - 1;
  if (kFilter == 0) {
    vec2 texel = floor(at);
    return texelFetch(shadowMaps, ivec3(texel, layer), 0).x <= max(depth + dot(slope, texel + 0.5 - at), 0.0) ? 1.0 : 0.0;
  }
  const int kPairs = (kFilter + 1) / 2;
  vec2 corner = floor(at - 0.5), f = at - 0.5 - corner;
  corner -= float(kPairs - 1);
  float lit = 0.0;
  for (int j = 0; j < kPairs; ++j)
    for (int i = 0; i < kPairs; ++i) {
      vec2 texel = corner + 2.0 * vec2(i, j);
      vec4 stored = textureGather(shadowMaps, vec3((texel + 1.0) * inverseSide, layer), 0);
      vec2 d = texel + 0.5 - at;
      float here = depth + dot(slope, d);
      vec4 receiver = max(vec4(here + slope.y, here + slope.x + slope.y, here + slope.x, here), vec4(0.0));
      vec2 x = vec2(i == 0 ? 1.0 - f.x : 1.0, i == kPairs - 1 ? f.x : 1.0);
      vec2 y = vec2(j == 0 ? 1.0 - f.y : 1.0, j == kPairs - 1 ? f.y : 1.0);
      lit += dot(vec4(lessThanEqual(stored, receiver)), vec4(x.x * y.y, x.y * y.y, x.y * y.x, x.x * y.x));
    }
  return lit / float(kFilter * kFilter);
}

// 0: in shadow; 1: lit. position, geometric (unit, towards the eye): of the receiver. L: unit, towards the light. A
// receiver that turns away from the light hides from it, whatever its shading normal says.
float visibilityOf(GpuLight light, vec3 position, vec3 geometric, vec3 L) {
  float cosine = dot(geometric, L);
  if (!(cosine > 0.0)) return 0.0;
  if (light.cone.z == 0.0) return 1.0;
  ShadowPoint s = shadowPointOf(light, position);
  if (!s.isSeen) return 1.0;
  GpuShadowView map = s.map;
  vec3 p = s.position;
  vec3 n = vec3(dot(map.right.xyz, geometric), dot(map.up.xyz, geometric), dot(map.forward.xyz, geometric));
  bool orthographic = isOrthographic(map);
  float texelsPerUnit = map.right.w;
  float offset = kNormalOffset * sqrt(max(1.0 - cosine * cosine, 0.0)) * (orthographic ? 1.0 : p.z) / texelsPerUnit;
  vec2 at;
  float depth;
  vec2 slope;
  if (orthographic) {
    p += offset * n;
    at = p.xy * texelsPerUnit;
    depth = 1.0 + (p.z - map.origin.w) * map.forward.w + kOrthographicBias;
    slope = n.xy * (-map.forward.w / (texelsPerUnit * min(n.z, -1e-4)));
  } else {
    // The plane's distance from the light, and 1 / distance is linear over the map.
    float plane = -dot(n, p);
    offset = min(offset, 0.5 * plane);
    p += offset * n;
    plane = max(plane - offset, 1e-3 * p.z);
    at = p.xy * (texelsPerUnit / p.z);
    depth = map.forward.w / p.z * (1.0 + kPerspectiveBias + map.origin.w / p.z);
    slope = n.xy * (-map.forward.w / (texelsPerUnit * plane));
  }
  if (max(abs(at.x), abs(at.y)) > map.tile.z - float(kShadows / 2u + 1u)) return 1.0;
  return litShare(map.tile.xy + at, map.up.w, map.tile.w, depth, slope);
}
