// Small pieces whose cost is known; a specialization constant picks one.
#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require
layout(local_size_x = 1) in;
layout(constant_id = 0) const uint kPiece = 0u;
layout(constant_id = 1) const uint kTurns = 1u;
layout(constant_id = 2) const uint kUseSecond = 0u;

layout(set = 0, binding = 0, std430) readonly buffer In { vec4 a, b, c; vec4 list[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { vec4 result; };
layout(set = 1, binding = 2) uniform sampler2D first;
layout(set = 1, binding = 5) uniform sampler2D second;

float sum3(vec3 v) { return v.x + v.y + v.z; }

void main() {
  vec4 r = vec4(0.0);
  if (kPiece == 0u) r.xyz = a.xyz + b.xyz;
  if (kPiece == 1u) r.x = dot(a.xyz, b.xyz);
  if (kPiece == 2u) r.xyz = normalize(a.xyz);
  if (kPiece == 3u) r.x = length(a.xyz);
  if (kPiece == 4u) r.xyz = mix(a.xyz, b.xyz, c.x);
  if (kPiece == 5u) r.xyz = clamp(a.xyz, b.xyz, c.xyz);
  if (kPiece == 6u) r.x = pow(a.x, b.x);
  if (kPiece == 7u) r.xyz = mat3(a.xyz, b.xyz, c.xyz) * list[0].xyz;
  if (kPiece == 8u) r.xyz = cross(a.xyz, b.xyz);
  if (kPiece == 9u) r.xyz = reflect(a.xyz, b.xyz);
  if (kPiece == 10u) r.xyz = vec3(f16vec3(a.xyz) * f16vec3(b.xyz));
  if (kPiece == 11u) r.x = mix(a.x, c.x, a.x > b.x);
  if (kPiece == 12u) {
    r = a;
    for (uint i = 0u; i < kTurns; ++i) r += list[i];
  }
  if (kPiece == 13u) {
    r = a;
    for (int i = 0; i < 4; ++i) {
      if (list[i].x < 0.0) break;
      r += list[i];
    }
  }
  if (kPiece == 14u) {
    r = a;
    for (uint i = 0u; i < floatBitsToUint(b.x); ++i) r *= c;
  }
  if (kPiece == 15u) {
    r = textureLod(first, a.xy, 0.0) * textureLod(first, b.xy, 0.0);
    if (kUseSecond != 0u) r += textureLod(second, c.xy, 0.0) * a;
  }
  if (kPiece == 16u) {
    vec4 unused = sqrt(a) * b;
    r = list[0];
  }
  if (kPiece == 17u) {
    r = a;
    for (int i = 100; i > 0; i -= 5)
      for (int k = 0; k < 30; ++k) r *= list[i + k];
  }
  if (kPiece == 18u) r.x = sum3(a.xyz) * sum3(b.xyz); // a function called twice
  if (kPiece == 19u) r.xyz = fma(a.xyz, b.xyz, c.xyz);
  if (kPiece == 20u) r.x = smoothstep(a.x, b.x, c.x) + exp2(a.y);
  result = r;
}
