// The high-end path: full GGX for every light, environment by prefiltered cube, tabulated environment BRDF and
// irradiance cube.
//
// Colour = diffuse + specular; the diffuse lobe gets what the specular one leaves (kDiffuse).
#include "gpu/shaders/path.glsl"
#include "gpu/shaders/fog.glsl"
#include "highend/shaders/sky.glsl"
#include "highend/shaders/views.h"
#include "shading/brdf.glsl"
#include "shading/lamps.glsl"
#include "shading/off_specular.glsl"

// Values: kGeometry... and so on of interface.h.
layout(constant_id = 8) const uint kGeometryTerm = 0u;
layout(constant_id = 9) const uint kFresnel = 0u;
layout(constant_id = 10) const uint kDiffuse = 0u;
layout(constant_id = 11) const uint kCompensation = 0u;
layout(constant_id = 12) const uint kOffSpecular = 0u;
layout(constant_id = 13) const uint kLocalKinds = 0u; // kLocal... bits
layout(constant_id = 14) const uint kShadows = 0u; // shadow.glsl
layout(constant_id = 15) const uint kBaked = 0u; // kBaked... bits
layout(constant_id = 16) const uint kFalloffs = 0u; // ways in which local lights fade
layout(constant_id = 17) const uint kView = 0u;     // kView... of highend/shaders/views.h
layout(constant_id = 18) const uint kPanorama = 0u; // the panorama is there, and fine levels go with it
layout(constant_id = 19) const uint kLamps = 0u;    // the environment has lamps
#include "gpu/shaders/local_light.glsl"
#include "gpu/shaders/shadow.glsl"
#include "highend/shaders/baked.glsl"

// Of analytic lights only: alpha = 2.4e-4 keeps the peak of D (5e6) far from overflow. The image light has no floor.
const float kMinLightRoughness = 0.015625;
// Grazing and back-facing shading normals: the lobe of the last visible direction.
const float kMinNoV = 1e-4;

vec3 shown = vec3(0.0);
void show(uint view, vec3 value) {
  if (kView == view) shown = value;
}

struct Lobes {
  vec3 diffuse, specular;
};

struct Shader {
  vec3 N, V, diffuseColor, F0;
  float F90, NoV, roughness, alpha; // alpha: of analytic lights
  vec3 single;   // directional albedo of light scattered once, with Turquin's factor where that is chosen
  vec3 factor;   // that factor
  vec3 multiple; // directional albedo of what scatters more often, where it has a lobe of its own
  float Eavg;
  CaptureBlend captures; // where there are any
#ifdef PARITY_LOBES
  vec3 T, B;            // tangent and bitangent of the anisotropy, unit
  float anisotropy;     // 0: none
  float perceptual;     // the material's roughness, which alpha along T and B come from
  float film, filmIor, filmThickness; // film 0: none
  float sumAtRim; // share of a sum in what is reflected of the environment at a grazing angle (reflection.glsl)
  vec3 left; // what the specular lobe leaves to the diffuse one and to what passes through
#endif
};

#ifdef PARITY_PRESET
#include "highend/shaders/preset.glsl"
#endif

bool hasOwnLobe() { return kCompensation == kCompensationFdezAguera || kCompensation == kCompensationKullaConty; }

// A, B and the average of A + B at this roughness.
vec3 environmentBrdf(float cosine, float roughness) {
#ifdef PARITY_OWN_presetEnvironmentBrdf
  return presetEnvironmentBrdf(cosine, roughness);
#endif
  vec2 size = vec2(textureSize(pathTexture, 0));
  return textureLod(pathTexture, (vec2(cosine, roughness) * (size - 1.0) + 0.5) / size, 0.0).xyz;
}

float fresnelWeight(float VoH) {
  if (kFresnel == kFresnelSphericalGaussian) return sphericalGaussianWeight(VoH);
  if (kFresnel == kFresnelDielectric) return dielectricWeight(VoH);
  return schlickWeight(VoH);
}

float fresnelMean() {
  if (kFresnel == kFresnelSphericalGaussian) return sphericalGaussianMean();
  if (kFresnel == kFresnelDielectric) return dielectricMean();
  return schlickMean();
}

#ifdef PARITY_LOBES
#include "highend/shaders/microfacets.glsl"
#else
vec3 fresnelOf(Shader s, float VoH) { return mixFresnel(s.F0, s.F90, fresnelWeight(VoH)); }
#endif

Shader makeShader(Point p, Resolved m) {
  Shader s;
  s.N = m.normal;
  s.V = p.V;
  s.NoV = clamp(dot(s.N, s.V), kMinNoV, 1.0);
  s.roughness = m.roughness;
  s.alpha = sqr(max(m.roughness, kMinLightRoughness));
  s.diffuseColor = diffuseColor(m.baseColor, m.metallic);
  s.F0 = specularColor(m.F0, m.baseColor, m.metallic);
  s.F90 = mix(m.F90, 1.0, m.metallic);
  s.factor = vec3(1.0);
  s.multiple = s.single = vec3(0.0);
  s.Eavg = 1.0;
#ifdef PARITY_LOBES
  s.T = m.tangent;
  s.B = cross(s.N, s.T);
  s.anisotropy = m.anisotropy;
  s.perceptual = m.roughness;
  s.film = m.iridescence;
  s.filmIor = m.filmIor;
  s.filmThickness = m.filmThickness;
  s.sumAtRim = 0.0; // no step where a texture of films or transmission begins
  if ((kMayFeatures & kFeatureIridescence) != 0u) s.sumAtRim = smoothstep(0.0, 0.1, s.film);
  if ((kMayFeatures & kFeatureTransmission) != 0u)
    s.sumAtRim = max(s.sumAtRim, smoothstep(0.0, 0.1, m.transmission * (1.0 - m.metallic)));
  s.left = vec3(1.0);
  s.diffuseColor *= (1.0 - m.transmission) * (1.0 - m.diffuseTransmission);
  if (isAnisotropic(s)) { // of the round lobe that loses about as much between its facets (docs/shading.md 11e)
    vec2 alpha = alphasOf(s, kLeastAlpha);
    s.roughness = sqrt(projectedAlpha(alpha.x, alpha.y, 0.0, 0.0));
  }
#endif
  if (!hasEnvironment() && kCompensation == kCompensationNone && kDiffuse == kDiffuseLambert && kView == kViewLit) return s;

  vec3 ABavg = environmentBrdf(s.NoV, s.roughness);
  vec2 AB = ABavg.xy;
  s.Eavg = ABavg.z;
  vec3 once = s.F0 * AB.x + s.F90 * AB.y, F0 = s.F0, Favg = mixFresnel(s.F0, s.F90, fresnelMean());
  float F90 = s.F90;
#ifdef PARITY_LOBES
  if (isAnisotropic(s) || hasFilm(s)) {
    LobeAlbedo a = lobeAlbedo(s);
    if (isAnisotropic(s)) AB = vec2(a.E - a.B, a.B);
    once = s.F0 * AB.x + s.F90 * AB.y;
    if (hasFilm(s)) { // F0 stands for all of the lobe
      F0 = a.F;
      AB = vec2(AB.x + AB.y, 0.0);
      once = F0 * AB.x;
      Favg = meanFresnelOf(s);
    }
  }
#endif
  if (kCompensation == kCompensationTurquin) s.factor = energyCompensation(F0, AB);
  s.single = once * s.factor;
  if (hasOwnLobe())
    s.multiple = kCompensation == kCompensationFdezAguera ? fdezAgueraAlbedo(F0, F90, Favg, AB)
                                                          : kullaContyAlbedo(Favg, AB.x + AB.y, s.Eavg);
  show(kViewEnvBrdfA, vec3(AB.x));
  show(kViewEnvBrdfB, vec3(AB.y));
  show(kViewEnvBrdf, once);
  show(kViewEnvBrdfMultiple, s.single - once + s.multiple);
  if (kDiffuse == kDiffuseBalanced) {
    vec3 left = albedoScaling(s.single + s.multiple);
    s.diffuseColor *= left;
#ifdef PARITY_LOBES
    s.left = left;
#endif
  }
  return s;
}

// Light scattered once, per illuminance of a surface that faces it. NoL > 0.
vec3 scatteredOnce(Shader s, float alpha, float NoL, float NoH, float VoH) {
  float V = kGeometryTerm == kGeometryHeightCorrelated ? V_SmithGGXCorrelated(alpha, s.NoV, NoL) : V_SchlickSmith(alpha, s.NoV, NoL);
  return (NoL * D_GGX(alpha, NoH) * V) * fresnelOf(s, VoH) * s.factor;
}

// Reflected radiance for an illuminance (on a surface facing the light) from direction L.
Lobes lit(Shader s, vec3 L, vec3 illuminance) {
  Lobes lobes = Lobes(vec3(0.0), vec3(0.0));
  float NoL = saturate(dot(s.N, L));
  if (NoL <= 0.0) return lobes;
  vec3 H = safeNormalize(s.V + L, s.N); // V = -L: the normal
  float NoH = saturate(dot(s.N, H)), VoH = saturate(dot(s.V, H));
  vec3 E = illuminance * NoL;
#ifdef PARITY_OWN_presetDiffuseLobe
  lobes.diffuse = E * presetDiffuseLobe(s, NoL, VoH) * Fd_Lambert();
#else
  lobes.diffuse = E * s.diffuseColor * Fd_Lambert();
#endif
#ifdef PARITY_LOBES
  if (isAnisotropic(s))
    lobes.specular = illuminance * scatteredAnisotropic(s, alphasOf(s, sqr(kMinLightRoughness)), L);
  else
#endif
#ifdef PARITY_OWN_presetDirectLobe
  lobes.specular = illuminance * presetDirectLobe(s, L, NoL, NoH, VoH);
#else
  lobes.specular = illuminance * scatteredOnce(s, s.alpha, NoL, NoH, VoH);
#endif
  if (kCompensation == kCompensationFdezAguera) lobes.specular += E * s.multiple * Fd_Lambert();
  if (kCompensation == kCompensationKullaConty) {
    vec2 AB = environmentBrdf(NoL, s.roughness).xy;
    lobes.specular += E * s.multiple * kullaContyLobe(AB.x + AB.y, s.Eavg);
  }
  return lobes;
}

// Direction to a point or spot light, and its illuminance at the point (scenes::Falloff, KHR_lights_punctual's cone).
vec3 localLight(GpuLight light, vec3 position, out vec3 L) {
  vec3 d = light.positionKind.xyz - position;
  float d2 = dot(d, d);
  L = safeNormalize(d, -light.directionCosOuter.xyz); // at the light itself: as if from its axis
#ifdef PARITY_OWN_presetDistanceFalloff
  float attenuation = presetDistanceFalloff(falloffOf(light), d2, light.colorRange.w, light.falloff.y);
#else
  float attenuation = distanceFalloff(falloffOf(light), d2, light.colorRange.w, light.falloff.y);
#endif
  bool isSpot = kLocalKinds == kLocalSpot || (kLocalKinds == kLocalAll && uint(light.positionKind.w) == kLightSpot);
#ifdef PARITY_OWN_presetSpotCone
  if (isSpot) attenuation *= presetSpotCone(dot(-L, light.directionCosOuter.xyz), light.cone.x, light.directionCosOuter.w);
#else
  if (isSpot) attenuation *= spotAttenuation(dot(-L, light.directionCosOuter.xyz), light.cone.x, light.directionCosOuter.w);
#endif
  return light.colorRange.xyz * attenuation;
}

#include "highend/shaders/reflection.glsl"

// Captures are normalised: they follow the lightmap by the engine's mixing weight; those without a brightness do not.
float captureScaleAt(Shader s, vec3 irradianceOverPi, float roughness) {
  if ((kBaked & kBakedCaptures) == 0u || !(s.captures.averageBrightness > 0.0)) return 1.0;
  return captureScale(kCaptureScaleMixing, luminanceUE4(irradianceOverPi), s.captures.averageBrightness, roughness, 1.0,
                      mixingRange(kMixingBegin, kMixingEnd, kMixingLargest));
}

#ifdef PARITY_LOBES
#include "highend/shaders/lobes.glsl"
#include "highend/shaders/transmission.glsl"

// As visibilityOf, on the other side of the surface.
vec3 lightBehind(GpuLight light, Point p, vec3 L, vec3 illuminance) {
  if (!mayPassThrough()) return vec3(0.0);
  return kShadows != 0u ? illuminance * visibilityOf(light, p.position, -p.geometric, L) : illuminance;
}
#endif

#include "highend/shaders/left_out.glsl"

// Evaluated at the pixel.
Terms inFog(Terms terms, Point p) {
  if (!hasVertexData(kVertexFog)) return terms;
  return seenThrough(fogAt(p.position), terms);
}

void main() {
  uint i = surfaceEntry();
  Point p = makePoint(i);
  readBakedPlace(i);
  Resolved m = resolveMaterial(p, i);
  Terms terms = noTerms();
  if (hasFeature(kFeatureUnlit, p.material)) {
    if (kLightsAlone == 0u) terms.t[kTermEmissive] = m.baseColor;
    terms = inFog(terms, p);
    if (kLeftOut != 0u) {
      for (uint k = 0u; k < kLeftOut; ++k) writePicture(i, k, terms, m.opacity);
      return;
    }
    writeResult(i, terms, m.opacity);
    if (kView != kViewLit) writeColor(i, vec3(0.0), m.opacity);
    return;
  }

  Shader s = makeShader(p, m);
#ifdef PARITY_LOBES
  Layers layers = makeLayers(s, m);
  Through through = makeThrough(s, m);
#endif
  if (kLeftOut != 0u) beginLeftOut();
  for (uint k = 0u; k < directionalCount(); ++k) {
    vec3 L = -lights[k].directionCosOuter.xyz, illuminance = lights[k].colorRange.xyz;
#ifdef PARITY_LOBES
    if (mayPassThrough())
      addThroughLight(terms, through, m, s, L, lightBehind(lights[k], p, L, illuminance), lights[k].cone.y);
#endif
    if (kShadows != 0u) illuminance *= visibilityOf(lights[k], p.position, p.geometric, L);
    if (k == 0u) illuminance *= readSunShadow();
    Lobes lobes = lit(s, L, illuminance);
    terms.t[kTermSunDiffuse] += lobes.diffuse;
    terms.t[kTermSunSpecular] += lobes.specular * lights[k].cone.y;
#ifdef PARITY_LOBES
    addLayersLight(terms, layers, s, L, illuminance * lights[k].cone.y);
#endif
    if (kLeftOut != 0u) shareOut(terms, lights[k]);
  }
  // Those that reach everything, then those in the list of this group of entries (highend/light_culling.h); or all. In
  // the same order, so that the sums are the same to the last bit.
  bool isListed = kLocalCount == kListed || (kLocalCount == kUnknown && pathData[0] != 0u);
  uint group = firstGroup + entryToShade() / kGroupSize;
  uint everywhere = kLocalCount == kListed ? sceneCounts.y : localCount();
  uint begin = isListed ? pathData[1u + group] : 0u;
  uint listed = isListed ? pathData[2u + group] - begin : 0u;
  for (uint n = 0u; n < everywhere + listed; ++n) {
    uint k = directionalCount() + n;
    if (isListed && n >= everywhere) k = pathData[begin + n - everywhere];
    GpuLight light = lights[k];
    vec3 L;
    vec3 illuminance = localLight(light, p.position, L);
    if (illuminance == vec3(0.0)) continue;
#ifdef PARITY_LOBES
    if (mayPassThrough()) addThroughLight(terms, through, m, s, L, lightBehind(light, p, L, illuminance), light.cone.y);
#endif
    if (kShadows != 0u) illuminance *= visibilityOf(light, p.position, p.geometric, L);
    Lobes lobes = lit(s, L, illuminance);
    terms.t[kTermLocalDiffuse] += lobes.diffuse;
    terms.t[kTermLocalSpecular] += lobes.specular * light.cone.y;
#ifdef PARITY_LOBES
    addLayersLight(terms, layers, s, L, illuminance * light.cone.y);
#endif
    if (kLeftOut != 0u) shareOut(terms, light);
  }
  if (hasEnvironment()) {
    if ((kBaked & kBakedCaptures) != 0u) s.captures = captureBlendAt(p.position);
    vec3 irradianceOverPi = hasLightmap() ? vec3(0.0) : skyIrradianceOverPi(s.N); // the sky is in the lightmap
    vec3 scale = view.skyLightColor.xyz * m.occlusion;
    terms.t[kTermSkyDiffuse] = irradianceOverPi * s.diffuseColor * scale;
#ifdef PARITY_LOBES
    vec3 reflected = addLayersReflection(layers, s, scale);
#else
    vec3 reflected = reflectedLight(s);
#endif
    show(kViewSpecularIBL, reflected / max(s.single, vec3(1e-6)) * scale);
    terms.t[kTermSkySpecular] = (reflected + irradianceOverPi * s.multiple) * scale;
  }
  if (hasLightmap()) {
    vec3 irradianceOverPi = lightmapIrradianceOverPi(p, s.N);
    terms.t[kTermSkySpecular] *= captureScaleAt(s, irradianceOverPi, s.roughness);
#ifdef PARITY_LOBES
    scaleLayersReflection(layers, s, irradianceOverPi);
#endif
    vec3 scale = view.indirectColorScale.xyz * m.occlusion;
    terms.t[kTermLightmap] = irradianceOverPi * s.diffuseColor * scale;
    // What scatters more than once is specular, and takes its light from where the diffuse lobe does.
    terms.t[kTermSkySpecular] += irradianceOverPi * s.multiple * scale;
  }
  terms.t[kTermEmissive] = m.emissive;
#ifdef PARITY_LOBES
  if (mayPassThrough()) {
    vec3 sky = view.skyLightColor.xyz;
    vec3 irradianceOverPi = hasEnvironment() ? skyIrradianceOverPi(-s.N) * sky : vec3(0.0);
    addThroughEnvironment(terms, through, m, s, p, sky, irradianceOverPi);
  }
#endif
  if (kLeftOut != 0u) {
    for (uint k = 0u; k < kLeftOut; ++k) {
      Terms each = withLightsBut(k, terms);
#ifdef PARITY_LOBES
      layOver(each, layers);
#endif
      writePicture(i, k, inFog(each, p), m.opacity);
    }
    return;
  }
#ifdef PARITY_LOBES
  layOver(terms, layers);
#endif
  writeResult(i, inFog(terms, p), m.opacity);
  if (kView != kViewLit) writeColor(i, shown, m.opacity);
}
