// How a local light of a path fades. To be included behind path.glsl and kFalloffs, a specialization constant: bits of
// what the scene's lights have (interface.h).

// kFalloff... of shading/light.glsl: known at compile time where all lights are alike.
int falloffOf(GpuLight light) {
  if (kFalloffs == 1u << kFalloffKhr) return kFalloffKhr;
  if (kFalloffs == 1u << kFalloffUE4) return kFalloffUE4;
  if (kFalloffs == 1u << kFalloffExponent) return kFalloffExponent;
  return int(light.falloff.x);
}
