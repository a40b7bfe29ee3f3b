// Buffers of vectors, accessed in the ways that accessBuffersByPairs rewrites, and where kUse says so in one that it
// leaves.
#version 460

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kUse = 0u; // 1..4, at the end

struct Part {
  vec4 rows[3];
  uvec4 word;
};
struct Thing {
  vec4 first;
  ivec4 second;
  Part parts[2];
};

layout(set = 0, binding = 0, std430) readonly buffer Vectors { vec4 vectors[]; };
layout(set = 0, binding = 1, std430) readonly buffer Things { Thing head; Thing things[]; };
layout(set = 0, binding = 2, std430) readonly buffer Numbers { uint numbers[]; };
layout(set = 0, binding = 3, std430) buffer Results { vec4 results[]; }; // 8 vectors each
layout(set = 0, binding = 4, std140) uniform Indexed { vec4 title; Part indexed[16]; };
layout(set = 0, binding = 5, std140) uniform Fixed { vec4 fixedRows[16]; };
layout(set = 0, binding = 6, std430) writeonly buffer Copies { uvec4 copies[]; };
layout(set = 0, binding = 7, std430) coherent buffer Shared { vec4 together[]; };
layout(set = 0, binding = 8, std430) buffer Parts { Part parts[]; };

vec4 sumOf(Part part) { return part.rows[0] + 2.0 * part.rows[1] + 4.0 * part.rows[2] + vec4(part.word); }

void main() {
  uint i = gl_GlobalInvocationID.x, n = numbers[i] % 16u, at = 8u * i;
  results[at] = vectors[i];
  results[at + 1u] = vec4(vectors[i + 1u].w, vectors[i + 2u].x, vectors[n].z, vectors[3].y);
  results[at + 2u] = vec4(head.second) + things[n].first + vec4(things[n].second.yx, head.parts[1].rows[2].zw);
  Part whole = things[n].parts[i & 1u];
  results[at + 3u] = sumOf(whole);
  results[at + 4u] = uintBitsToFloat(things[n].parts[1].word) + things[2].parts[numbers[i + 1u] & 1u].rows[1];
  results[at + 5u] = sumOf(indexed[n]) + title;
  results[at + 6u] = vec4(indexed[n].rows[i % 3u].y, indexed[7].word.w, fixedRows[3].x, fixedRows[15].z);
  results[at + 7u] = results[at] * 2.0;
  copies[i] = floatBitsToUint(vectors[int(i)]);
  together[i] = vectors[i];
  parts[i].rows[1] = vectors[i];
  if (kUse == 1u) results[at + 7u].y = 1.0;
  if (kUse == 2u) results[at + 7u] = vec4(vectors[i][n & 3u]);
  if (kUse == 3u) results[at + 7u] = vec4(float(vectors.length()));
  if (kUse == 4u) parts[i] = parts[i + 1u];
}
