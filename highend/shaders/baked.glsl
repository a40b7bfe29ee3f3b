// Captures as the high-end path reads them: blended by distance, with box parallax. To be included behind path.glsl, sky.glsl
// and kBaked.
#include "gpu/shaders/baked.glsl"
#include "shading/capture.glsl"

// How captures share in a point: by captureWeight, normalised; beyond the radius of all, the nearest alone.
struct CaptureBlend {
  vec3 position;
  float scale; // of the weights; 0: the nearest
  uint nearest;
  float averageBrightness; // of the blend
};

CaptureBlend captureBlendAt(vec3 position) {
  CaptureBlend blend;
  blend.position = position;
  blend.nearest = 0u;
  float sum = 0.0, brightness = 0.0, nearest = 3e38;
  for (uint k = 0u; k < captureHead.x; ++k) {
    float d = length(position - captures[k].position.xyz), weight = captureWeight(d, captures[k].position.w);
    sum += weight;
    brightness += weight * captures[k].boxLower.w;
    if (d < nearest) {
      nearest = d;
      blend.nearest = k;
    }
  }
  blend.scale = sum > 0.0 ? 1.0 / sum : 0.0;
  blend.averageBrightness = sum > 0.0 ? brightness / sum : captures[blend.nearest].boxLower.w;
  return blend;
}

vec3 capturedRadiance(CaptureBlend blend, vec3 direction, float mip) {
  vec3 radiance = vec3(0.0);
  for (uint k = 0u; k < captureHead.x; ++k) {
    GpuCapture capture = captures[k];
    float weight = captureWeight(length(blend.position - capture.position.xyz), capture.position.w) * blend.scale;
    if (blend.scale == 0.0 && k == blend.nearest) weight = 1.0;
    if (weight == 0.0) continue;
    vec3 seen = boxParallax(blend.position, direction, capture.boxLower.xyz, capture.boxUpper.xyz, capture.position.xyz);
    radiance += weight * skyRadianceAtMip(seen, mip, int(k));
  }
  return radiance;
}
