// Results whose last bits differ between drivers, builds and processors: a row of words for each of 1024 inputs.
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : enable
#include "numerics_interface.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) writeonly buffer Rows { uint rows[]; };
layout(set = 0, binding = 1) uniform sampler2D image;

// A real in [1,2), the same bits everywhere.
float realOf(uint seed) {
  seed = (seed ^ 61u) ^ (seed >> 16);
  seed *= 9u;
  seed ^= seed >> 4;
  seed *= 0x27d4eb2du;
  seed ^= seed >> 15;
  return uintBitsToFloat(0x3f800000u | (seed >> 9));
}

void main() {
  const uint row = gl_GlobalInvocationID.x;
  if (row >= kNumericsRows) return;
  const float x = realOf(2u * row) - 1.0, y = realOf(2u * row + 1u); // [0,1), [1,2)
  const vec4 texel = textureLod(image, vec2(x, y - 1.0) * 1.5 - 0.25, 3.0 * fract(x * 7.0));
  const uint words[kNumericsWords] =
      uint[](floatBitsToUint(x / y), floatBitsToUint(sqrt(x)), floatBitsToUint(inversesqrt(y)),
             floatBitsToUint(exp2(8.0 * (x - 0.5))), floatBitsToUint(log2(x + 1e-6)), floatBitsToUint(pow(x, 5.0 * y)),
             floatBitsToUint(fma(x, y, -0.5)), floatBitsToUint(sin(6.0 * x)), floatBitsToUint(atan(x, y)),
             floatBitsToUint(dot(vec3(x, y, 0.3), vec3(y, -x, 0.7))), packHalf2x16(vec2(x * y, 1.0 / y)),
             floatBitsToUint(texel.x), floatBitsToUint(texel.y), floatBitsToUint(texel.z), floatBitsToUint(texel.w),
#ifdef PARITY_FP16
             packHalf2x16(vec2(float(float16_t(x) / float16_t(y)), float(pow(float16_t(x), float16_t(y)))))
#else
             0u
#endif
      );
  for (uint i = 0u; i < kNumericsWords; ++i) rows[row * kNumericsWords + i] = words[i];
}
