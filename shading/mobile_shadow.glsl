// The shadow of a spot light on mobile: AccumulateLightingOfDynamicPointLight under SUPPORT_SPOTLIGHTS_SHADOW (UE4's mobile
// base pass as the seed article of 2020 prints its parameters: SoftTransitionScale, SpotLightShadowSharpenAndShadowFadeFraction).
// The article does not print the bodies: these are UE4's CalculateOcclusion of ShadowFilteringCommon.ush and the lines that
// follow it in the base pass, from memory.
#ifndef PARITY_SHADING_MOBILE_SHADOW
#define PARITY_SHADING_MOBILE_SHADOW

#include "shading/real.glsl"

// Share of light that one texel of the map lets through, with a soft transition by how far the receiver lies behind it:
//   saturate((ShadowmapDepth - SceneDepth) TransitionScale + 1)
// Depths: from the light, in metres, >= 0, finite (the difference is taken in real32); TransitionScale: 1 / metres, > 0.
FN real shadowmapOcclusion(real32 ShadowmapDepth, real32 SceneDepth, real32 TransitionScale) {
  PRECISE real32 x = (ShadowmapDepth - SceneDepth) * TransitionScale + R32(1.0);
  return real(max(min(x, R32(1.0)), R32(0.0)));
}

// What the filtered share becomes:
//   S = saturate((Shadow - 0.5) Sharpen + 0.5);  lerp(1, S^2, FadeFraction)
// Shadow, FadeFraction in [0, 1]; Sharpen >= 0.
FN real sharpenedShadow(real Shadow, real Sharpen, real FadeFraction) {
  PRECISE real x = (Shadow - R(0.5)) * Sharpen + R(0.5);
  PRECISE real s = saturate(x);
  PRECISE real darker = s * s - R(1.0);
  PRECISE real faded = R(1.0) + FadeFraction * darker;
  return faded;
}

#endif
