// The analytic environment BRDF of Call of Duty: Black Ops II.
//
// Source: Dimitar Lazarov, "Getting More Physical in Call of Duty: Black Ops II", SIGGRAPH 2013 course "Physically
// Based Shading in Theory and Practice": the course notes (s2013_pbs_black_ops_2_notes.pdf) and the slides. The fit
// takes gloss g, N.V and F0. It stands for Blinn-Phong with the visibility term of Schlick and Smith.
//
// Deviations:
// - The source has gloss, the path has roughness. Gloss g means the specular power 8192^g = 2^(13 g). A GGX lobe of
//   alpha = Roughness^2 is about as wide as Blinn-Phong of the power n = 2 / alpha^2 - 2. So g = log2(n) / 13, cut off
//   at 0 (Roughness above 0.904) and at 1 (Roughness below 0.125). Others set g = 1 - Roughness, which is another
//   curve.
// - The source cuts off the sum F0 A + B at 0 and 1, for each channel. The path forms that sum by itself. So B is
//   raised to where the darkest channel is 0. Grey F0 get the source's numbers. The other channels of a coloured F0 get
//   at most 0.0157 more. The sum never exceeds 1 for F0 in [0, 1].
// - The source's environment is filtered with an angular Gaussian, and gloss picks its mip linearly. The path keeps its
//   own chain of mips.
// - The path's lights multiply CalcSpecular of ue4-2020 with this environment BRDF. Black Ops II has a lobe of its own.

// The gloss of a roughness.
real glossOf(real Roughness) {
  PRECISE real32 alpha = real32(Roughness) * real32(Roughness);
  // 2 / 8194, the square of the alpha of gloss 1: n is 8192 at most.
  PRECISE real32 n = R32(2.0) / max(alpha * alpha, R32(2.4408103e-4)) - R32(2.0);
  PRECISE real32 g = log2(max(n, R32(1.0))) / R32(13.0);
  return real(min(g, R32(1.0)));
}

// min(0.475 g, 2^(-9.28 N.V)): how reflectance rises towards grazing views.
real grazingRise(real g, real NoV) {
  PRECISE real e = R(-9.28) * NoV;
  PRECISE real top = R(0.475) * g;
  return min(top, exp2(e));
}

// With the reflectance a0 at F0 = 0 and a1 at F0 = 1, A = a1 - a0 and B = a0.
//   a0 = (rise + 0.0175) g / 0.96 - 0.015 / 0.96,  a1 = 0.25 g + 0.75
// The source prints 0.0275 - 0.25 * 0.04 for 0.0175, and 0.015 - 0.75 * 0.04 for -0.015.
real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV) {
  real g = glossOf(Roughness);
  PRECISE real a0 = (grazingRise(g, NoV) + R(0.0175)) * g * R(1.04166667) - R(0.015625);
  PRECISE real a1 = R(0.25) * g + R(0.75);
  PRECISE real A = a1 - a0;
  real darkest = min(SpecularColor.x, min(SpecularColor.y, SpecularColor.z));
  PRECISE real leastB = -(darkest * A);
  return real2(A, max(a0, leastB));
}

// The same at F0 = 0.04, from which the source derives a0: a004 = 0.96 a0 + 0.04 a1.
real presetEnvironmentBrdfNonmetal(real Roughness, real NoV) {
  real g = glossOf(Roughness);
  PRECISE real E = (grazingRise(g, NoV) + R(0.0275)) * g + R(0.015);
  return E;
}
