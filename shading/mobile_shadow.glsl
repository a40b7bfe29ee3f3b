// Shadows by shadow maps on mobile: of a spot light, AccumulateLightingOfDynamicPointLight under SUPPORT_SPOTLIGHTS_SHADOW, and
// of the sun, DIRECTIONAL_LIGHT_CSM. UE4's mobile base pass as the listing of 2020 prints their parameters:
// SoftTransitionScale, SpotLightShadowSharpenAndShadowFadeFraction, DirectionalLightDistanceFadeMADAndSpecularScale (of which
// it prints the use of .z alone). The article does not print the bodies: these are UE4's CalculateOcclusion of
// ShadowFilteringCommon.ush and the lines that follow it in the base pass, from memory.
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

// What the filtered share of a spot light becomes:
//   S = saturate((Shadow - 0.5) Sharpen + 0.5);  lerp(1, S^2, FadeFraction)
// Shadow, FadeFraction in [0, 1]; Sharpen >= 0: the engine's is 1 + 7 ShadowSharpen of the light, from 1 to 8; its
// FadeFraction falls from 1 to 0 where the map would have few texels.
FN real sharpenedShadow(real Shadow, real Sharpen, real FadeFraction) {
  PRECISE real x = (Shadow - R(0.5)) * Sharpen + R(0.5);
  PRECISE real s = saturate(x);
  PRECISE real darker = s * s - R(1.0);
  PRECISE real faded = R(1.0) + FadeFraction * darker;
  return faded;
}

// DirectionalLightDistanceFadeMAD: what a depth is multiplied with, and what is added, to be 0 where the sun's shadow
// begins to fade and 1 where it is gone:
//   Near = Far - Far FadeFraction,  x = 1 / (Far - Near),  y = -Near x
// GetDirectionalLightDistanceFadeParameters of the engine, from memory. Far: metres, > 0; FadeFraction (its
// ShadowDistanceFadeoutFraction, .1) in [0, 1]. max(., 1e-6 m): the engine's KINDA_SMALL_NUMBER of centimetres, so that a
// fraction of 0 is an edge at Far and not 0/0.
struct DistanceFade {
  real32 x;
  real32 y;
};
FN DistanceFade distanceFadeMAD(real32 Far, real32 FadeFraction) {
  DistanceFade MAD;
  PRECISE real32 length = Far * FadeFraction;
  PRECISE real32 near = Far - length;
  PRECISE real32 scale = R32(1.0) / max(length, R32(1e-6));
  PRECISE real32 offset = R32(0.0) - near * scale;
  MAD.x = scale;
  MAD.y = offset;
  return MAD;
}

// The sun's filtered share with its distance fade:
//   Fade = saturate(SceneDepth MAD.x + MAD.y);  lerp(ShadowMap, 1, Fade^2)
// ShadowMap in [0, 1]; SceneDepth: along the camera's axis (ScreenPosition.w), metres, in fp32 as in the engine.
FN real distanceFadedShadow(real ShadowMap, real32 SceneDepth, DistanceFade MAD) {
  PRECISE real32 x = SceneDepth * MAD.x + MAD.y;
  PRECISE real32 clamped = max(min(x, R32(1.0)), R32(0.0));
  PRECISE real32 fade = clamped * clamped;
  PRECISE real share = real(fade);
  PRECISE real faded = ShadowMap + (R(1.0) - ShadowMap) * share;
  return faded;
}

#endif
