// An environment BRDF of polynomials.
//
// Source: Krzysztof Narkowicz, "Analytical DFG Term for IBL" (blog, 2014): two polynomials in gloss and N.V, fitted to
// GGX with the height-correlated Smith term.
//
// Deviations:
// - The source has gloss, the path has roughness. Its alpha is (1 - gloss)^4, so gloss is 1 - sqrt(Roughness) here.
// - The path forms F0 A + B. The source's bias is B, and its delta is A + B.
// - The path's lights multiply CalcSpecular of ue4-2020 with this environment BRDF.

real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV) {
  PRECISE real x = R(1.0) - sqrt(Roughness);
  real y = NoV;
  PRECISE real ofGloss = (R(1.895) * x - R(0.1688)) * x;
  PRECISE real ofView = ((R(-5.069) * y + R(8.404)) * y - R(4.853)) * y + R(0.9903);
  real bias = saturate(min(ofGloss, ofView));
  PRECISE real delta = R(0.6045) + (R(1.699) + (R(2.661) * x - R(3.603)) * x) * x
                       + (R(1.404) * x + R(0.1939) * y - R(0.5228)) * y;
  PRECISE real scale = saturate(delta) - bias;
  PRECISE real faded = bias * saturate(R(50.0) * SpecularColor.y);
  return real2(scale, faded);
}
