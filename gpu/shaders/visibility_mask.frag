// Writes which triangle is seen, where the alpha test lets it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/alpha_test.glsl"

layout(location = 0) out uvec2 outIds; // instance + 1 (0: nothing), triangle

void main() {
  if (!passesAlphaTest()) discard;
  outIds = uvec2(instance + 1u, uint(gl_PrimitiveID));
}
