// Specular anti-aliasing of normal maps: what a mip's averaging hides of the normals comes back as roughness.
#ifndef PARITY_SHADING_SPECULAR_AA
#define PARITY_SHADING_SPECULAR_AA

#include "shading/real.glsl"

// By how much alpha^2 grows, in [0, 1], where the mean of unit normals has this length, in [0, 1]:
//   sigma^2 = (1 - |n|) / |n|,  2 sigma^2
// Toksvig 2005, "Mipmapping Normal Maps", eq. 2: the variance of the slopes along each axis. alpha^2 is twice that
// variance in Beckmann's distribution, and convolving adds variances (Olano and Baker 2010, "LEAN Mapping", section 3),
// so alpha'^2 = alpha^2 + 2 sigma^2; taken over to GGX as Tokuyoshi and Kaplanyan 2019 do ("Improved Geometric Specular
// Antialiasing"). Their upper bound of 0.18 is for variances estimated from screen-space derivatives; here they are
// measured, and over slopes of sigma 0.6 the bound shows three times the light that more pixels show, none 1.3 times.
// What it deviates by: GGX has longer tails than normals that are spread like a Gaussian, so beside a highlight of a
// smooth surface it is too bright; a spread of two directions, or along one axis, becomes round.
FN real alphaSquaredOfNormals(real length) {
  PRECISE real grown = (R(2.0) - length * R(2.0)) / max(length, kSmallest);
  return saturate(grown);
}

// Perceptual roughness, in [0, 1], after alpha^2 has grown:
//   R' = (min(R^4 + grown, 1))^(1/4)
// grown in [0, 1]; 0 leaves R as it is, to the last bit. In at least fp32 whatever the path's precision: alpha^2 of half
// is a denormal for R <= 0.088, and the widening is to be alike in every path.
FN real32 widenRoughness(real32 Roughness, real32 grown) {
  if (!(grown > R32(0.0))) return Roughness;
  PRECISE real32 alpha = Roughness * Roughness;
  PRECISE real32 a2 = alpha * alpha + grown;
  PRECISE real32 wider = sqrt(sqrt(min(a2, R32(1.0))));
  return max(wider, Roughness);
}

#endif
