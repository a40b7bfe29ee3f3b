// Rasterises instance and triangle ids: clip position, and what the alpha test reads.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/geometry.glsl"

layout(push_constant) uniform Push {
  mat4 toClip; // from object space
  uint instance;
  uint vertexData; // kVertex... bits
};

layout(location = 0) out vec4 outUv;
layout(location = 1) out float outAlpha;

void main() {
  gl_Position = toClip * vec4(positionOf(gl_VertexIndex), 1.0);
  outUv = (vertexData & kVertexUvs) != 0u ? uvs[gl_VertexIndex] : vec4(0.0);
  outAlpha = (vertexData & kVertexColors) != 0u ? colors[gl_VertexIndex].w : 1.0;
}
