// The mobile path: Karis 2014 ("Physically Based Shading on Mobile") and Unreal Engine 4's mobile base pass (2020), in
// the order in which the base pass adds up. Compiled in fp32 and, with PARITY_FP16, in half.
#include "gpu/shaders/path.glsl"
#include "mobile/shaders/views.h"
#include "shading/mips.glsl"
#include "shading/mobile_base_pass.glsl"
#ifdef PARITY_LOBES
#include "shading/mobile_lobes.glsl"
#include "shading/mobile_microfacets.glsl"
#include "shading/mobile_transmission.glsl"
#include "shading/refraction.glsl"
#endif
#include "shading/rgbm.glsl"
#include "shading/tinted_sky.glsl"
#include "shading/sky_sh.glsl"

// The knobs of a preset (mobile/options.h): specialization constants, or with PARITY_WIDE data, so that one program serves
// every set of them.
#ifdef PARITY_WIDE
const uint kKnobWords = 22u; // at the head of pathData, in the order of the constants
#define kEnvironmentBrdf int(pathData[0])
#define kSun int(pathData[1])
#define kCaptureScale int(pathData[2])
#define kSkyForm int(pathData[3])
#define kRgbmCapture pathData[4]
#define kRoughnessFloor uintBitsToFloat(pathData[5])
#define kView pathData[6]
#define kShadowMaps pathData[7]
#define kBaked pathData[8]
#define kFalloffs pathData[9]
#define kCoat int(pathData[10])
#define kSheen int(pathData[11])
#define kAnisotropy int(pathData[12])
#define kIridescence int(pathData[13])
#define kTransmission int(pathData[14])
#define kDiffuseTransmission int(pathData[15])
#define kForceFullyRough pathData[16]
#define kForceNonmetal pathData[17]
#define kParallax pathData[18]
#define kLightCap pathData[19]
#define kPixelFog pathData[20]
#define kLightmapForm int(pathData[21])
#else
const uint kKnobWords = 0u;
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
layout(constant_id = 20) const int kAnisotropy = 0;   // kAnisotropy... of shading/mobile_microfacets.glsl
layout(constant_id = 21) const int kIridescence = 0;  // kIridescence...
layout(constant_id = 22) const int kTransmission = 0; // kTransmission... of shading/mobile_transmission.glsl
layout(constant_id = 23) const int kDiffuseTransmission = 0; // kDiffuseTransmission...
layout(constant_id = 24) const uint kForceFullyRough = 0u;
layout(constant_id = 25) const uint kForceNonmetal = 0u;
layout(constant_id = 26) const uint kParallax = 0u;
layout(constant_id = 27) const uint kLightCap = 1u;     // four local lights an object; 0: all that there are
layout(constant_id = 28) const uint kPixelFog = 0u;     // 0: fog of the vertices
layout(constant_id = 29) const int kLightmapForm = 0;   // kLightmapForm... below
#endif
#include "gpu/shaders/baked.glsl"
#include "gpu/shaders/fog.glsl"
#include "gpu/shaders/local_light.glsl"
#include "gpu/shaders/shadow_map.glsl"
#include "mobile/shaders/shadow_maps.glsl"

vec3 readFrom = vec3(0.0); // the pixel's position: where captures are read from, and how far fog reaches
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
  if (kWriteTerms == 0u) return;
  if (writesTerm(uint(term))) pass.terms.t[term] = vec3(narrow(widen(add(real3(pass.terms.t[term]), value))));
}

// What has been added up leaves as the target holds it: behind the fog, premultiplied, and finite unless it is NaN.
void writePass(uint i, BasePass pass, float opacity) {
  real3 Color = narrow(widen(pass.Color));
  real3 VertexFog = real3(R(0.0));
  real VertexFogA = R(1.0);
  if (hasVertexData(kVertexFog)) {
    vec4 fog = vertexFog(i);
    if (kPixelFog != 0u) fog = fogAt(readFrom);
    VertexFog = narrow(fog.xyz);
    VertexFogA = real(fog.w);
    Color = narrow(widen(add(product(Color, VertexFogA), VertexFog)));
    for (int k = 0; k < kTermCount; ++k) pass.terms.t[k] *= float(VertexFogA);
    addTerm(pass, kTermFog, VertexFog);
  }
#ifdef PARITY_OWN_presetEncode
  Color = presetEncode(Color);
#endif
  show(kViewVertexFog, VertexFog);
  show(kViewVertexFogA, VertexFogA);
  if ((kMayFeatures & kFeatureBlend) != 0u) { // opacity is 1 else
    Color = product(Color, real(opacity));
    shown *= opacity;
    for (int k = 0; k < kTermCount; ++k) pass.terms.t[k] *= opacity;
  }
  writeColor(i, kView == kViewLit ? vec3(Color) : shown, opacity);
  writeTerms(i, pass.terms);
}

MobileMaterial makeMaterial(Resolved r) {
  MobileMaterial m;
  m.BaseColor = real3(r.baseColor);
  m.Metallic = real(r.metallic);
  m.DielectricSpecular = real3(r.F0);
  m.F90 = real(r.F90);
  m.Roughness = real(kRoughnessFloor > 0.0 ? max(kRoughnessFloor, r.roughness) : r.roughness);
  if (kForceNonmetal != 0u) { // NONMETAL of the base pass
    m.Metallic = R(0.0);
    m.DielectricSpecular = real3(R(0.04));
    m.F90 = R(1.0);
  }
  return m;
}

// Enumerators of mobile/options.h.
const int kSkyFormSh4 = 0;
const int kSkyFormSh9 = 1;
const int kSkyFormTinted = 2;
const int kLightmapFormLq = 0;
const int kLightmapFormHq = 1;

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
#ifdef PARITY_OWN_presetSkyDiffuse
  return presetSkyDiffuse(skySh(), N);
#endif
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

// Of the capture, for what is not refit's own.
real captureMip(real Roughness) {
#ifdef PARITY_OWN_presetCaptureMip
  return presetCaptureMip(Roughness);
#else
  return mipFromRoughness(Roughness);
#endif
}

// One fetch of the capture, trilinear, from one lobe to one three times as wide; with kParallax of what is seen from here on
// the walls of the capture's box.
real3 fetchCapture(vec3 direction, real mip, uint capture) {
  if (kParallax != 0u && (kBaked & kBakedCaptures) != 0u)
    direction = boxParallax(readFrom, direction, captures[capture].boxLower.xyz, captures[capture].boxUpper.xyz,
                            captures[capture].position.xyz);
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
#include "mobile/shaders/microfacets.glsl"
#include "mobile/shaders/lobes.glsl"
#include "mobile/shaders/transmission.glsl"
#endif

// What the lights read of one pixel.
struct Shaded {
#ifdef PARITY_LOBES
  Layers layers;
  Microfacets microfacets;
  Through through;
  vec3 readDirection; // of the reflected environment
  real readMip;
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

#ifdef PARITY_WIDE
#define kIsRefit (kEnvironmentBrdf == kEnvironmentBrdfRefit)
#define kSkyAtOnce (kIsRefit && kCaptureScale == kCaptureScaleOcclusion)
#else
const bool kIsRefit = kEnvironmentBrdf == kEnvironmentBrdfRefit;
// Reflected and diffuse light of the sky are multiplied by skyInOcclusion together, and saturate once: nine operations fewer.
const bool kSkyAtOnce = kIsRefit && kCaptureScale == kCaptureScaleOcclusion;
#endif

Shaded makeShaded(Point p, Resolved r) {
  Shaded s;
  s.fullyRough = kForceFullyRough != 0u || hasFeature(kFeatureFullyRough, p.material);
  // Nonmetals of a bin of their own: fewer operations, the same colour.
  s.onlyNonmetals = kForceNonmetal != 0u || (kMustFeatures & kFeatureNonmetal) != 0u;
#ifdef PARITY_LOBES
  bool dimsSpecular = kCoat == kCoatUE4 && showsCoat(); // its Specular changes with the view
  if (dimsSpecular || showsFilm()) s.onlyNonmetals = false;
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
  bool nonmetal = kForceNonmetal != 0u || hasFeature(kFeatureNonmetal, p.material);
#ifdef PARITY_LOBES
  s.microfacets = makeMicrofacets(r, s.GBuffer, s.frame, s.NoV, s.fullyRough);
  s.layers = makeLayers(r, s.GBuffer, s.frame, s.NoV, s.fullyRough);
  if (dimsSpecular && hasFeature(kFeatureCoat, p.material)) nonmetal = false;
  if (showsFilm() && hasFeature(kFeatureIridescence, p.material)) nonmetal = false;
#endif
  s.context = initShadingModelContext(environmentBrdf, nonmetal, s.fullyRough, s.GBuffer, s.NoV);
#ifdef PARITY_LOBES
  s.through = makeThrough(r, s.context, s.GBuffer, s.fullyRough);
  s.readDirection = vec3(s.frame.reflection);
  s.readMip = R(0.0);
#endif
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

#include "mobile/shaders/base_pass.glsl"

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

#ifdef PARITY_PROBE
void shadePoint() {
#else
void main() {
#endif
  uint i = surfaceEntry();
  Point p = makePoint(i);
  readBakedPlace(i);
  readFrom = p.position;
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
  computeIndirect(pass, s, p);
  addDirectionalLight(pass, s, p);
  show(kViewColorAfterIBL, narrow(widen(pass.Color)));
  if (hasEnvironment() && !s.fullyRough) addReflectedEnvironment(pass, s);
  if (localCount() != 0u) addLocalLights(pass, s, p);
  if (hasEnvironment()) addSkyLight(pass, s);
#ifdef PARITY_LOBES
  if (!s.fullyRough)
    addThroughEnvironment(pass, s.through, r, p, s.frame, s.context.Roughness, s.readDirection, s.readMip, s.capture, s.MaterialAO);
#endif
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
