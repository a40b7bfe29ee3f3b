// Set 0 of the surface pass: geometry, pulled by index. The raster shaders have the materials besides, in binding 7.
#include "gpu/shaders/interface.h"

layout(set = 0, binding = 0, std430) readonly buffer Positions { float positions[]; };
layout(set = 0, binding = 1, std430) readonly buffer Normals { float normals[]; };
layout(set = 0, binding = 2, std430) readonly buffer Tangents { vec4 tangents[]; };
layout(set = 0, binding = 3, std430) readonly buffer Uvs { vec4 uvs[]; }; // uv0, uv1
layout(set = 0, binding = 4, std430) readonly buffer Colors { vec4 colors[]; };
layout(set = 0, binding = 5, std430) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 6, std430) readonly buffer Instances { GpuInstance instances[]; };

vec3 positionOf(uint v) { return vec3(positions[3u * v], positions[3u * v + 1u], positions[3u * v + 2u]); }
vec3 normalOf(uint v) { return vec3(normals[3u * v], normals[3u * v + 1u], normals[3u * v + 2u]); }

vec3 transformPoint(vec4 rows[3], vec3 p) {
  vec4 h = vec4(p, 1.0);
  return vec3(dot(rows[0], h), dot(rows[1], h), dot(rows[2], h));
}
vec3 transformVector(vec4 rows[3], vec3 v) { return vec3(dot(rows[0].xyz, v), dot(rows[1].xyz, v), dot(rows[2].xyz, v)); }
