// Comparisons of halves, of numbers with constants, and the least and the greatest of two halves.
#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer Numbers { float numbers[]; };
layout(set = 0, binding = 1) writeonly buffer Results { uint results[]; }; // 5 words each

const float16_t kSmall = 6.0e-8hf, kOne = 1.0hf, kLargest = 65504.0hf;

uint bit(bool b, uint place) { return b ? 1u << place : 0u; }

uint compare(float16_t a, float16_t b) {
  return bit(a < b, 0u) | bit(a <= b, 1u) | bit(a > b, 2u) | bit(a >= b, 3u) | bit(a == b, 4u) | bit(a != b, 5u);
}
uint compare(float a, float b) {
  return bit(a < b, 0u) | bit(a <= b, 1u) | bit(a > b, 2u) | bit(a >= b, 3u) | bit(a == b, 4u) | bit(a != b, 5u);
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(numbers.length())) return;
  float x = numbers[i];
  float16_t a = float16_t(x), b = float16_t(numbers[i ^ 1u]), near = float16_t(numbers[i ^ 2u]);
  results[5u * i] = compare(a, b) | compare(a, kSmall) << 6 | compare(kOne, a) << 12 | compare(a, kLargest) << 18;
  // A driver may turn these comparisons of the widened half into comparisons of halves.
  float wide = float(a);
  results[5u * i + 1u] = compare(wide, 0.0) | compare(-2.5, wide) << 6 | compare(x, 65504.0) << 12 | compare(x, 0.1) << 18 |
                         bit(x > wide, 24u);
  results[5u * i + 2u] = packFloat2x16(f16vec2(min(a, b), max(a, b)));
  results[5u * i + 3u] = packFloat2x16(f16vec2(max(kOne, a), min(max(a, 0.0hf), kOne)));
  results[5u * i + 4u] = compare(a, near) | (packFloat2x16(f16vec2(max(a, near), 0.0hf)) & 0xffffu) << 16;
}
