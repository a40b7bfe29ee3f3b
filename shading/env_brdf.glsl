// The environment BRDF of the mobile path: Karis' analytic fit in place of the preintegrated table.
//
// All approximate A(R,N), B(R,N) of  integral f_specular cos = F0 A + B  for Schlick-Smith, k = alpha/2
// (docs/shading.md 1a). Deviation from that integral, absolute, max/rms over N >= 0.05 and R >= 0.05
// (docs/shading.md 2b): at F0 = 0.04 .161/.024, at F0 = 1 .238/.076; from the height-correlated one .084/.020
// and .396/.127. A + B = 1 - 0.55 R whatever N is; B reaches -0.0024 at R = 1, A -0.044 at R = N = 0; at R = N = 1 it
// says .450 for F0 = 1 where the integral is .307 (1 - ln 2).
#ifndef PARITY_SHADING_ENV_BRDF
#define PARITY_SHADING_ENV_BRDF

#include "shading/real.glsl"

// A and B of EnvBRDFApprox, as Karis 2014 ("Physically Based Shading on Mobile") prints them, after Lazarov 2013:
//   r = R c0 + c1;  a004 = min(r.x^2, 2^(-9.28 N)) r.x + r.y;  AB = (-1.04, 1.04) a004 + r.zw
// roughness in [0, 1], NoV in [0, 1]. Safe in half: at most 0.5 % relative (docs/shading.md 4).
FN real2 EnvBRDFApproxAB(real roughness, real NoV) {
  PRECISE real rx = roughness * R(-1.0) + R(1.0);
  PRECISE real ry = roughness * R(-0.0275) + R(0.0425);
  PRECISE real rz = roughness * R(-0.572) + R(1.04);
  PRECISE real rw = roughness * R(0.022) + R(-0.04);
  PRECISE real e = R(-9.28) * NoV;
  PRECISE real a004 = min(rx * rx, exp2(e)) * rx + ry;
  PRECISE real2 AB = real2(R(-1.04) * a004 + rz, R(1.04) * a004 + rw);
  return AB;
}

// SpecularColor A + B (Karis 2014). At R = N = 1: 0.4524 SpecularColor - 0.0024 (the article's own check).
FN real3 EnvBRDFApprox(real3 SpecularColor, real Roughness, real NoV) {
  real2 AB = EnvBRDFApproxAB(Roughness, NoV);
  PRECISE real3 E = real3(SpecularColor.x * AB.x + AB.y, SpecularColor.y * AB.x + AB.y, SpecularColor.z * AB.x + AB.y);
  return E;
}

// The same as UE4 ships it (BRDF.ush, 2020): B is faded out by saturate(50 SpecularColor.g), because less than 2 % is
// physically impossible and means shadowing. Identical for green >= 0.02; specular is off at 0.
FN real3 EnvBRDFApproxUE4(real3 SpecularColor, real Roughness, real NoV) {
  real2 AB = EnvBRDFApproxAB(Roughness, NoV);
  PRECISE real B = AB.y * saturate(R(50.0) * SpecularColor.y);
  PRECISE real3 E = real3(SpecularColor.x * AB.x + B, SpecularColor.y * AB.x + B, SpecularColor.z * AB.x + B);
  return E;
}

// "Same as EnvBRDFApprox(0.04, Roughness, NoV)" (Karis 2014), for materials known to be plain dielectrics. Differs from
// it by up to 1.53e-3; from the integral .160/.024 (a), .085/.020 (b) over the core. Roughness, NoV in [0, 1].
FN real EnvBRDFApproxNonmetal(real Roughness, real NoV) {
  PRECISE real rx = Roughness * R(-1.0) + R(1.0);
  PRECISE real ry = Roughness * R(-0.0275) + R(0.0425);
  PRECISE real e = R(-9.28) * NoV;
  PRECISE real E = min(rx * rx, exp2(e)) * rx + ry;
  return E;
}

// The "fully rough" flag (Karis 2014): roughness is 1, the environment is not fetched, its reflection becomes diffuse.
//   DiffuseColor += 0.45 SpecularColor;  SpecularColor = 0
// Against the integral at R = 1, F0 = 1, over N: rms .090 (a), .175 (b) (docs/shading.md 2c).
FN void FullyRough(INOUT(real3) DiffuseColor, INOUT(real3) SpecularColor) {
  PRECISE real3 diffuse = real3(DiffuseColor.x + SpecularColor.x * R(0.45), DiffuseColor.y + SpecularColor.y * R(0.45),
                                DiffuseColor.z + SpecularColor.z * R(0.45));
  DiffuseColor = diffuse;
  SpecularColor = real3(R(0.0), R(0.0), R(0.0));
}

#endif
