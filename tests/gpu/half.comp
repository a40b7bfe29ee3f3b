// Conversions of numbers to half: a scalar, vectors of two to four, and what an image holds.
#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer Numbers { float numbers[]; };
layout(set = 0, binding = 1) writeonly buffer Halves { uint halves[]; }; // 6 words each: one number, two, three, four
layout(set = 0, binding = 2) uniform sampler2D image;
layout(constant_id = 0) const bool kReadsImage = false;

vec4 read(vec2 uv) { return textureLod(image, uv, 0.0); }

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(numbers.length())) return;
  vec4 v = vec4(numbers[i], numbers[i ^ 1u], numbers[i ^ 2u], numbers[i ^ 3u]);
  if (kReadsImage) {
    f16vec2 texel = f16vec2(read(v.xy).xy);
    vec4 kept = vec4(1.0);
    if (v.z > 0.0) kept.yz = textureLod(image, v.zw, 0.0).yw;
    halves[i] = packFloat2x16(texel * float16_t(kept.z));
    return;
  }
  f16vec3 three = f16vec3(v.xyz);
  f16vec4 four = f16vec4(v);
  halves[6u * i] = packFloat2x16(f16vec2(float16_t(v.x), float16_t(0.0)));
  halves[6u * i + 1u] = packFloat2x16(f16vec2(v.xy));
  halves[6u * i + 2u] = packFloat2x16(three.xy);
  halves[6u * i + 3u] = packFloat2x16(f16vec2(three.z, float16_t(0.0)));
  halves[6u * i + 4u] = packFloat2x16(four.xy);
  halves[6u * i + 5u] = packFloat2x16(four.zw);
}
