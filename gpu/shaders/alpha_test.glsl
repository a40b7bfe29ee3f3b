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
layout(location = 0) out uvec2 outIds; // instance + 1 (0: nothing), triangle

// Samples a texture: to be called before any branch, for its derivatives.
bool passesAlphaTest() {
  uint material = instances[instance].geometry.z;
  GpuTextureSlot slot = materials[material].slots[kSlotBaseColor];
  vec2 uv = slot.uvRow0.w > 0.5 ? inUv.zw : inUv.xy;
  vec2 st = vec2(dot(slot.uvRow0.xyz, vec3(uv, 1.0)), dot(slot.uvRow1.xyz, vec3(uv, 1.0)));
  float texel = texture(baseColorTexture, st).a;
  float alpha = materials[material].baseColor.a * inAlpha * (slot.uvRow1.w > 0.5 ? texel : 1.0);
  return !(alpha < materials[material].factors.w);
}
