// Which local lights reach a group of entries: those whose range and cone touch the box about the entries' positions. The
// candidates are all lights, or those that reach the larger group that this one is a part of.
//
// An invocation a group. Run twice: to count, and, once the host has found a place for every list, to write them; each by
// as many dispatches as there are kMaxCandidates among the lights: lavapipe ends an invocation's loops after 65,535 turns.
// No barriers and no atomics: the lists are in the order of the lights, alike on every device.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/interface.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kWrites = 0u;
layout(constant_id = 1) const uint kRefines = 0u;

layout(set = 0, binding = 0, std430) readonly buffer SurfacePosition { uvec4 surfacePosition[]; };
layout(set = 0, binding = 1, std430) readonly buffer Lights { GpuLight lights[]; };
// head: groups; the first light to ask; how many; 0. Then of each group: first entry, number of entries, larger group, 0.
layout(set = 0, binding = 2, std430) readonly buffer Groups { uvec4 head; uvec4 groups[]; };
layout(set = 0, binding = 3, std430) writeonly buffer Lists { uvec4 counts; uint data[]; };
// Of the larger groups, as Lists has them: where each begins, after one word.
layout(set = 0, binding = 4, std430) readonly buffer Larger { uvec4 largerCounts; uint larger[]; };
// Of each group how many lights have been counted so far, or where the next is written.
layout(set = 0, binding = 5, std430) buffer Cursors { uint cursors[]; };

layout(push_constant) uniform Push {
  uint firstCandidate; // of this dispatch
};

// Rounding may not lose a light that the shading reaches: these are far above it.
const float kRangeSlack = 1.0001; // of the square
const float kConeSlack = 1e-3;    // of the distance: an angle from a cosine near 1 is that inexact

bool reaches(GpuLight light, vec3 lower, vec3 upper) {
  vec3 position = light.positionKind.xyz;
  vec3 d = position - clamp(position, lower, upper);
  float range = light.colorRange.w;
  if (range > 0.0 && dot(d, d) > range * range * kRangeSlack) return false;
  if (uint(light.positionKind.w) != kLightSpot) return true;
  // The cone against the sphere about the box: the distance of its centre from the cone's side.
  vec3 axis = light.directionCosOuter.xyz, v = 0.5 * (lower + upper) - position;
  float cosine = light.directionCosOuter.w, sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  float along = dot(v, axis), aside = sqrt(max(dot(v, v) - along * along, 0.0));
  float radius = 0.5 * length(upper - lower) + kConeSlack * length(v);
  return !(cosine * aside - sine * along > radius || along < -radius);
}

void main() {
  uint g = (gl_WorkGroupID.y * kMaxGroupsInRow + gl_WorkGroupID.x) * kGroupSize + gl_LocalInvocationID.x;
  if (g >= head.x) return;
  uint first = groups[g].x;
  vec3 lower = uintBitsToFloat(surfacePosition[first].xyz), upper = lower;
  for (uint i = 1u; i < groups[g].y; ++i) {
    vec3 p = uintBitsToFloat(surfacePosition[first + i].xyz);
    lower = min(lower, p);
    upper = max(upper, p);
  }
  uint place = cursors[g];
  uint begin = kRefines != 0u ? larger[1u + groups[g].z] : head.y;
  uint end = kRefines != 0u ? larger[2u + groups[g].z] : head.y + head.z;
  begin += firstCandidate;
  end = min(end, begin + kMaxCandidates);
  for (uint at = begin; at < end; ++at) {
    uint k = at;
    if (kRefines != 0u) k = larger[at];
    if (!reaches(lights[k], lower, upper)) continue;
    if (kWrites != 0u) data[place] = k;
    ++place;
  }
  cursors[g] = place;
}
