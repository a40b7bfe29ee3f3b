// A toy environment BRDF, straight in roughness and in N.V.
FN real2 ownEnvironmentBrdfAB(real3 SpecularColor, real Roughness, real NoV) {
  PRECISE real A = R(0.25) + R(0.25) * Roughness;
  PRECISE real B = R(0.25) - R(0.25) * NoV;
  return real2(A, B);
}
