// The mobile path: Karis 2014 ("Physically Based Shading on Mobile") and Unreal Engine 4's mobile base pass (2020), in
// the order in which the base pass adds up. Compiled in fp32 and, with PARITY_FP16, in half.
#include "gpu/shaders/path.glsl"
#include "mobile/shaders/views.h"
#include "shading/lightmap.glsl"
#include "shading/mips.glsl"
#include "shading/mobile_base_pass.glsl"
#ifdef PARITY_LOBES
#include "shading/mobile_lobes.glsl"
#endif
#include "shading/rgbm.glsl"
#include "shading/tinted_sky.glsl"
#include "shading/sky_sh.glsl"

// The knobs of a preset (mobile/options.h).
layout(constant_id = 8) const int kEnvironmentBrdf = 0; // kEnvironmentBrdf... of shading/mobile_base_pass.glsl
layout(constant_id = 9) const int kSun = 0;             // kSun...
layout(constant_id = 10) const int kCaptureScale = 0;   // kCaptureScale...
layout(constant_id = 11) const int kSkyForm = 0;        // kSkyForm... below
layout(constant_id = 12) const uint kRgbmCapture = 1u;
layout(constant_id = 13) const float kRoughnessFloor = 0.0;
layout(constant_id = 14) const uint kView = 0u; // kView... of mobile/shaders/views.h
layout(constant_id = 15) const uint kShadowMaps = 0u; // kShadowOf... bits: which lights have one
layout(constant_id = 16) const uint kBaked = 0u;      // kBaked... bits
layout(constant_id = 17) const uint kFalloffs = 0u;   // ways in which local lights fade
layout(constant_id = 18) const int kCoat = 0;         // kCoat... of shading/mobile_lobes.glsl
layout(constant_id = 19) const int kSheen = 0;        // kSheen...
#include "gpu/shaders/baked.glsl"
#include "gpu/shaders/local_light.glsl"
#include "gpu/shaders/shadow_map.glsl"
#include "mobile/shaders/shadow_maps.glsl"

vec3 shown = vec3(0.0);
void show(uint view, real3 value) {
  if (kView == view) shown = vec3(value);
}
void show(uint view, real value) { show(view, real3(value)); }

real3 product(real3 a, real b) {
  PRECISE real3 p = real3(a.x * b, a.y * b, a.z * b);
  return p;
}
real3 product(real3 a, real3 b) {
  PRECISE real3 p = real3(a.x * b.x, a.y * b.y, a.z * b.z);
  return p;
}
real3 add(real3 a, real3 b) {
  PRECISE real3 sum = real3(a.x + b.x, a.y + b.y, a.z + b.z);
  return sum;
}

struct BasePass {
  real3 Color;
  Terms terms; // the same by term, as far as they are written
#ifdef PARITY_LOBES
  real3 coat, sheen; // what the layers give by themselves
#endif
};

void addTerm(inout BasePass pass, int term, real3 value) {
  if (kWriteTerms != 0u) pass.terms.t[term] = vec3(narrow(widen(add(real3(pass.terms.t[term]), value))));
}

// What has been added up leaves as the target holds it: behind the vertices' fog, premultiplied, and finite unless
// it is NaN.
void writePass(uint i, BasePass pass, float opacity) {
  real3 Color = narrow(widen(pass.Color));
  real3 VertexFog = real3(R(0.0));
  real VertexFogA = R(1.0);
  if (hasVertexData(kVertexFog)) {
    vec4 fog = vertexFog(i);
    VertexFog = narrow(fog.xyz);
    VertexFogA = real(fog.w);
    Color = narrow(widen(add(product(Color, VertexFogA), VertexFog)));
    for (int k = 0; k < kTermCount; ++k) pass.terms.t[k] *= float(VertexFogA);
    addTerm(pass, kTermFog, VertexFog);
  }
  show(kViewVertexFog, VertexFog);
  show(kViewVertexFogA, VertexFogA);
  if ((kMayFeatures & kFeatureBlend) != 0u) { // opacity is 1 else
    Color = product(Color, real(opacity));
    shown *= opacity;
    for (int k = 0; k < kTermCount; ++k) pass.terms.t[k] *= opacity;
  }
  outColor[i] = vec4(kView == kViewLit ? vec3(Color) : shown, opacity);
  writeTerms(i, pass.terms);
}

MobileMaterial makeMaterial(Resolved r) {
  MobileMaterial m;
  m.BaseColor = real3(r.baseColor);
  m.Metallic = real(r.metallic);
  m.DielectricSpecular = real3(r.F0);
  m.F90 = real(r.F90);
  m.Roughness = real(kRoughnessFloor > 0.0 ? max(kRoughnessFloor, r.roughness) : r.roughness);
  return m;
}

// Enumerators of mobile/options.h.
const int kSkyFormSh4 = 0;
const int kSkyFormSh9 = 1;
const int kSkyFormTinted = 2;

TintedSky tintedSky() {
  TintedSky sky;
  for (int k = 0; k < 4; ++k) sky.c[k] = view.path[kPathSkySh + k].xyz;
  sky.tint = view.path[kPathSkySh + 4].xyz;
  for (int k = 0; k < 3; ++k) sky.q[k] = view.path[kPathSkySh + 5][k];
  for (int k = 0; k < 2; ++k) sky.q[3 + k] = view.path[kPathSkySh + 6][k];
  return sky;
}

SkySh skySh() {
  SkySh sky;
  for (int k = 0; k < 9; ++k) sky.c[k] = view.path[kPathSkySh + k].xyz;
  return sky;
}

real3 skyDiffuse(real3 N) {
  if (kSkyForm == kSkyFormTinted) return tintedSkyDiffuse(tintedSky(), N);
  if (kSkyForm == kSkyFormSh9) return GetSkySHDiffuse(skySh(), N);
  return GetSkySHDiffuseSimple(skySh(), N);
}

// Of the object: the nearest, or the environment where none are baked.
uint captureOf(Point p) {
  if ((kBaked & kBakedCaptures) == 0u) return 0u;
  return min(instances[p.instance].baked.z, captureHead.x - 1u);
}

float averageBrightnessOf(uint capture) {
  if ((kBaked & kBakedCaptures) == 0u) return view.path[kPathAverageBrightness].x;
  return captures[capture].boxLower.w;
}

MixingRange mixingOfView() { return MixingRange(view.path[kPathMixing].x, view.path[kPathMixing].y, view.path[kPathMixing].z); }

// One fetch of the capture, trilinear, from one lobe to one three times as wide.
real3 fetchCapture(vec3 direction, real mip, uint capture) {
  vec4 texel = textureLod(prefilteredEnvironment, vec4(direction, float(capture)), float(mip));
  if (kRgbmCapture != 0u) return decodeRgbm(real3(texel.xyz), real(texel.w));
  return real3(texel.xyz);
}

// The terms of a light whose colour's parts the sum's clamp has left in proportion. Written on request only.
void addLight(inout BasePass pass, int diffuseTerm, vec3 color, MobileDirectLighting lighting, real specularScale,
              real3 sum) {
  pass.Color = add(pass.Color, sum);
  if (kWriteTerms == 0u) return;
  MobileDirectLighting part = lighting;
  part.Specular = real3(R(0.0));
  vec3 diffuse = vec3(lightWith(color, part, R(0.0)));
  part.Specular = lighting.Specular;
  part.Diffuse = real3(R(0.0));
  vec3 specular = vec3(lightWith(color, part, specularScale));
  vec3 whole = diffuse + specular;
  vec3 kept = vec3(sum);
  vec3 share = vec3(whole.x > kept.x ? kept.x / whole.x : 1.0, whole.y > kept.y ? kept.y / whole.y : 1.0,
                    whole.z > kept.z ? kept.z / whole.z : 1.0);
  addTerm(pass, diffuseTerm, real3(diffuse * share));
  addTerm(pass, diffuseTerm + 1, real3(specular * share));
}

#ifdef PARITY_LOBES
#include "mobile/shaders/lobes.glsl"
#endif

// What the lights read of one pixel.
struct Shaded {
#ifdef PARITY_LOBES
  Layers layers;
#endif
  MobileMaterial GBuffer;
  MobileFrame frame;
  MobileShadingModelContext context;
  real NoV, MaterialAO, IndirectIrradiance;
  real3 SkyDiffuseLighting, DiffuseLookup;
  // Of refit: SkyLightColor with occlusion; where to read the environment, the factor of what is read, and the specular
  // factor of the irradiance over pi: of what scatters more than once, and of the lobe's wide part.
  real3 skyInOcclusion;
  real3 reflected; // with kSkyAtOnce: of the environment, still without skyInOcclusion
  RefitTap tap;
  real3 narrowPart, widePart;
  uint capture;
  int sun; // kSun... of the pixel's material
  bool fullyRough, onlyNonmetals;
};

const bool kIsRefit = kEnvironmentBrdf == kEnvironmentBrdfRefit;
// Reflected and diffuse light of the sky are multiplied by skyInOcclusion together, and saturate once: nine operations fewer.
const bool kSkyAtOnce = kIsRefit && kCaptureScale == kCaptureScaleOcclusion;

Shaded makeShaded(Point p, Resolved r) {
  Shaded s;
  s.fullyRough = hasFeature(kFeatureFullyRough, p.material);
  // Nonmetals of a bin of their own: fewer operations, the same colour.
  s.onlyNonmetals = (kMustFeatures & kFeatureNonmetal) != 0u;
#ifdef PARITY_LOBES
  bool dimsSpecular = kCoat == kCoatUE4 && showsCoat(); // its Specular changes with the view
  if (dimsSpecular) s.onlyNonmetals = false;
#endif
  int environmentBrdf = kIsRefit && s.onlyNonmetals ? kEnvironmentBrdfRefitNonmetal : kEnvironmentBrdf;
  s.sun = kSun == kSunRefit && s.onlyNonmetals ? kSunRefitNonmetal : kSun;
  s.GBuffer = makeMaterial(r);
  s.MaterialAO = real(r.occlusion);
  s.skyInOcclusion = product(real3(view.skyLightColor.xyz), s.MaterialAO);
  s.reflected = real3(R(0.0));
  s.capture = captureOf(p);
  s.frame = mobileFrame(r.normal, p.V);
  s.NoV = viewCosine(kEnvironmentBrdf, s.frame);
  bool nonmetal = hasFeature(kFeatureNonmetal, p.material);
#ifdef PARITY_LOBES
  s.layers = makeLayers(r, s.GBuffer, s.frame, s.NoV, s.fullyRough);
  if (dimsSpecular && hasFeature(kFeatureCoat, p.material)) nonmetal = false;
#endif
  s.context = initShadingModelContext(environmentBrdf, nonmetal, s.fullyRough, s.GBuffer, s.NoV);
  if (!kIsRefit || s.fullyRough) return s;
  s.widePart = s.context.lobe.multiple;
  if (!hasEnvironment()) return s;
  s.tap = refitTap(s.context.Roughness, s.NoV);
  real3 wide = product(s.context.SpecularColor, s.tap.wide);
  s.narrowPart = real3(s.context.SpecularColor.x - wide.x, s.context.SpecularColor.y - wide.y,
                       s.context.SpecularColor.z - wide.z);
  s.widePart = s.onlyNonmetals ? wide : add(s.widePart, wide); // of nonmetals nothing scatters more than once
  return s;
}

real4 readLightmapLQ(uint i, Point p, real3 N) {
  vec4 place = surfaceLightmap[i];
  GpuLightmapScales scaling = lightmapScales[p.instance];
  LightmapScales scales = LightmapScales(scaling.scale0.xyz, scaling.add0.xyz, scaling.scale1.xyz, scaling.scale1.w,
                                         scaling.add1.xyz, scaling.add1.w);
  return GetLightMapColorLQ(real3(readLightmap(place, 0.0).xyz), real4(readLightmap(place, 1.0)), scales, vec3(N));
}

// ComputeIndirect. An object with a lightmap has the sky's light in it (no ENABLE_SKY_LIGHT). Of refit the lightmap's light
// scatters more than once between microfacets, too: as the high-end path has it, with the reflected light; and the lobe's
// wide part takes it in place of the sky's.
void computeIndirect(inout BasePass pass, inout Shaded s, Point p, uint i) {
  bool isBaked = hasLightmap(i);
  real4 LightmapColor = real4(R(0.0));
  if (isBaked) LightmapColor = readLightmapLQ(i, p, s.frame.N);
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
void addDirectionalLight(inout BasePass pass, Shaded s, Point p, uint i) {
  real Shadow = R(1.0); // GetPrimaryPrecomputedShadowMask: of a distance field, where one is baked
  if ((kBaked & kBakedSunShadow) != 0u && surfaceLightmap[i].z > 0.5)
    Shadow = distanceFieldShadow(real(readSunShadow(i)), view.path[kPathAverageBrightness].y);
  if ((kShadowMaps & kShadowOfSun) != 0u && directionalCount() != 0u) Shadow = min(Shadow, sunShadow(lights[0], p));
  show(kViewShadow, Shadow);
  if (directionalCount() == 0u) return;
  real3 N = s.frame.N;
  vec3 L = -lights[0].directionCosOuter.xyz;
  vec3 DirectionalLightColor = lights[0].colorRange.xyz * 0.318309886183790672 * float(Shadow);
  real SpecularScale = real(lights[0].cone.y);
  MobileDirectLighting Lighting = mobileIntegrateBxDF(s.sun, s.fullyRough, s.context, s.frame, L);
#ifdef PARITY_LOBES
  addLayersLight(pass, s.layers, s.frame, s.NoV, DirectionalLightColor, L, SpecularScale, Lighting);
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
  real mip = mipFromRoughness(s.context.Roughness);
  if (kIsRefit) {
    direction = refitDirection(s.frame.N, s.frame.V, s.NoV, s.tap.lean);
    mip = s.tap.mip;
  }
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

// AccumulateLightingOfDynamicPointLight, for the lights chosen per object.
void addLocalLights(inout BasePass pass, Shaded s, Point p) {
  real3 sum = real3(R(0.0));
  for (uint k = 0u; k < kLightsPerObject; ++k) {
    uint index = pathData[p.instance * kLightsPerObject + k];
    if (index == kNoLight) break;
    GpuLight light = lights[index];
    MobileLocalLight seen =
        localLightAt(falloffOf(light), light.positionKind.xyz - p.position, light.colorRange.xyz, light.colorRange.w,
                     light.falloff.y, uint(light.positionKind.w) == kLightSpot, light.directionCosOuter.xyz,
                     light.cone.x, light.directionCosOuter.w);
    if ((kShadowMaps & kShadowOfSpot) != 0u) seen.color *= float(spotShadow(light, p));
    real SpecularScale = real(light.cone.y);
    MobileDirectLighting Lighting = mobileIntegrateBxDF(s.sun, s.fullyRough, s.context, s.frame, seen.L);
#ifdef PARITY_LOBES
    addLayersLight(pass, s.layers, s.frame, s.NoV, seen.color, seen.L, SpecularScale, Lighting);
#endif
    real3 lit = clampContribution65000(lightWith(seen.color, Lighting, SpecularScale));
    addLight(pass, kTermLocalDiffuse, seen.color, Lighting, SpecularScale, lit);
    sum = add(sum, lit);
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

void showEnvironmentBrdf(Shaded s) {
  real2 AB = environmentBrdfAB(kEnvironmentBrdf, s.fullyRough, s.context.SpecPreEnvBrdf, s.context.Roughness, s.NoV);
  show(kViewEnvBrdfA, AB.x);
  show(kViewEnvBrdfB, AB.y);
  show(kViewEnvBrdf, s.fullyRough ? product(s.context.SpecPreEnvBrdf, AB.x) : s.context.SpecularColor);
  if (kIsRefit && !s.fullyRough) show(kViewEnvBrdfMultiple, s.context.lobe.multiple);
}

void showShaded(Shaded s, Resolved r) {
  showEnvironmentBrdf(s);
  show(kViewSkyDiffuseLighting, s.SkyDiffuseLighting);
  show(kViewDiffuseLookup, s.DiffuseLookup);
  show(kViewSkyLightColor, real3(view.skyLightColor.xyz));
  show(kViewIndirectIrradiance, s.IndirectIrradiance);
  show(kViewDiffuseColor, s.context.DiffuseColor);
  show(kViewSpecPreEnvBrdf, s.context.SpecPreEnvBrdf);
  show(kViewSpecularColor, s.context.SpecularColor);
  show(kViewDielectricSpecular, s.GBuffer.DielectricSpecular);
  show(kViewBaseColor, s.GBuffer.BaseColor);
  show(kViewMetallic, s.GBuffer.Metallic);
  show(kViewRoughness, s.context.Roughness);
  show(kViewMaterialAO, s.MaterialAO);
  show(kViewOpacity, real(r.opacity));
  show(kViewNoV, s.NoV);
  show(kViewWorldNormal, s.frame.N);
  show(kViewReflectionVector, s.frame.reflection);
}

void main() {
  uint local = entryIndex();
  if (local >= count) return;
  uint i = first + local;
  Point p = makePoint(i);
  Resolved r = resolveMaterial(p, i);
  BasePass pass;
  pass.Color = real3(R(0.0));
  pass.terms = noTerms();
#ifdef PARITY_LOBES
  pass.coat = pass.sheen = real3(R(0.0));
#endif
  if (hasFeature(kFeatureUnlit, p.material)) {
    pass.Color = narrow(r.baseColor);
    addTerm(pass, kTermEmissive, pass.Color);
    show(kViewEmissive, pass.Color);
    show(kViewBaseColor, pass.Color);
    show(kViewOpacity, real(r.opacity));
    writePass(i, pass, r.opacity);
    return;
  }

  Shaded s = makeShaded(p, r);
  computeIndirect(pass, s, p, i);
  addDirectionalLight(pass, s, p, i);
  show(kViewColorAfterIBL, narrow(widen(pass.Color)));
  if (hasEnvironment() && !s.fullyRough) addReflectedEnvironment(pass, s);
  if (localCount() != 0u) addLocalLights(pass, s, p);
  if (hasEnvironment()) addSkyLight(pass, s);
  real3 Emissive = narrow(r.emissive);
#ifdef PARITY_LOBES
  layOver(pass, s.layers);
  Emissive = product(Emissive, s.layers.belowCoat);
#endif
  pass.Color = add(pass.Color, Emissive);
  addTerm(pass, kTermEmissive, Emissive);
  show(kViewEmissive, Emissive);
  showShaded(s, r);
  writePass(i, pass, r.opacity);
}
