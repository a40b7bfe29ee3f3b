// Casters of shadows where the alpha test lets them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/alpha_test.glsl"

void main() {
  if (!passesAlphaTest()) discard;
}
