// Where a point lies in a light's shadow map. To be included behind path.glsl.

uint cubeFace(vec3 d) {
  vec3 a = abs(d);
  if (a.x >= a.y && a.x >= a.z) return d.x < 0.0 ? 1u : 0u;
  if (a.y >= a.z) return d.y < 0.0 ? 3u : 2u;
  return d.z < 0.0 ? 5u : 4u;
}

struct ShadowPoint {
  bool isSeen; // there is a map, and the point is not behind it
  GpuShadowView map;
  vec3 position; // from the map's origin: to the right, up, forward; metres
};

bool isOrthographic(GpuShadowView map) { return map.forward.w < 0.0; }

// light.cone.z: not 0.
ShadowPoint shadowPointOf(GpuLight light, vec3 position) {
  uint index = uint(light.cone.z) - 1u;
  if (light.cone.w > 1.0) index += cubeFace(position - light.positionKind.xyz);
  ShadowPoint s;
  s.map = shadowViews[index];
  vec3 d = position - s.map.origin.xyz;
  s.position = vec3(dot(s.map.right.xyz, d), dot(s.map.up.xyz, d), dot(s.map.forward.xyz, d));
  s.isSeen = s.map.tile.z != 0.0 && (isOrthographic(s.map) || s.position.z > 0.0);
  return s;
}
