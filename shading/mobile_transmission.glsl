// What the mobile path has for light that passes through (docs/mobile.md).
#ifndef PARITY_SHADING_MOBILE_TRANSMISSION
#define PARITY_SHADING_MOBILE_TRANSMISSION

#ifndef __cplusplus
#include "shading/real.glsl"
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

#endif
