// Reads of a prefiltered environment away from N = V = R: where to look, and how blurred.
//
// A cube prefiltered for N = V = R holds rotationally symmetric lobes around the mirror direction. The lobe of GGX leans
// towards the normal, is longer than wide and ends at the horizon; taking one for the other is the largest error of the
// split sum (docs/shading.md 6b: 58 % relative RMSE at roughness .5 and NoV .3). Each tap here is a read of that
// cube in the direction normalize(mix(N, R, blend)) at a mip, with a weight; the weights add up to 1.
#ifndef PARITY_SHADING_OFF_SPECULAR
#define PARITY_SHADING_OFF_SPECULAR

#include "shading/mips.glsl"
#include "shading/real.glsl"

struct LobeTap {
  real blend;  // 0: the normal, 1: the mirror direction; may lie beyond either
  real mip;    // of the prefiltered cube, at most 5; below 0 for what is smoother than mip 0
  real weight; // [0, 1]
};

// Share of the mirror direction in the GGX lobe's dominant direction:
//   (1 - alpha) (sqrt(1 - alpha) + alpha)
// Lagarde and de Rousiers 2014 ("Moving Frostbite to Physically Based Rendering", listing 22). alpha in [0, 1].
FN real dominantBlend(real alpha) {
  PRECISE real smoothness = R(1.0) - alpha;
  PRECISE real blend = smoothness * (sqrt(smoothness) + alpha);
  return blend;
}

// c0 + c1 N + c2 N^2 + c3 R + c4 R N + c5 R^2
FN real lobePolynomial(real N, real Roughness, real c0, real c1, real c2, real c3, real c4, real c5) {
  PRECISE real p = c0 + N * (c1 + c2 * N) + Roughness * (c3 + c4 * N + c5 * Roughness);
  return p;
}

FN LobeTap makeLobeTap(real Roughness, real lean, real mipOffset, real weight) {
  LobeTap tap;
  PRECISE real blend = R(1.0) - Roughness * Roughness * lean;
  PRECISE real mip = unclampedMip(Roughness) + mipOffset;
  tap.blend = blend;
  tap.mip = min(mip, real(kPrefilterRoughestMip));
  tap.weight = weight;
  return tap;
}

// The coefficients of the three functions below are fitted to the height-correlated lobe at F = 1 (bench/fit_lobe_taps.cpp):
// over natural environments, whose power falls off as (l + 1/2)^-2.5 in spherical harmonics (Dror et al. 2004), the mean
// square error over roughness 0.1 to 1 and NoV 0.04 to 0.99 is least. That error, relative to one read in the dominant
// direction of Lagarde and de Rousiers: see tests/shading/off_specular_test.cpp. NoV, Roughness in [0, 1].

// Tap i (0, 1) of two alike, in front of and behind the lobe's middle: a lookup stretched along the plane of incidence.
FN LobeTap stretchedTap(int i, real NoV, real Roughness) {
  real lean = lobePolynomial(NoV, Roughness, R(0.9196), R(-3.2503), R(1.1663), R(1.9350), R(1.7287), R(-1.2695));
  real spread = lobePolynomial(NoV, Roughness, R(1.4088), R(-0.1085), R(1.4872), R(-1.9448), R(-1.6611), R(1.5925));
  real mip = lobePolynomial(NoV, Roughness, R(-0.8826), R(0.2488), R(0.6165), R(0.9339), R(-0.6975), R(0.2773));
  return makeLobeTap(Roughness, i == 0 ? lean + spread : lean - spread, mip, R(0.5));
}

// Tap i (0, 1) of two: a wide one near the normal, a narrow one near the mirror direction.
FN LobeTap twoTap(int i, real NoV, real Roughness) {
  real w = saturate(lobePolynomial(NoV, Roughness, R(0.2134), R(-0.2496), R(1.0027), R(0.5036), R(-0.9497), R(0.1791)));
  if (i == 0) {
    real lean = lobePolynomial(NoV, Roughness, R(3.6989), R(-2.8216), R(-1.1560), R(-1.3150), R(4.2741), R(-1.2442));
    real mip = lobePolynomial(NoV, Roughness, R(-0.7229), R(-0.1376), R(0.6652), R(2.3394), R(-1.2927), R(-0.0948));
    return makeLobeTap(Roughness, lean, mip, w);
  }
  real lean = lobePolynomial(NoV, Roughness, R(0.2395), R(-3.6758), R(-1.0128), R(3.1380), R(4.9176), R(-3.2695));
  real mip = lobePolynomial(NoV, Roughness, R(-0.6333), R(0.7682), R(0.1930), R(-1.6122), R(-0.4843), R(2.1424));
  return makeLobeTap(Roughness, lean, mip, R(1.0) - w);
}

// Tap i (0, 1, 2) of three, from the normal to the mirror direction.
FN LobeTap threeTap(int i, real NoV, real Roughness) {
  real w = saturate(lobePolynomial(NoV, Roughness, R(0.0939), R(-0.5231), R(0.5741), R(0.6033), R(-0.4456), R(0.1984)));
  real v = saturate(lobePolynomial(NoV, Roughness, R(0.3761), R(0.1262), R(0.9141), R(-0.2393), R(-1.1901), R(1.1501)));
  real rest = R(1.0) - w;
  if (i == 0) {
    real lean = lobePolynomial(NoV, Roughness, R(7.0413), R(-0.8935), R(-0.2359), R(-9.7266), R(1.8344), R(3.8547));
    real mip = lobePolynomial(NoV, Roughness, R(-0.2822), R(-0.0907), R(0.1311), R(2.7163), R(0.1935), R(-1.7665));
    return makeLobeTap(Roughness, lean, mip, w);
  }
  if (i == 1) {
    real lean = lobePolynomial(NoV, Roughness, R(2.2777), R(-1.9183), R(-1.8268), R(-0.9681), R(4.0994), R(-1.3967));
    real mip = lobePolynomial(NoV, Roughness, R(-1.4292), R(1.7663), R(-0.2942), R(0.2954), R(-0.9144), R(1.0718));
    return makeLobeTap(Roughness, lean, mip, rest * v);
  }
  real lean = lobePolynomial(NoV, Roughness, R(-0.2529), R(-5.4903), R(-0.4012), R(4.5968), R(6.6926), R(-4.8456));
  real mip = lobePolynomial(NoV, Roughness, R(-1.3575), R(1.8193), R(0.4041), R(-0.0818), R(-1.7934), R(0.2594));
  return makeLobeTap(Roughness, lean, mip, rest * (R(1.0) - v));
}

#endif
