// Rasterises instance and triangle ids: clip position, and what the alpha test reads.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/geometry.glsl"

layout(push_constant) uniform Push {
  mat4 toClip; // from object space
  uint instance;
  uint vertexData; // bit 0: colours, bit 1: uvs
};

layout(location = 0) out vec4 outUv;
layout(location = 1) out float outAlpha;

void main() {
  gl_Position = toClip * vec4(positionOf(gl_VertexIndex), 1.0);
  outUv = (vertexData & 2u) != 0u ? uvs[gl_VertexIndex] : vec4(0.0);
  outAlpha = (vertexData & 1u) != 0u ? colors[gl_VertexIndex].w : 1.0;
}
