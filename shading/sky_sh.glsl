// The sky light of Unreal Engine 4's mobile base pass: SH irradiance over pi, its constants folded in beforehand.
#ifndef PARITY_SHADING_SKY_SH
#define PARITY_SHADING_SKY_SH

#include "shading/real.glsl"
#include "shading/sh.glsl"

// E(n)/pi = c0 + c1 x + c2 y + c3 z + c4 xy + c5 yz + c6 zz + c7 zx + c8 (xx - yy), the layout of UE4's
// SkyIrradianceEnvironmentMap. Uniforms of the engine: at least fp32 in every precision.
struct SkySh {
  real32x3 c[9];
};

// The mean radiance of the sky: its first irradiance coefficient times Y_0 over pi.
FN real32x3 skyMeanRadiance(IrradianceSh sh) {
  PRECISE real32 f = R32(0.282094791773878143) * R32(0.318309886183790672);
  PRECISE real32x3 mean = real32x3(real32(sh.c[0].x) * f, real32(sh.c[0].y) * f, real32(sh.c[0].z) * f);
  return mean;
}

// From irradiance coefficients (shading/sh.glsl), for coefficients = 9 or 4. The factors of the first two bands, applied to
// radiance, are those of docs/shading.md 7b: .282095 and .325735. With 9 the constant has a part of 3 z^2 - 1,
// which c6 zz lacks.
// With 4 the engine's constant keeps its part of the second band too, although nothing else of that band is read:
//   W = C0 V0 - C3 V6,  C3 = sqrt(5) / (16 sqrt(pi)),  V6: of 3 z^2 - 1 with Z up      (docs/shading.md 7e)
// Y is up here, and 3 y^2 - 1 = -(3 z^2 - 1)/2 - 3 (x^2 - y^2)/2, so that V6 of the engine is -V6/2 - sqrt(3)/2 V8 of ours:
//   W = C0 V0 + C3 (V6/2 + sqrt(3)/2 V8),  C3 V_i = sqrt(5/(16 pi)) E_i / pi
// Done once, on the CPU.
FN SkySh packSkySh(IrradianceSh sh, int coefficients) {
  SkySh sky;
  for (int i = 0; i < 9; ++i) {
    real32 k = R32(0.0);
    int from = i;
    if (i == 0) k = R32(0.282094791773878143);
    if (i == 1) from = 3;
    if (i == 2) from = 1;
    if (i == 3) from = 2;
    if (i >= 1 && i <= 3) k = R32(0.488602511902919921);
    if (coefficients == 9) {
      if (i == 4 || i == 5 || i == 7) k = R32(1.09254843059207907);
      if (i == 6) k = R32(0.946174695757560018);
      if (i == 8) k = R32(0.546274215296039535);
    }
    PRECISE real32 f = k * R32(0.318309886183790672);
    PRECISE real32x3 c = real32x3(real32(sh.c[from].x) * f, real32(sh.c[from].y) * f, real32(sh.c[from].z) * f);
    sky.c[i] = c;
  }
  PRECISE real32 f = R32(0.315391565252520006) * R32(0.318309886183790672);
  real32 of6 = coefficients == 9 ? R32(-1.0) : R32(0.5);
  real32 of8 = coefficients == 9 ? R32(0.0) : R32(0.866025403784438647);
  PRECISE real32 f6 = of6 * f;
  PRECISE real32 f8 = of8 * f;
  PRECISE real32x3 c = real32x3(sky.c[0].x + real32(sh.c[6].x) * f6 + real32(sh.c[8].x) * f8,
                                sky.c[0].y + real32(sh.c[6].y) * f6 + real32(sh.c[8].y) * f8,
                                sky.c[0].z + real32(sh.c[6].z) * f6 + real32(sh.c[8].z) * f8);
  sky.c[0] = c;
  return sky;
}

FN real32 skyShLinear(real32 c0, real32 cx, real32 cy, real32 cz, real32x3 n) {
  PRECISE real32 s = c0 + cx * n.x + cy * n.y + cz * n.z;
  return s;
}

// What UE4 calls GetSkySHDiffuseSimple: the linear band and the constant; E/pi, so the radiance of a white Lambertian. The
// series that ends after the linear band is off the exact irradiance by 18 % of its mean (average over 18 maps of the
// median), 41 % at worst (docs/shading.md 6c); what the constant keeps of the second band (packSkySh) is 10 to 15 % of
// it on real maps (docs/shading.md 7e; 3, 5 and 11 % of the mean on those of tests/lighting). N: unit
// length; the result is not negative.
FN real3 GetSkySHDiffuseSimple(SkySh sky, real3 N) {
  real32x3 n = widen(N);
  real32x3 e = real32x3(max(skyShLinear(sky.c[0].x, sky.c[1].x, sky.c[2].x, sky.c[3].x, n), R32(0.0)),
                        max(skyShLinear(sky.c[0].y, sky.c[1].y, sky.c[2].y, sky.c[3].y, n), R32(0.0)),
                        max(skyShLinear(sky.c[0].z, sky.c[1].z, sky.c[2].z, sky.c[3].z, n), R32(0.0)));
  return narrow(e);
}

FN real32 skyShQuadratic(real32 linear, real32 c4, real32 c5, real32 c6, real32 c7, real32 c8, real32 xy, real32 yz, real32 zz,
                         real32 zx, real32 xxyy) {
  PRECISE real32 s = linear + c4 * xy + c5 * yz + c6 * zz + c7 * zx + c8 * xxyy;
  return s;
}

// All nine (UE4's GetSkySHDiffuse): evalIrradianceSH over pi, 2.3 and 10.3 % off. N: unit length; not negative.
FN real3 GetSkySHDiffuse(SkySh sky, real3 N) {
  real32x3 n = widen(N);
  PRECISE real32 xy = n.x * n.y;
  PRECISE real32 yz = n.y * n.z;
  PRECISE real32 zz = n.z * n.z;
  PRECISE real32 zx = n.z * n.x;
  PRECISE real32 xxyy = n.x * n.x - n.y * n.y;
  real32 r = skyShLinear(sky.c[0].x, sky.c[1].x, sky.c[2].x, sky.c[3].x, n);
  real32 g = skyShLinear(sky.c[0].y, sky.c[1].y, sky.c[2].y, sky.c[3].y, n);
  real32 b = skyShLinear(sky.c[0].z, sky.c[1].z, sky.c[2].z, sky.c[3].z, n);
  r = skyShQuadratic(r, sky.c[4].x, sky.c[5].x, sky.c[6].x, sky.c[7].x, sky.c[8].x, xy, yz, zz, zx, xxyy);
  g = skyShQuadratic(g, sky.c[4].y, sky.c[5].y, sky.c[6].y, sky.c[7].y, sky.c[8].y, xy, yz, zz, zx, xxyy);
  b = skyShQuadratic(b, sky.c[4].z, sky.c[5].z, sky.c[6].z, sky.c[7].z, sky.c[8].z, xy, yz, zz, zx, xxyy);
  return narrow(real32x3(max(r, R32(0.0)), max(g, R32(0.0)), max(b, R32(0.0))));
}

#endif
