// What the fragments of masked and blended surfaces read: the alpha test by the material's own texture, decided once,
// for all paths. For blended surfaces the cutoff is 1/255: what would not be seen does not hide what lies behind.
#include "gpu/shaders/geometry.glsl"

layout(push_constant) uniform Push {
  mat4 toClip;
  uint instance;
  uint vertexData;
  uint layer; // of blended surfaces, from the front
};
layout(set = 0, binding = 7, std430) readonly buffer Materials { GpuMaterial materials[]; };
layout(set = 1, binding = 0) uniform sampler2D baseColorTexture;

layout(location = 0) in vec4 inUv;
layout(location = 1) in float inAlpha;
// To be called before any branch, for the derivatives of what is interpolated. Those of the texture's coordinates are
// made from them here, not taken: helper invocations, which complete a quad at a triangle's edge, may read no buffers.
bool passesAlphaTest() {
  vec4 uvDx = dFdx(inUv), uvDy = dFdy(inUv);
  uint material = instances[instance].geometry.z;
  GpuTextureSlot slot = materials[material].slots[kSlotBaseColor];
  bool second = slot.uvRow0.w > 0.5;
  vec2 uv = second ? inUv.zw : inUv.xy, dx = second ? uvDx.zw : uvDx.xy, dy = second ? uvDy.zw : uvDy.xy;
  vec2 st = vec2(dot(slot.uvRow0.xyz, vec3(uv, 1.0)), dot(slot.uvRow1.xyz, vec3(uv, 1.0)));
  vec2 stDx = vec2(dot(slot.uvRow0.xy, dx), dot(slot.uvRow1.xy, dx));
  vec2 stDy = vec2(dot(slot.uvRow0.xy, dy), dot(slot.uvRow1.xy, dy));
  float texel = textureGrad(baseColorTexture, st, stDx, stDy).a;
  float alpha = materials[material].baseColor.a * inAlpha * (slot.uvRow1.w > 0.5 ? texel : 1.0);
  return !(alpha < materials[material].factors.w);
}
