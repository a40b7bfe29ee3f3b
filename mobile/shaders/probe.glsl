// The functions of the mobile path by themselves: one call for each invocation. It comes behind mobile.glsl, and behind the
// functions of a preset folder, with PARITY_PROBE.
#include "mobile/shaders/probe.h"

layout(set = 2, binding = 0, std430) readonly buffer ProbeCalls { ProbeCall probeCalls[]; };
layout(set = 2, binding = 1, std430) writeonly buffer ProbeResults { vec4 probeResults[]; };

// Unit vector at a cosine to the z axis, and an azimuth.
vec3 probeDirection(float cosine, float azimuth) {
  float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  return vec3(sine * cos(azimuth), sine * sin(azimuth), cosine);
}

MobileMaterial probeMaterial(ProbeCall call) {
  MobileMaterial m;
  m.BaseColor = real3(R(0.0));
  m.Metallic = R(0.0);
  m.DielectricSpecular = real3(real(call.F0));
  m.F90 = R(1.0);
  m.Roughness = real(max(call.roughness, kRoughnessFloor));
  return m;
}

vec4 probe(ProbeCall call) {
  if (call.function == kProbeFalloff)
#ifdef PARITY_OWN_presetDistanceFalloff
    return vec4(presetDistanceFalloff(kFalloffKhr, call.x * call.x, call.y, 0.0));
#else
    return vec4(distanceFalloff(kFalloffKhr, call.x * call.x, call.y, 0.0));
#endif
  if (call.function == kProbeCone)
#ifdef PARITY_OWN_presetSpotCone
    return vec4(float(presetSpotCone(real(call.x), real(call.y), real(call.z))));
#else
    return vec4(float(spotAttenuation(real(call.x), real(call.y), real(call.z))));
#endif
  if (call.function == kProbeMip)
#ifdef PARITY_OWN_presetCaptureMip
    return vec4(float(presetCaptureMip(real(max(call.roughness, kRoughnessFloor)))));
#else
    return vec4(float(mipFromRoughness(real(max(call.roughness, kRoughnessFloor)))));
#endif
  if (call.function == kProbeEncode)
#ifdef PARITY_OWN_presetEncode
    return vec4(vec3(presetEncode(real3(real(call.x), real(call.y), real(call.z)))), 1.0);
#else
    return vec4(vec3(real(call.x), real(call.y), real(call.z)), 1.0);
#endif
  MobileFrame f = mobileFrame(vec3(0.0, 0.0, 1.0), probeDirection(call.NoV, 0.0));
  real NoV = viewCosine(kEnvironmentBrdf, f);
  MobileShadingModelContext c =
      initShadingModelContext(kEnvironmentBrdf, call.function == kProbeNonmetal, false, probeMaterial(call), NoV);
  if (call.function == kProbeEnvironmentBrdf || call.function == kProbeNonmetal) {
    real2 AB = environmentBrdfAB(kEnvironmentBrdf, false, c.SpecPreEnvBrdf, c.Roughness, NoV);
    return vec4(float(AB.x), float(AB.y), float(c.SpecularColor.x), float(NoV));
  }
  int lobe = kSun;
#ifdef PARITY_OWN_presetLocalLobe
  if (call.function == kProbeLocalLobe && lobe == kSunOwn) lobe = kSunOwnLocal;
#endif
  vec3 L = probeDirection(call.x, call.y);
  return vec4(vec3(mobileIntegrateBxDF(lobe, false, c, f, L).Specular), float(cosineOf(f.N, L)));
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < uint(probeCalls.length())) probeResults[i] = probe(probeCalls[i]);
}
