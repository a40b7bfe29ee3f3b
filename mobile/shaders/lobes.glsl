// Of scenes with lobes beside the base's own. The layers of the mobile path over its base pass, in the forms of the preset
// (shading/mobile_lobes.glsl). Fully rough materials have neither.

// Whether some material of the permutation has the layer, and the preset shows it.
bool showsCoat() { return kCoat != kCoatNone && mayShow(kFeatureCoat); }
bool showsSheen() { return kSheen != kSheenNone && mayShow(kFeatureSheen); }

struct Layers {
  real coat, coatRoughness; // coat 0: none
  MobileFrame coatFrame;    // of ue4 the base's: the engine has one normal
  real coatNoV;
  real coatE;      // what the coat reflects of an even environment, times coat
  RefitLobe lobe;  // with kCoatRefit
  RefitTap tap;    // likewise
  real3 sheenColor;
  real sheenAlpha, sheenE; // E: the albedo of the lobe
  real below;     // what the layers leave of the base's colour, all light together; 1 with kCoatUE4 for the coat
  real belowCoat; // what the coat leaves of the sheen and of emitted light
};

// The base's material is m; with ue4's coat it changes.
Layers makeLayers(Resolved r, inout MobileMaterial m, MobileFrame frame, real NoV, bool fullyRough) {
  Layers l;
  l.coat = l.coatE = l.sheenE = R(0.0);
  l.below = l.belowCoat = l.coatRoughness = l.sheenAlpha = R(1.0);
  l.sheenColor = real3(R(0.0));
  l.coatFrame = frame;
  l.coatNoV = NoV;
  l.lobe = refitNonmetalLobe(R(1.0), NoV);
  l.tap = refitTap(R(1.0), NoV);
  if (showsCoat() && !fullyRough) {
    l.coat = real(r.coat);
    l.coatRoughness = max(real(r.coatRoughness), R(0.015625));
    if (kCoat == kCoatRefit) {
      l.coatFrame = mobileFrame(r.coatNormal, vec3(frame.V32));
      l.coatNoV = viewCosine(kEnvironmentBrdfRefit, l.coatFrame);
      l.lobe = refitNonmetalLobe(l.coatRoughness, l.coatNoV);
      l.tap = refitTap(l.coatRoughness, l.coatNoV);
      PRECISE real E = l.coat * l.lobe.single.x;
      PRECISE real rest = R(1.0) - E;
      l.coatE = E;
      l.below = l.belowCoat = max(rest, R(0.0));
    } else {
      PRECISE real E = l.coat * EnvBRDFApproxNonmetal(l.coatRoughness, NoV);
      l.coatE = E;
      m = underCoatUE4(m, l.coat, NoV);
    }
  }
  if (showsSheen() && !fullyRough) {
    l.sheenColor = real3(r.sheenColor);
    l.sheenAlpha = sheenAlpha(real(r.sheenRoughness));
    l.sheenE = sheenAlbedoFit(real(r.sheenRoughness), NoV);
    PRECISE real below = l.below * belowSheen(l.sheenColor, l.sheenE);
    l.below = below;
  }
  return l;
}

real3 grey(real x) { return real3(x, x, x); }

// Adds what the layers give of a light of this colour, over pi; lighting is of the base, which ue4's coat dims.
void addLayersLight(inout BasePass pass, Layers l, MobileFrame frame, real NoV, vec3 color, vec3 L, real specularScale,
                    inout MobileDirectLighting lighting) {
  MobileDirectLighting own;
  own.Diffuse = real3(R(0.0));
  if (showsCoat()) {
    real NoL = cosineOf(l.coatFrame.N, L);
    RefitHalfVector cosines = refitHalfVector(l.coatFrame.N32, l.coatFrame.V32, L);
    real lit;
    if (kCoat == kCoatRefit) {
      PRECISE real x = l.coat * refitNonmetalLight(l.lobe, NoL, cosines);
      lit = x;
    } else {
      PRECISE real F = l.coat * coatFresnel(saturate(real(cosines.VoH)));
      PRECISE real rest = R(1.0) - F;
      lit = coatLightUE4(F, l.coatRoughness, NoV, NoL, max(cosines.NoH, 0.0));
      lighting.Diffuse = product(lighting.Diffuse, rest);
      lighting.Specular = product(lighting.Specular, rest);
    }
    own.Specular = grey(lit);
    pass.coat = add(pass.coat, clampContribution65000(lightWith(color, own, specularScale)));
  }
  if (showsSheen()) {
    RefitHalfVector cosines = refitHalfVector(frame.N32, frame.V32, L);
    own.Specular = product(l.sheenColor, sheenLightFit(l.sheenAlpha, NoV, cosineOf(frame.N, L), saturate(real(cosines.NoH))));
    pass.sheen = add(pass.sheen, clampContribution65000(lightWith(color, own, specularScale)));
  }
}

// The environment in the coat: a fetch of its own, and of refit the lobe's wide part of the sky's diffuse light.
void addCoatReflection(inout BasePass pass, Layers l, real3 SkyDiffuseLighting, real IndirectIrradiance, real MaterialAO,
                       uint capture) {
  if (!showsCoat()) return;
  real scale = captureScale(kCaptureScale, IndirectIrradiance, averageBrightnessOf(capture), l.coatRoughness, MaterialAO,
                            mixingOfView());
  real3 direction = l.coatFrame.reflection, lit = real3(R(0.0));
  real mip = captureMip(l.coatRoughness), narrowE = l.coatE;
  if (kCoat == kCoatRefit) {
    direction = refitDirection(l.coatFrame.N, l.coatFrame.V, l.coatNoV, l.tap.lean);
    mip = l.tap.mip;
    PRECISE real wideE = l.coatE * l.tap.wide;
    PRECISE real rest = l.coatE - wideE;
    narrowE = rest;
    lit = product(SkyDiffuseLighting, wideE * MaterialAO);
  }
  lit = add(lit, product(specularIBL(fetchCapture(vec3(direction), mip, capture), scale), narrowE));
  pass.coat = add(pass.coat, modulate(lit, real3(view.skyLightColor.xyz)));
}

// Finite, unless it is NaN: 0 times infinite would be NaN.
real3 finite(real3 color) { return narrow(widen(color)); }

// Before emitted light: what the layers leave of the base pass, and what they add themselves.
void layOver(inout BasePass pass, Layers l) {
  if (!showsCoat() && !showsSheen()) return;
  real3 sheen = product(finite(pass.sheen), l.belowCoat), coat = finite(pass.coat);
  pass.Color = finite(add(add(product(finite(pass.Color), l.below), sheen), coat));
  if (kWriteTerms == 0u) return;
  for (int k = 0; k < kTermFog; ++k) pass.terms.t[k] *= float(l.below);
  pass.terms.t[kTermTransmission] *= float(l.below);
  addTerm(pass, kTermCoatSpecular, coat);
  addTerm(pass, kTermSheen, sheen);
}
