// The parts of the mobile base pass that add light, in the order in which the pass adds them up.

real4 readLightmapLQ(Point p, real3 N) {
  GpuLightmapScales scaling = lightmapScales[p.instance];
  LightmapScales scales = LightmapScales(scaling.scale0.xyz, scaling.add0.xyz, scaling.scale1.xyz, scaling.scale1.w,
                                         scaling.add1.xyz, scaling.add1.w);
  return GetLightMapColorLQ(real3(readLightmap(bakedPlace, 0.0).xyz), real4(readLightmap(bakedPlace, 1.0)), scales, vec3(N));
}

// Irradiance over pi, and its luminance.
real4 readLightmapOf(Point p, real3 N) {
  if (kLightmapForm != kLightmapFormHq) return readLightmapLQ(p, N);
  real3 color = narrow(lightmapIrradianceOverPi(p, vec3(N)));
  return real4(color, luminanceUE4(color));
}

// ComputeIndirect. An object with a lightmap has the sky's light in it (no ENABLE_SKY_LIGHT). Of refit the lightmap's light
// scatters more than once between microfacets, too: as the high-end path has it, with the reflected light; and the lobe's
// wide part takes it in place of the sky's.
void computeIndirect(inout BasePass pass, inout Shaded s, Point p) {
  bool isBaked = hasLightmap();
  real4 LightmapColor = real4(R(0.0));
  if (isBaked) LightmapColor = readLightmapOf(p, s.frame.N);
  real3 IndirectColor =
      modulate(modulate(LightmapColor.xyz, s.context.DiffuseColor), real3(view.indirectColorScale.xyz));
  s.SkyDiffuseLighting = real3(R(0.0));
  if (hasEnvironment() && !isBaked)
    s.SkyDiffuseLighting = skyDiffuse(s.frame.N);
  s.DiffuseLookup = modulate(s.SkyDiffuseLighting, real3(view.skyLightColor.xyz));
  s.IndirectIrradiance = LightmapColor.w;
  s.IndirectIrradiance += luminanceUE4(s.DiffuseLookup);
  IndirectColor = product(IndirectColor, s.MaterialAO);
  s.IndirectIrradiance *= s.MaterialAO;
  pass.Color = IndirectColor;
  addTerm(pass, kTermLightmap, IndirectColor);
#ifdef PARITY_LOBES
  if (isBaked) {
    real3 light = product(modulate(LightmapColor.xyz, real3(view.indirectColorScale.xyz)), s.MaterialAO);
    if (showsSheen()) pass.sheen = add(pass.sheen, modulate(light, product(s.layers.sheenColor, s.layers.sheenE)));
    PRECISE real wideE = s.layers.coatE * s.layers.tap.wide;
    if (showsCoat() && kCoat == kCoatRefit) pass.coat = add(pass.coat, product(light, wideE));
  }
#endif
  show(kViewIndirectColor, IndirectColor);
  if (isBaked && kIsRefit && !s.fullyRough) {
    real3 scattered = modulate(modulate(LightmapColor.xyz, s.widePart), real3(view.indirectColorScale.xyz));
    scattered = product(scattered, s.MaterialAO);
    pass.Color = add(pass.Color, scattered);
    addTerm(pass, kTermSkySpecular, scattered);
  }
}

// The directional light; 1/pi is in its colour. Its shadow is the darker of the baked one and its map's.
void addDirectionalLight(inout BasePass pass, Shaded s, Point p) {
  real Shadow = R(1.0); // GetPrimaryPrecomputedShadowMask: of a distance field, where one is baked
  if ((kBaked & kBakedSunShadow) != 0u && bakedPlace.z > 0.5)
    Shadow = distanceFieldShadow(real(readSunShadow()), view.path[kPathAverageBrightness].y);
  if ((kShadowMaps & kShadowOfSun) != 0u && directionalCount() != 0u) Shadow = min(Shadow, sunShadow(lights[0], p));
  show(kViewShadow, Shadow);
  if (directionalCount() == 0u) return;
  real3 N = s.frame.N;
  vec3 L = -lights[0].directionCosOuter.xyz;
  vec3 DirectionalLightColor = lights[0].colorRange.xyz * 0.318309886183790672 * float(Shadow);
  real SpecularScale = real(lights[0].cone.y);
  MobileDirectLighting Lighting = mobileIntegrateBxDF(s.sun, s.fullyRough, s.context, s.frame, L);
#ifdef PARITY_LOBES
  squeezeLight(Lighting, s.microfacets, s.sun, s.context, s.frame, L);
  addLayersLight(pass, s.layers, s.frame, s.NoV, DirectionalLightColor, L, SpecularScale, Lighting);
  addThroughLight(pass, s.through, s.frame, DirectionalLightColor, L);
#endif
  real3 lit = lightWith(DirectionalLightColor, Lighting, SpecularScale);
  addLight(pass, kTermSunDiffuse, DirectionalLightColor, Lighting, SpecularScale, lit);
  show(kViewDirectionalLight, lit);
  show(kViewLightingDiffuse, Lighting.Diffuse);
  show(kViewLightingSpecular, Lighting.Specular);
  show(kViewLighting, add(Lighting.Diffuse, Lighting.Specular));
  show(kViewNoL, cosineOf(N, L));
  show(kViewH, halfVector(N, s.frame.V, L));
  show(kViewNoH, max(dot3(N, halfVector(N, s.frame.V, L)), R(0.0)));
}

// GetImageBasedReflectionLighting: one fetch, none for fully rough materials. SkyLightColor is 1 where the cube is a scene
// capture, whose texels have it.
void addReflectedEnvironment(inout BasePass pass, inout Shaded s) {
  real3 direction = s.frame.reflection;
  real mip = captureMip(s.context.Roughness);
  if (kIsRefit) {
    direction = refitDirection(s.frame.N, s.frame.V, s.NoV, s.tap.lean);
    mip = s.tap.mip;
  }
#ifdef PARITY_LOBES
  if (showsAnisotropy() && s.microfacets.isAnisotropic) {
    MobileFrame bent = s.microfacets.bent;
    RefitTap tap = refitTap(s.microfacets.readRoughness, s.microfacets.bentNoV);
    direction = kIsRefit ? refitDirection(bent.N, bent.V, s.microfacets.bentNoV, tap.lean) : bent.reflection;
    mip = kIsRefit ? tap.mip : captureMip(s.microfacets.readRoughness);
  }
  s.readDirection = vec3(direction);
  s.readMip = mip;
#endif
  real scale = captureScale(kCaptureScale, s.IndirectIrradiance, averageBrightnessOf(s.capture),
                            s.context.Roughness, s.MaterialAO, mixingOfView());
  real3 radiance = fetchCapture(vec3(direction), mip, s.capture);
  real3 SkyLightColor = real3(view.skyLightColor.xyz);
  real3 SpecularIBL = modulate(specularIBL(radiance, scale), SkyLightColor);
  real3 lit = modulate(SpecularIBL, s.context.SpecularColor);
#ifdef PARITY_LOBES
  addCoatReflection(pass, s.layers, s.SkyDiffuseLighting, s.IndirectIrradiance, s.MaterialAO, s.capture);
  if (showsCoat() && kCoat == kCoatUE4) {
    PRECISE real under = R(1.0) - s.layers.coatE;
    lit = product(lit, under);
    s.narrowPart = product(s.narrowPart, under);
    s.widePart = product(s.widePart, under);
  }
#endif
  if (kSkyAtOnce) {
    s.reflected = product(radiance, s.narrowPart);
    lit = modulate(s.reflected, s.skyInOcclusion);
  } else if (kIsRefit) {
    real3 sky = product(SkyLightColor, scale);
    lit = modulate(radiance, product(s.narrowPart, sky));
  }
  if (!kSkyAtOnce) pass.Color = add(pass.Color, lit);
  addTerm(pass, kTermSkySpecular, lit);
  show(kViewSpecularIBL, SpecularIBL);
  show(kViewSpecularIBLLit, lit);
  show(kViewColorAfterIBL, narrow(widen(kSkyAtOnce ? add(pass.Color, lit) : pass.Color)));
}

// AccumulateLightingOfDynamicPointLight, of one light.
real3 addLocalLight(inout BasePass pass, Shaded s, Point p, GpuLight light) {
  MobileLocalLight seen =
      localLightAt(falloffOf(light), light.positionKind.xyz - p.position, light.colorRange.xyz, light.colorRange.w,
                   light.falloff.y, uint(light.positionKind.w) == kLightSpot, light.directionCosOuter.xyz, light.cone.x,
                   light.directionCosOuter.w);
  if ((kShadowMaps & kShadowOfSpot) != 0u) seen.color *= float(spotShadow(light, p));
  real SpecularScale = real(light.cone.y);
#ifdef PARITY_OWN_presetLocalLobe
  int lobe = s.sun == kSunOwn ? kSunOwnLocal : s.sun;
#else
  int lobe = s.sun;
#endif
  MobileDirectLighting Lighting = mobileIntegrateBxDF(lobe, s.fullyRough, s.context, s.frame, seen.L);
#ifdef PARITY_LOBES
  squeezeLight(Lighting, s.microfacets, lobe, s.context, s.frame, seen.L);
  addLayersLight(pass, s.layers, s.frame, s.NoV, seen.color, seen.L, SpecularScale, Lighting);
  addThroughLight(pass, s.through, s.frame, seen.color, seen.L);
#endif
  real3 lit = clampContribution65000(lightWith(seen.color, Lighting, SpecularScale));
  addLight(pass, kTermLocalDiffuse, seen.color, Lighting, SpecularScale, lit);
  return lit;
}

// For the lights chosen per object, or with no cap for all, which lie behind the sun.
void addLocalLights(inout BasePass pass, Shaded s, Point p) {
  real3 sum = real3(R(0.0));
  uint most = kLightsPerObject;
  if (kLightCap == 0u) most = localCount();
  for (uint k = 0u; k < most; ++k) {
    uint index = directionalCount() + k;
    if (kLightCap != 0u) index = pathData[kKnobWords + p.instance * kLightsPerObject + k];
    if (index == kNoLight) break;
    sum = add(sum, addLocalLight(pass, s, p, lights[index]));
  }
  show(kViewDynamicPointLights, narrow(widen(sum)));
}

// The sky light. Of refit the specular lobe has its wide part of it.
void addSkyLight(inout BasePass pass, Shaded s) {
  real3 DiffuseColor = s.context.DiffuseColor, widePart = s.widePart;
  bool scatters = kIsRefit && !s.fullyRough;
  real3 lookup = kIsRefit ? modulate(s.SkyDiffuseLighting, s.skyInOcclusion) : s.DiffuseLookup;
  real3 spread = scatters ? add(DiffuseColor, widePart) : DiffuseColor;
  real3 lit = modulate(lookup, spread);
  if (!kIsRefit) lit = product(lit, s.MaterialAO);
  if (kSkyAtOnce) {
    // Finite before it is multiplied: occlusion may be 0.
    real3 light = narrow(widen(add(s.reflected, product(s.SkyDiffuseLighting, spread))));
    pass.Color = add(pass.Color, modulate(light, s.skyInOcclusion));
  } else {
    pass.Color = add(pass.Color, lit);
  }
#ifdef PARITY_LOBES
  if (showsSheen()) {
    PRECISE real albedo = s.layers.sheenE * s.MaterialAO;
    pass.sheen = add(pass.sheen, modulate(s.DiffuseLookup, product(s.layers.sheenColor, albedo)));
  }
#endif
  addTerm(pass, kTermSkyDiffuse, scatters ? modulate(lookup, DiffuseColor) : lit);
  addTerm(pass, kTermSkySpecular, scatters ? modulate(lookup, widePart) : real3(R(0.0)));
  show(kViewSkyLight, lit);
}
