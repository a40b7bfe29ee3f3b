// Environment captures: where a reflected direction looks in one, how much each of several counts at a point, and how one
// follows the baked light. Both paths.
#ifndef PARITY_SHADING_CAPTURE
#define PARITY_SHADING_CAPTURE

#include "shading/real.glsl"

// What the environment's reflection is multiplied with besides SkyLightColor (captureScale).
CONSTANT int kCaptureScaleSky = 0;
CONSTANT int kCaptureScaleMixing = 1;
CONSTANT int kCaptureScaleFull = 2;
CONSTANT int kCaptureScaleOcclusion = 3;

// Where the mixing weight begins and where it is whole, in roughness; the largest weight. Unreal Engine 4's defaults (the
// console variables r.ReflectionEnvironmentBeginMixingRoughness and EndMixingRoughness, .1 and .3; and its largest weight).
CONSTANT real32 kMixingBegin = R32(0.1);
CONSTANT real32 kMixingEnd = R32(0.3);
CONSTANT real32 kMixingLargest = R32(10000.0);

// The engine's ReflectionEnvironmentRoughnessMixingScaleBiasAndLargestWeight: a uniform, at least fp32 in every precision.
struct MixingRange {
  real32 scale, bias, largest;
};

//   scale = 1 / (end - begin),  bias = -begin scale      (docs/shading.md 7d)
// Roughness 0 <= begin < end <= 1; largest above 0.
FN MixingRange mixingRange(real32 begin, real32 end, real32 largest) {
  MixingRange range;
  PRECISE real32 scale = R32(1.0) / (end - begin);
  PRECISE real32 bias = -begin * scale;
  range.scale = scale;
  range.bias = bias;
  range.largest = largest;
  return range;
}

// How much of the weight a roughness takes, in [0, 1]:
//   smoothstep(0, 1, saturate(Roughness scale + bias))
// The argument of the step in fp32, as its uniforms are; the step in the working precision.
FN real mixingAlpha(real Roughness, MixingRange range) {
  PRECISE real32 x32 = real32(Roughness) * range.scale + range.bias;
  real x = real(min(max(x32, R32(0.0)), R32(1.0)));
  PRECISE real s = x * x * (R(3.0) - R(2.0) * x);
  return s;
}

// What the environment's reflection is multiplied with, so that it follows the baked light ("they are similarly normalized
// and scaled by the lightmap", Karis 2014). With w = IndirectIrradiance / averageBrightness,
//   kCaptureScaleSky        1: the cube is the skylight
//   kCaptureScaleMixing     lerp(1, min(w, largest), mixingAlpha): UE4's ComputeMixingWeight, for scene
//                           captures (docs/shading.md 7d)
//   kCaptureScaleFull       w
//   kCaptureScaleOcclusion  MaterialAO, as the high-end path has it
// IndirectIrradiance: luminance of the indirect diffuse light over pi, material AO included. averageBrightness: of the
// capture, as UE4 cut off below 1e-4. In fp32, and saturating: a black capture's 0 must not become 0 times infinity.
FN real captureScale(int mode, real IndirectIrradiance, real32 averageBrightness, real Roughness, real MaterialAO,
                     MixingRange mixing) {
  if (mode == kCaptureScaleSky) return R(1.0);
  if (mode == kCaptureScaleOcclusion) return MaterialAO;
  PRECISE real32 w32 = real32(IndirectIrradiance) / max(averageBrightness, R32(1e-4));
  if (mode == kCaptureScaleFull) return narrow(w32);
  real w = narrow(min(w32, mixing.largest));
  real s = mixingAlpha(Roughness, mixing);
  PRECISE real scale = (R(1.0) - s) + w * s;
  return scale;
}

// The nearest that a capture counts as, m: keeps its weight finite where it was taken.
CONSTANT real32 kMinCaptureDistance = R32(1e-3);

// Weight of a capture among several, 1/m^2, before they are normalised (modified Shepard; Franke and Nielson 1980):
//   (max(0, R - d) / (R d))^2 = (max(0, 1 - d/R) / d)^2
// Distance d from where it was taken: metres, finite, >= 0, below kMinCaptureDistance taken as that. Radius R > 0, may be
// infinite; 0: no weight. 1e6 at most.
FN real32 captureWeight(real32 d, real32 radius) {
  if (radius > R32(0.0)) {
    PRECISE real32 share = R32(1.0) - d / radius;
    PRECISE real32 w = max(share, R32(0.0)) / max(d, kMinCaptureDistance);
    PRECISE real32 squared = w * w;
    return squared;
  }
  return R32(0.0);
}

// How far along a unit direction a wall of the box is, on one axis; what is parallel to it never gets there.
FN real32 wallDistance(real32 position, real32 direction, real32 lower, real32 upper) {
  if (direction > R32(0.0)) {
    PRECISE real32 t = (upper - position) / direction;
    return t;
  }
  if (direction < R32(0.0)) {
    PRECISE real32 t = (lower - position) / direction;
    return t;
  }
  return R32(3.40282347e38);
}

// The direction in which a capture shows what is seen from `position` along `direction`, if it lies on the walls of the box
// that the capture stands for (Lagarde and Zanuttini 2012, "Local Image-Based Lighting With Parallax-Corrected Cubemaps"):
//   p + t direction - origin,  t: to the first wall
// unit. position, origin (where the capture was taken, inside of the box), lower, upper: world, metres, finite, up to 1e6.
// direction: unit; returned as it is where the position lies outside of the box.
FN real32x3 boxParallax(real32x3 position, real32x3 direction, real32x3 lower, real32x3 upper, real32x3 origin) {
  if (position.x >= lower.x && position.y >= lower.y && position.z >= lower.z && position.x <= upper.x &&
      position.y <= upper.y && position.z <= upper.z) {
    real32 t = min(min(wallDistance(position.x, direction.x, lower.x, upper.x),
                       wallDistance(position.y, direction.y, lower.y, upper.y)),
                   wallDistance(position.z, direction.z, lower.z, upper.z));
    PRECISE real32x3 seen = real32x3(position.x + t * direction.x - origin.x, position.y + t * direction.y - origin.y,
                                     position.z + t * direction.z - origin.z);
    return safeNormalize(seen, direction);
  }
  return direction;
}

#endif
