// The scene's fog as a view's shader evaluates it. Include after the declaration of `view`.
#include "shading/fog.glsl"

// Between the eye (orthographic: the plane of the eye) and a place of the world: inscattered radiance, transmittance.
vec4 fogAt(vec3 place) {
  vec3 fromEye = place - view.eye.xyz, direction = normalize(view.direction.xyz);
  vec3 way = mix(fromEye, max(dot(fromEye, direction), 0.0) * direction, bvec3(view.eye.w > 0.5));
  HeightFog fog = HeightFog(view.fog.x, view.fog.y, view.fog.z, view.fog.w, view.fogColor.w);
  float transmittance = float(heightFogTransmittance(fog, place.y - way.y, way.y, length(way)));
  return vec4(view.fogColor.xyz * (1.0 - transmittance), transmittance);
}
