// The same with the alpha test, by the material's own texture: decided once, for all paths. For blended surfaces the cutoff is
// 1/255: what would not be seen does not hide what lies behind.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/geometry.glsl"

layout(push_constant) uniform Push {
  mat4 toClip;
  uint instance;
  uint vertexData;
};
layout(set = 0, binding = 7, std430) readonly buffer Materials { GpuMaterial materials[]; };
layout(set = 1, binding = 0) uniform sampler2D baseColorTexture;

layout(location = 0) in vec4 inUv;
layout(location = 1) in float inAlpha;
layout(location = 0) out uvec2 outIds;

void main() {
  uint material = instances[instance].geometry.z;
  GpuTextureSlot slot = materials[material].slots[kSlotBaseColor];
  vec2 uv = slot.uvRow0.w > 0.5 ? inUv.zw : inUv.xy;
  vec2 st = vec2(dot(slot.uvRow0.xyz, vec3(uv, 1.0)), dot(slot.uvRow1.xyz, vec3(uv, 1.0)));
  float texel = texture(baseColorTexture, st).a; // sampled before any branch: derivatives
  float alpha = materials[material].baseColor.a * inAlpha * (slot.uvRow1.w > 0.5 ? texel : 1.0);
  if (alpha < materials[material].factors.w) discard;
  outIds = uvec2(instance + 1u, uint(gl_PrimitiveID));
}
