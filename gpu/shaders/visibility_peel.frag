// One layer of blended surfaces, by depth peeling (Everitt 2001): the nearest fragment behind the layer before. Fragments
// are ordered by depth, then by instance and triangle, the last one in front; so none is lost that has the depth of another.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/alpha_test.glsl"

layout(location = 0) out uvec2 outIds; // instance + 1 (0: nothing), triangle

layout(set = 2, binding = 0) uniform sampler2D opaqueDepth;
layout(set = 2, binding = 1) uniform sampler2D depthBefore;
layout(set = 2, binding = 2) uniform usampler2D idsBefore;

void main() {
  bool shown = passesAlphaTest();
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec2 ids = uvec2(instance + 1u, uint(gl_PrimitiveID));
  // As the buffer will hold it, and what the next layer compares with: the rasteriser's own may differ by a rounding.
  float depth = clamp(gl_FragCoord.z, 0.0, 1.0);
  shown = shown && depth <= texelFetch(opaqueDepth, pixel, 0).x;
  if (layer > 0u) {
    uvec2 before = texelFetch(idsBefore, pixel, 0).xy;
    float z = texelFetch(depthBefore, pixel, 0).x;
    bool earlier = ids.x < before.x || (ids.x == before.x && ids.y < before.y);
    shown = shown && before.x != 0u && (depth > z || (depth == z && earlier));
  }
  if (!shown) discard;
  gl_FragDepth = depth;
  outIds = ids;
}
