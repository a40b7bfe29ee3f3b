// Clear coat and sheen over the base, where the permutation has them: docs/shading.md 10. What a layer leaves of the light
// to those below it depends on the view alone.
#include "shading/sheen.glsl"

struct Layers {
  Shader coat;     // of F0 .04, with its own normal; its `single` is its albedo
  float coatShare; // of the surface
  float belowCoat; // what the coat leaves, [0, 1]
  vec3 sheenColor;
  float sheenRoughness, sheenAlpha;
  float belowSheen;                  // what the sheen leaves, [0, 1]
  vec3 coatReflected, sheenReflected; // of the environment
};

// Below this roughness the lobe is so narrow that it takes many points.
const float kSmoothSheen = 0.25;
const float kCoatF0 = 0.04; // KHR_materials_clearcoat: an index of refraction of 1.5

// Directional albedo of the sheen's lobe at sheenColor 1.
float sheenAlbedo(float cosine, float roughness) {
  vec2 size = vec2(textureSize(pathTexture, 0));
  return textureLod(pathTexture, (vec2(cosine, roughness) * (size - 1.0) + 0.5) / size, 0.0).w;
}

Shader makeCoat(Shader base, Resolved m) {
  Shader c = base;
  c.N = m.coatNormal;
  c.anisotropy = c.film = 0.0;
  c.sumAtRim = 1.0; // Fresnel's reflectance is high there
  c.NoV = clamp(dot(c.N, c.V), kMinNoV, 1.0);
  c.roughness = c.perceptual = m.coatRoughness;
  c.alpha = sqr(max(m.coatRoughness, kMinLightRoughness));
  c.diffuseColor = vec3(0.0);
  c.F0 = vec3(kCoatF0);
  c.F90 = 1.0;
  vec2 AB = environmentBrdf(c.NoV, c.roughness).xy;
  c.single = vec3(kCoatF0 * AB.x + AB.y);
  c.factor = vec3(1.0);
  c.multiple = vec3(0.0); // what it loses between its facets goes to the base
  c.Eavg = 1.0;
  return c;
}

Layers makeLayers(Shader base, Resolved m) {
  Layers l;
  l.coat = base;
  l.coatShare = m.coat;
  l.belowCoat = l.belowSheen = 1.0;
  l.sheenColor = m.sheenColor;
  l.sheenRoughness = m.sheenRoughness;
  l.sheenAlpha = sheenAlpha(m.sheenRoughness);
  l.coatReflected = l.sheenReflected = vec3(0.0);
  if ((kMayFeatures & kFeatureCoat) != 0u) {
    l.coat = makeCoat(base, m);
    l.belowCoat = 1.0 - m.coat * saturate(l.coat.single.x);
  }
  if ((kMayFeatures & kFeatureSheen) != 0u) {
    float strongest = max(max(m.sheenColor.x, m.sheenColor.y), m.sheenColor.z);
    l.belowSheen = 1.0 - strongest * saturate(sheenAlbedo(base.NoV, m.sheenRoughness));
  }
  return l;
}

// D V of the sheen's lobe. NoL > 0.
float sheenLobe(Layers l, float viewLambda, float NoV, float NoL, float NoH) {
  float V = 1.0 / max((1.0 + viewLambda + charlieLambda(l.sheenAlpha, NoL)) * 4.0 * NoV * NoL, kSmallest);
  return D_Charlie(l.sheenAlpha, NoH) * V;
}

// illuminance: of a surface that faces the light, from direction L.
void addLayersLight(inout Terms terms, Layers l, Shader base, vec3 L, vec3 illuminance) {
  if ((kMayFeatures & kFeatureCoat) != 0u) {
    float NoL = saturate(dot(l.coat.N, L));
    vec3 H = safeNormalize(l.coat.V + L, l.coat.N);
    if (NoL > 0.0)
      terms.t[kTermCoatSpecular] += illuminance * scatteredOnce(l.coat, l.coat.alpha, NoL, saturate(dot(l.coat.N, H)),
                                                                saturate(dot(l.coat.V, H)));
  }
  if ((kMayFeatures & kFeatureSheen) != 0u) {
    float NoL = saturate(dot(base.N, L));
    vec3 H = safeNormalize(base.V + L, base.N);
    float viewLambda = charlieLambda(l.sheenAlpha, base.NoV);
    if (NoL > 0.0)
      terms.t[kTermSheen] +=
          illuminance * l.sheenColor * NoL * sheenLobe(l, viewLambda, base.NoV, NoL, saturate(dot(base.N, H)));
  }
}

// The environment by the sheen's lobe: a sum over the points that stand for it (lighting/environment/median_cut.h). Of
// captures, which have none, the roughest level about the normal.
vec3 reflectedBySheen(Layers l, Shader base) {
  if ((kBaked & kBakedCaptures) != 0u)
    return capturedRadiance(base.captures, base.N, float(kPrefilterRoughestMip)) *
           sheenAlbedo(base.NoV, l.sheenRoughness);
  bool isSmooth = l.sheenRoughness < kSmoothSheen;
  uint begin = isSmooth ? kFewPoints : 0u, end = begin + (isSmooth ? kManyPoints : kFewPoints);
  float viewLambda = charlieLambda(l.sheenAlpha, base.NoV);
  vec3 sum = vec3(0.0);
  for (uint k = begin; k < end; ++k) {
    vec3 L = environmentPoints[k].direction.xyz;
    float NoL = dot(base.N, L);
    if (NoL <= 0.0) continue;
    float NoVL = base.NoV + NoL, VoL = dot(base.V, L);
    float NoH = min(NoVL * inversesqrt(max(2.0 + 2.0 * VoL, 1e-12)), 1.0);
    sum += environmentPoints[k].light.xyz * (NoL * sheenLobe(l, viewLambda, base.NoV, NoL, NoH));
  }
  return sum;
}

// Returns what the base reflects of the environment, before `scale`, which is of the sky's light. base: with its
// captures. One place in the shader for the base and the coat: a driver's compiler takes long for each.
vec3 addLayersReflection(inout Layers l, Shader base, vec3 scale) {
  vec3 ofBase = vec3(0.0);
  int count = (kMayFeatures & kFeatureCoat) != 0u && l.coatShare > 0.0 ? 2 : 1;
  for (int k = 0; k < count; ++k) {
    Shader each = base;
    if (k == 1) {
      each = l.coat;
      each.captures = base.captures;
    }
    vec3 reflected = reflectedLight(each);
    if (k == 0)
      ofBase = reflected;
    else
      l.coatReflected = reflected * scale;
  }
  if ((kMayFeatures & kFeatureSheen) != 0u) l.sheenReflected = l.sheenColor * reflectedBySheen(l, base) * scale;
  return ofBase;
}

// With a lightmap captures follow it, as the base's reflections do.
void scaleLayersReflection(inout Layers l, Shader base, vec3 irradianceOverPi) {
  l.coatReflected *= captureScaleAt(base, irradianceOverPi, l.coat.roughness);
  l.sheenReflected *= captureScaleAt(base, irradianceOverPi, 1.0);
}

// The terms of the base, which are all but those of the layers, dim by what lies over them. Emitted light passes the
// fibres, which are thin, and the coat.
void layOver(inout Terms terms, Layers l) {
  float below = l.belowCoat * l.belowSheen;
  for (int k = 0; k < kTermFog; ++k) terms.t[k] *= k == kTermEmissive ? l.belowCoat : below;
  terms.t[kTermTransmission] *= below;
  terms.t[kTermCoatSpecular] = (terms.t[kTermCoatSpecular] + l.coatReflected) * l.coatShare;
  terms.t[kTermSheen] = (terms.t[kTermSheen] + l.sheenReflected) * l.belowCoat;
}
