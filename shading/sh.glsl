// Real spherical harmonics of order 2 (9 coefficients): projection of radiance, evaluation of irradiance.
//
// One layout for C++ and GLSL: index l^2 + l + m, that is 1 | y z x | xy yz 3z^2-1 xz x^2-y^2. What crosses the border is
// irradiance coefficients: the radiance projected on the basis, times pi, 2pi/3, pi/4 for bands 0, 1, 2 (shCosineKernel).
#ifndef PARITY_SHADING_SH
#define PARITY_SHADING_SH

#include "shading/real.glsl"

struct ShBasis {
  real y[9];
};

// Irradiance coefficients of red, green and blue: E_i = A_l integral L(w) Y_i(w) dw, the cosine kernel A_l included.
struct IrradianceSh {
  real3 c[9];
};

// Y_i(n), orthonormal over the sphere (Ramamoorthi and Hanrahan 2001, eq. 3; no Condon-Shortley phase). n: unit length.
FN ShBasis shBasis(real3 n) {
  ShBasis b;
  PRECISE real y1 = R(0.488602511902919921) * n.y;
  PRECISE real y2 = R(0.488602511902919921) * n.z;
  PRECISE real y3 = R(0.488602511902919921) * n.x;
  PRECISE real y4 = R(1.09254843059207907) * (n.x * n.y);
  PRECISE real y5 = R(1.09254843059207907) * (n.y * n.z);
  PRECISE real y6 = R(0.315391565252520006) * (R(3.0) * (n.z * n.z) - R(1.0));
  PRECISE real y7 = R(1.09254843059207907) * (n.x * n.z);
  PRECISE real y8 = R(0.546274215296039535) * (n.x * n.x - n.y * n.y);
  b.y[0] = R(0.282094791773878143);
  b.y[1] = y1;
  b.y[2] = y2;
  b.y[3] = y3;
  b.y[4] = y4;
  b.y[5] = y5;
  b.y[6] = y6;
  b.y[7] = y7;
  b.y[8] = y8;
  return b;
}

// A_l of the clamped cosine: pi, 2pi/3, pi/4 for bands 0, 1, 2 (Ramamoorthi and Hanrahan 2001, eq. 8).
FN real shCosineKernel(int band) {
  if (band == 0) return R(3.14159265358979324);
  if (band == 1) return R(2.09439510239319549);
  return R(0.785398163397448310);
}

// Irradiance E(n) = sum E_i Y_i(n) (Ramamoorthi and Hanrahan 2001, eq. 9), in the units of radiance times sr: divide by
// pi for the radiance that a white Lambertian sends out. Never below 0: where a small bright source makes the truncated
// series ring, the negative part is cut. Off the exact irradiance by 2.3 % of its mean (average over 18 maps of the
// median), 10.3 % at worst; with the sun taken out 1.35 and 6.1 % (docs/shading.md 6c). n: unit length.
FN real3 evalIrradianceSH(IrradianceSh sh, real3 n) {
  ShBasis b = shBasis(n);
  PRECISE real3 e = real3(R(0.0), R(0.0), R(0.0));
  for (int i = 0; i < 9; ++i) {
    e = real3(e.x + sh.c[i].x * b.y[i], e.y + sh.c[i].y * b.y[i], e.z + sh.c[i].z * b.y[i]);
  }
  return real3(max(e.x, R(0.0)), max(e.y, R(0.0)), max(e.z, R(0.0)));
}

#endif
