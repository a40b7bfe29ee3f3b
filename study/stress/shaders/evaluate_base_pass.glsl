// As evaluate.glsl, for the pieces of the mobile base pass. A shader of its own: a driver compiles all that a shader holds
// before it drops what the specialization constant does not name.

FN SkySh skyShAt(Inputs i, int at) {
  SkySh sky;
  for (int k = 0; k < 9; ++k) sky.c[k] = real32x3At(i, at + 3 * k);
  return sky;
}

FN TintedSky tintedSkyAt(Inputs i, int at) {
  TintedSky sky;
  for (int k = 0; k < 4; ++k) sky.c[k] = real32x3At(i, at + 3 * k);
  sky.tint = real32x3At(i, at + 12);
  for (int k = 0; k < 5; ++k) sky.q[k] = i.x[at + 15 + k];
  return sky;
}

// The pieces of the mobile base pass, which take structs.
FN Outputs evaluateBasePass(int function, Inputs i) {
  real3 u = real3At(i, 0), v = real3At(i, 3);
  if (function == kFnNarrow) return outputs1(narrow(i.x[0]));
  if (function == kFnDot32) return outputs33(real32x3(dot32(real32x3At(i, 0), real32x3At(i, 3)), R32(0.0), R32(0.0)), widen(v));
  if (function == kFnDecodeRgbm) return outputs3(decodeRgbm(u, real1At(i, 3)));
  if (function == kFnReflectionVector) return outputs3(reflectionVector(u, v));
  if (function == kFnHalfVector) return outputs3(halfVector(real3At(i, 6), u, real32x3At(i, 3)));
  if (function == kFnCosineOf) return outputs1(cosineOf(u, real32x3At(i, 3)));
  if (function == kFnLuminanceUE4) return outputs1(luminanceUE4(u));
  if (function == kFnCaptureScale) {
    int mode = i.x[3] < R32(0.33)  ? kCaptureScaleSky
               : i.x[3] < R32(0.5) ? kCaptureScaleFull
               : i.x[3] < R32(0.9) ? kCaptureScaleMixing
                                   : kCaptureScaleOcclusion;
    MixingRange mixing = mixingRange(kMixingBegin, kMixingEnd, kMixingLargest);
    return outputs1(captureScale(mode, u.x, i.x[1], u.z, real1At(i, 4), mixing));
  }
  if (function == kFnSpecularIBL) return outputs3(specularIBL(u, real1At(i, 3)));
  if (function == kFnModulate) return outputs3(modulate(u, v));
  if (function == kFnPackSkySh) { // the coefficients that the packing mixes
    SkySh sky = packSkySh(irradianceShAt(i, 0), i.x[27] < R32(0.5) ? 4 : 9);
    Outputs o = outputs33(sky.c[0], sky.c[1]);
    o.y[6] = sky.c[6].x;
    o.y[7] = sky.c[8].y;
    o.y[8] = skyMeanRadiance(irradianceShAt(i, 0)).x;
    return o;
  }
  if (function == kFnGetSkySHDiffuseSimple) return outputs3(GetSkySHDiffuseSimple(skyShAt(i, 3), real3At(i, 0)));
  if (function == kFnGetSkySHDiffuse) return outputs3(GetSkySHDiffuse(skyShAt(i, 3), real3At(i, 0)));
  if (function == kFnTintedSkyDiffuse) return outputs3(tintedSkyDiffuse(tintedSkyAt(i, 3), real3At(i, 0)));
  if (function == kFnEncodeRgbm) {
    Rgbm m = encodeRgbm(real32x3At(i, 0));
    return outputs33(real32x3(m.r, m.g, m.b), real32x3(m.a, R32(0.0), R32(0.0)));
  }
  if (function == kFnInitShadingModelContext) {
    MobileMaterial m;
    m.BaseColor = real3At(i, 0);
    m.DielectricSpecular = real3At(i, 3);
    m.Metallic = real1At(i, 6);
    m.Roughness = real1At(i, 7);
    m.F90 = R(1.0);
    int form = i.x[9] < R32(0.33) ? kEnvironmentBrdfKaris2014 : i.x[9] < R32(0.67) ? kEnvironmentBrdfUE4 : kEnvironmentBrdfRefit;
    MobileShadingModelContext c =
        initShadingModelContext(form, i.x[10] > R32(0.75), i.x[11] > R32(0.75), m, real1At(i, 8));
    Outputs o = outputs33(widen(c.DiffuseColor), widen(c.SpecPreEnvBrdf));
    o.y[6] = real32(c.SpecularColor.x);
    o.y[7] = real32(c.SpecularColor.y);
    o.y[8] = real32(c.SpecularColor.z);
    o.y[9] = real32(c.Roughness);
    real2 AB = environmentBrdfAB(form, i.x[11] > R32(0.75), c.SpecPreEnvBrdf, c.Roughness, real1At(i, 8));
    o.y[10] = real32(AB.x);
    o.y[11] = real32(AB.y);
    return o;
  }
  if (function == kFnMobileIntegrateBxDF) {
    MobileMaterial m;
    m.BaseColor = real3At(i, 0);
    m.DielectricSpecular = real3At(i, 3);
    m.Metallic = real1At(i, 18);
    m.Roughness = real1At(i, 6);
    m.F90 = R(1.0);
    int form = i.x[16] < R32(0.33) ? 0 : i.x[16] < R32(0.67) ? 1 : 2; // karis2014, UE4, refit in both enumerations
    int sun = i.x[16] > R32(0.12) && i.x[16] < R32(0.33) ? kSunPhongApprox : form;
    bool fullyRough = i.x[17] > R32(0.75);
    MobileFrame f = mobileFrame(real32x3At(i, 7), real32x3At(i, 10));
    MobileShadingModelContext c = initShadingModelContext(form, false, fullyRough, m, viewCosine(form, f));
    MobileDirectLighting lighting = mobileIntegrateBxDF(sun, fullyRough, c, f, real32x3At(i, 13));
    return outputs33(widen(lighting.Diffuse), widen(lighting.Specular));
  }
  if (function == kFnLightWith) {
    MobileDirectLighting lighting;
    lighting.Diffuse = real3At(i, 3);
    lighting.Specular = real3At(i, 6);
    return outputs3(lightWith(real32x3At(i, 0), lighting, real1At(i, 9)));
  }
  if (function == kFnRefitLobe) {
    RefitLobe lobe = refitLobe(u, v.x, v.y, v.z);
    Outputs o = outputs33(widen(lobe.single), widen(lobe.multiple));
    o.y[6] = real32(lobe.alpha);
    o.y[7] = real32(lobe.rootV);
    o.y[8] = real32(lobe.rise.y);
    o.y[9] = real32(refitDiffuseShare(lobe.single.y, lobe.multiple.y));
    return o;
  }
  if (function == kFnRgbmRoundTrip) {
    Rgbm m = encodeRgbm(real32x3At(i, 0));
    return outputs3(decodeRgbm(real3(real(m.r), real(m.g), real(m.b)), real(m.a)));
  }
  if (function == kFnSrgbRoundTrip) return outputs3(srgbToLinear(linearToSrgb(u)));
  if (function == kFnRefitNonmetal) {
    RefitLobe lobe = refitNonmetalLobe(u.x, real1At(i, 13));
    RefitHalfVector cosines;
    cosines.NoH = i.x[1];
    cosines.VoH = i.x[2];
    return outputs3(real3(lobe.single.x, refitNonmetalLight(lobe, real1At(i, 12), cosines), lobe.rise.z));
  }
  if (function == kFnRefitTap) {
    RefitTap tap = refitTap(u.x, u.y);
    return outputs3(real3(tap.lean, tap.mip, tap.wide));
  }
  if (function == kFnRefitDirection) return outputs3(refitDirection(u, v, dot3(u, v), real1At(i, 6)));
  if (function == kFnRefitHalfVector) {
    RefitHalfVector cosines = refitHalfVector(real32x3At(i, 6), real32x3At(i, 0), real32x3At(i, 3));
    return outputs33(real32x3(cosines.NoH, cosines.VoH, R32(0.0)), widen(u));
  }
  if (function == kFnRefitLight) {
    RefitLobe lobe = refitLobe(real3At(i, 3), R(1.0), real1At(i, 0), real1At(i, 13));
    lobe.single = lobe.multiple = real3At(i, 9); // not what has gone through exp2
    RefitHalfVector cosines;
    cosines.NoH = i.x[1];
    cosines.VoH = i.x[2];
    return outputs3(refitLight(lobe, real1At(i, 12), cosines));
  }
  if (function == kFnMobileShadow) {
    real Shadow = shadowmapOcclusion(i.x[0], i.x[1], i.x[2]);
    real faded = distanceFadedShadow(Shadow, i.x[5], distanceFadeMAD(i.x[6], i.x[7]));
    return outputs3(real3(Shadow, sharpenedShadow(Shadow, real1At(i, 3), real1At(i, 4)), faded));
  }
  if (function == kFnPhongApprox) return outputs1(PhongApprox(u.x, u.y));
  // kFnLocalLightAt
  int falloff = i.x[13] < R32(0.5) ? kFalloffUE4 : i.x[14] > R32(0.0) ? kFalloffExponent : kFalloffKhr;
  MobileLocalLight light = localLightAt(falloff, real32x3At(i, 0), real32x3At(i, 3), i.x[6], i.x[14], i.x[7] > R32(0.5),
                                        real32x3At(i, 8), i.x[11], i.x[12]);
  return outputs33(light.L, light.color);
}
