// Calls one shading function on one row of numbers; the same source on the device and, per precision, on the CPU.
// Rows are real32, so that half values pass through buffers of floats unchanged.

struct Inputs {
  real32 x[kInputs];
};

struct Outputs {
  real32 y[kOutputs];
};

FN real real1At(Inputs i, int at) { return real(i.x[at]); }

FN real3 real3At(Inputs i, int at) { return real3(real(i.x[at]), real(i.x[at + 1]), real(i.x[at + 2])); }

FN real32x3 real32x3At(Inputs i, int at) { return real32x3(i.x[at], i.x[at + 1], i.x[at + 2]); }

FN Outputs outputs1(real a) {
  Outputs o;
  for (int k = 0; k < kOutputs; ++k) o.y[k] = R32(0.0);
  o.y[0] = real32(a);
  return o;
}

FN Outputs outputs3(real3 a) {
  Outputs o = outputs1(a.x);
  o.y[1] = real32(a.y);
  o.y[2] = real32(a.z);
  return o;
}

FN Outputs outputs33(real32x3 a, real32x3 b) {
  Outputs o = outputs1(R(0.0));
  o.y[0] = a.x;
  o.y[1] = a.y;
  o.y[2] = a.z;
  o.y[3] = b.x;
  o.y[4] = b.y;
  o.y[5] = b.z;
  return o;
}

FN Outputs outputsTap(LobeTap tap) { return outputs3(real3(tap.blend, tap.mip, tap.weight)); }

FN IrradianceSh irradianceShAt(Inputs i, int at) {
  IrradianceSh sh;
  for (int k = 0; k < 9; ++k) sh.c[k] = real3At(i, at + 3 * k);
  return sh;
}

FN Outputs evaluate(int function, Inputs i) {
  real a = real1At(i, 0);
  real b = real1At(i, 1);
  real c = real1At(i, 2);
  real3 u = real3At(i, 0);
  real3 v = real3At(i, 3);
  real w = real1At(i, 6);
  if (function == kFnD_GGX) return outputs1(D_GGX(a, b));
  if (function == kFnV_SmithGGXCorrelated) return outputs1(V_SmithGGXCorrelated(a, b, c));
  if (function == kFnV_SchlickSmith) return outputs1(V_SchlickSmith(a, b, c));
  if (function == kFnF_Schlick) return outputs3(F_Schlick(v, a));
  if (function == kFnFd_Lambert) return outputs1(Fd_Lambert());
  if (function == kFnEnergyCompensation) return outputs3(energyCompensation(v, real2(a, b)));
  if (function == kFnEnvBRDFApproxAB) {
    real2 ab = EnvBRDFApproxAB(a, b);
    return outputs3(real3(ab.x, ab.y, R(0.0)));
  }
  if (function == kFnEnvBRDFApprox) return outputs3(EnvBRDFApprox(v, a, b));
  if (function == kFnEnvBRDFApproxUE4) return outputs3(EnvBRDFApproxUE4(v, a, b));
  if (function == kFnEnvBRDFApproxNonmetal) return outputs1(EnvBRDFApproxNonmetal(a, b));
  if (function == kFnFullyRough) {
    FullyRough(u, v);
    Outputs o = outputs3(u);
    o.y[3] = real32(v.x);
    o.y[4] = real32(v.y);
    o.y[5] = real32(v.z);
    return o;
  }
  if (function == kFnD_Approx) return outputs1(D_Approx(a, b));
  if (function == kFnGGX_Mobile) return outputs1(GGX_Mobile(a, i.x[1]));
  if (function == kFnCalcSpecular) return outputs1(CalcSpecular(a, i.x[1]));
  if (function == kFnShBasis) {
    ShBasis basis = shBasis(u);
    Outputs o = outputs1(R(0.0));
    for (int k = 0; k < 9; ++k) o.y[k] = real32(basis.y[k]);
    return o;
  }
  if (function == kFnShCosineKernel) return outputs3(real3(shCosineKernel(0), shCosineKernel(1), shCosineKernel(2)));
  if (function == kFnEvalIrradianceSH) return outputs3(evalIrradianceSH(irradianceShAt(i, 3), u));
  if (function == kFnSquareFalloff) return outputs1(narrow(squareFalloff(i.x[0], i.x[1])));
  if (function == kFnSquareFalloffUE4) return outputs1(narrow(squareFalloffUE4(i.x[0], i.x[1])));
  if (function == kFnExponentFalloff) return outputs1(narrow(exponentFalloff(i.x[0], i.x[1], i.x[2])));
  if (function == kFnSpotAttenuation) return outputs1(spotAttenuation(a, b, c));
  if (function == kFnClampContribution65000) return outputs3(clampContribution65000(u));
  if (function == kFnMipFromRoughness) return outputs1(mipFromRoughness(a));
  if (function == kFnRoughnessFromMip) return outputs1(roughnessFromMip(a));
  if (function == kFnDielectricSpecular) return outputs1(dielectricSpecular(a));
  if (function == kFnDiffuseColor) return outputs3(diffuseColor(u, w));
  if (function == kFnSpecularColor) return outputs3(specularColor(u, v, w));
  if (function == kFnSaturate) return outputs3(saturate(u));
  if (function == kFnSafeNormalize) return outputs3(narrow(safeNormalize(real32x3At(i, 0), real32x3At(i, 3))));
  if (function == kFnLuminance) return outputs1(luminance(u));
  if (function == kFnSrgbToLinear) return outputs3(srgbToLinear(u));
  if (function == kFnLinearToSrgb) return outputs3(linearToSrgb(u));
  if (function == kFnDot3) return outputs1(dot3(u, v));
  if (function == kFnSqr) return outputs1(sqr(a));
  if (function == kFnSchlickWeight) return outputs1(schlickWeight(a));
  if (function == kFnSphericalGaussianWeight) return outputs1(sphericalGaussianWeight(a));
  if (function == kFnDielectricWeight) return outputs1(dielectricWeight(a));
  if (function == kFnFresnelMeans) return outputs3(real3(schlickMean(), sphericalGaussianMean(), dielectricMean()));
  if (function == kFnMixFresnel) return outputs3(mixFresnel(u, real1At(i, 3), real1At(i, 4)));
  if (function == kFnAlbedoScaling) return outputs3(albedoScaling(u));
  if (function == kFnFdezAgueraAlbedo) return outputs3(fdezAgueraAlbedo(u, w, v, real2(real1At(i, 7), real1At(i, 8))));
  if (function == kFnKullaContyAlbedo) return outputs3(kullaContyAlbedo(u, real1At(i, 3), real1At(i, 4)));
  if (function == kFnKullaContyLobe) return outputs1(kullaContyLobe(a, b));
  if (function == kFnDominantBlend) return outputs1(dominantBlend(a));
  if (function == kFnStretchedTap) return outputsTap(stretchedTap(i.x[2] < R32(0.5) ? 0 : 1, a, b));
  if (function == kFnTwoTap) return outputsTap(twoTap(i.x[2] < R32(0.5) ? 0 : 1, a, b));
  if (function == kFnThreeTap) return outputsTap(threeTap(i.x[2] < R32(0.33) ? 0 : i.x[2] < R32(0.67) ? 1 : 2, a, b));
  if (function == kFnAlphaSquaredOfNormals) return outputs1(alphaSquaredOfNormals(a));
  if (function == kFnWidenRoughness) return outputs1(real(widenRoughness(i.x[0], i.x[1])));
  if (function == kFnHeightFogTransmittance)
    return outputs1(heightFogTransmittance(HeightFog(i.x[0], i.x[1], i.x[2], i.x[3], i.x[4]), i.x[5], i.x[6], i.x[7]));
  if (function == kFnEncodeGamma2) return outputs3(encodeGamma2(u));
  if (function == kFnSaturateToHalf) return outputs3(saturateToHalf(u));
  // kFnConstants: literals whose nearest half is not the truncated one, and the named constants.
  Outputs o = outputs3(real3(R(0.7), R(0.0275), R(-9.28)));
  o.y[3] = real32(R(0.0722));
  o.y[4] = real32(R(2.4));
  o.y[5] = real32(R(1.2e-4));
  o.y[6] = real32(kPi);
  o.y[7] = real32(kInvPi);
  o.y[8] = real32(kSmallest);
  o.y[9] = real32(kLargest);
  o.y[10] = real32(R(65000.0));
  o.y[11] = kMinDistanceSquared;
  return o;
}
