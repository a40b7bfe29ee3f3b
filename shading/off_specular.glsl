// Reads of a prefiltered environment away from N = V = R: where to look, and how blurred.
//
// A cube prefiltered for N = V = R holds rotationally symmetric lobes around the mirror direction. The lobe of GGX leans
// towards the normal, is longer than wide and ends at the horizon; taking one for the other is the largest error of the
// split sum (SHADING 6: 58 % relative RMSE at roughness .5 and NoV .3). Each tap here is a read of that cube in the
// direction normalize(mix(N, R, blend)) at a mip, with a weight; the weights add up to 1.
#ifndef PARITY_SHADING_OFF_SPECULAR
#define PARITY_SHADING_OFF_SPECULAR

#include "shading/mips.glsl"
#include "shading/real.glsl"

struct LobeTap {
  real blend;  // 0: the normal, 1: the mirror direction; may lie beyond either
  real mip;    // of the prefiltered cube, [0, 5]
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
  tap.mip = max(min(mip, real(kPrefilterRoughestMip)), R(0.0));
  tap.weight = weight;
  return tap;
}

// The coefficients of the three functions below are fitted to the height-correlated lobe at F = 1 (bench/fit_lobe_taps.cpp):
// over natural environments, whose power falls off as (l + 1/2)^-2.5 in spherical harmonics (Dror et al. 2004), the mean
// square error over roughness 0.1 to 1 and NoV 0.04 to 0.99 is least. That error, relative to one read in the dominant
// direction of Lagarde and de Rousiers: see tests/shading/off_specular_test.cpp. NoV, Roughness in [0, 1].

// Tap i (0, 1) of two alike, in front of and behind the lobe's middle: a lookup stretched along the plane of incidence.
FN LobeTap stretchedTap(int i, real NoV, real Roughness) {
  real lean = lobePolynomial(NoV, Roughness, R(0.9231), R(-3.2466), R(1.1710), R(1.9002), R(1.7233), R(-1.2402));
  real spread = lobePolynomial(NoV, Roughness, R(1.3447), R(-0.1010), R(1.5337), R(-1.8684), R(-1.7172), R(1.5857));
  real mip = lobePolynomial(NoV, Roughness, R(-0.8941), R(0.1435), R(0.6757), R(0.9519), R(-0.6116), R(0.3765));
  return makeLobeTap(Roughness, i == 0 ? lean + spread : lean - spread, mip, R(0.5));
}

// Tap i (0, 1) of two: a wide one near the normal, a narrow one near the mirror direction.
FN LobeTap twoTap(int i, real NoV, real Roughness) {
  real w = saturate(lobePolynomial(NoV, Roughness, R(0.3411), R(0.1572), R(0.6737), R(0.1062), R(-1.0587), R(0.4283)));
  if (i == 0) {
    real lean = lobePolynomial(NoV, Roughness, R(2.8612), R(-3.6892), R(-0.0280), R(0.6544), R(4.0643), R(-2.2392));
    real mip = lobePolynomial(NoV, Roughness, R(-0.5037), R(-0.5482), R(0.9258), R(1.5884), R(-1.0882), R(0.6632));
    return makeLobeTap(Roughness, lean, mip, w);
  }
  real lean = lobePolynomial(NoV, Roughness, R(0.0457), R(-4.3565), R(-1.1449), R(3.9264), R(5.8192), R(-3.9779));
  real mip = lobePolynomial(NoV, Roughness, R(-0.8946), R(0.5034), R(0.6361), R(-1.0681), R(-0.6430), R(1.9841));
  return makeLobeTap(Roughness, lean, mip, R(1.0) - w);
}

// Tap i (0, 1, 2) of three, from the normal to the mirror direction.
FN LobeTap threeTap(int i, real NoV, real Roughness) {
  real w = saturate(lobePolynomial(NoV, Roughness, R(0.1214), R(-0.6256), R(0.8476), R(0.7602), R(-0.5394), R(-0.0392)));
  real v = saturate(lobePolynomial(NoV, Roughness, R(0.4288), R(0.2204), R(0.7790), R(-0.4598), R(-0.9750), R(1.1723)));
  real rest = R(1.0) - w;
  if (i == 0) {
    real lean = lobePolynomial(NoV, Roughness, R(5.8501), R(-2.2242), R(-1.0148), R(-6.7486), R(3.9609), R(2.0431));
    real mip = lobePolynomial(NoV, Roughness, R(-0.2359), R(-0.4853), R(0.3075), R(2.1652), R(-0.1785), R(-0.5884));
    return makeLobeTap(Roughness, lean, mip, w);
  }
  if (i == 1) {
    real lean = lobePolynomial(NoV, Roughness, R(1.9229), R(-2.1163), R(-1.9948), R(-0.1656), R(4.3330), R(-1.7305));
    real mip = lobePolynomial(NoV, Roughness, R(-1.9035), R(2.2273), R(-0.2566), R(1.0435), R(-1.6163), R(1.0156));
    return makeLobeTap(Roughness, lean, mip, rest * v);
  }
  real lean = lobePolynomial(NoV, Roughness, R(-0.4366), R(-5.9539), R(-0.5462), R(5.3818), R(7.3919), R(-5.5463));
  real mip = lobePolynomial(NoV, Roughness, R(-1.4094), R(2.0355), R(0.1884), R(-0.4432), R(-2.0142), R(1.0200));
  return makeLobeTap(Roughness, lean, mip, rest * (R(1.0) - v));
}

#endif
