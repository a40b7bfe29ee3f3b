// What the mobile path has for light that passes through (docs/mobile.md).
#ifndef PARITY_SHADING_MOBILE_TRANSMISSION
#define PARITY_SHADING_MOBILE_TRANSMISSION

#ifndef __cplusplus
#include "shading/refraction.glsl"
#endif

// The forms. alpha: as a blended surface; refracted: one fetch of the environment; mixed: that, and over it the picture behind
// thin walls.
CONSTANT int kTransmissionNone = 0;
CONSTANT int kTransmissionAlpha = 1;
CONSTANT int kTransmissionRefracted = 2;
CONSTANT int kTransmissionMixed = 3;
CONSTANT int kDiffuseTransmissionNone = 0;
CONSTANT int kDiffuseTransmissionLambert = 1;

// How much of the picture behind a thin wall is seen, [0, 1]: it is sharp, and a rough wall would blur it. The project's own.
// Roughness in [0, 1].
FN real mobileSceneShare(real Roughness) {
  PRECISE real share = R(1.0) - R(2.0) * Roughness;
  return max(share, R(0.0));
}

// Roughness of the reflection whose directions spread as much as those of light along the axis of a body: the root of
// alphaOfRefraction(Roughness^2, ior, 1 / ior). In [0, 1].
FN real mobileRefractedRoughness(real Roughness, real32 ior) {
  PRECISE real32 r = sqrt(alphaOfRefraction(real32(Roughness) * real32(Roughness), ior, R32(1.0) / ior));
  return real(r);
}

#endif
