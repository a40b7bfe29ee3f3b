// Writes which triangle is seen.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/interface.h"

layout(push_constant) uniform Push {
  mat4 toClip;
  uint instance;
  uint vertexData;
};
layout(location = 0) out uvec2 outIds; // instance + 1 (0: nothing), triangle

void main() { outIds = uvec2(instance + 1u, uint(gl_PrimitiveID)); }
