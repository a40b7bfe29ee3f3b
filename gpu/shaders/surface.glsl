// The surface buffer: structure of arrays over the entries of the pixel lists.
// Define PARITY_SURFACE_ACCESS as readonly or writeonly and PARITY_SURFACE_BINDING as the first binding before including.
#define PARITY_SURFACE(i, name, type, member)                                                                           \
  layout(set = 0, binding = PARITY_SURFACE_BINDING + i, std430) PARITY_SURFACE_ACCESS buffer name { type member[]; }
PARITY_SURFACE(0, SurfacePosition, uvec4, surfacePosition); // bits of the world position; instance
PARITY_SURFACE(1, SurfaceNormal, uvec4, surfaceNormal);     // bits of the unit shading normal; geometric normal, octahedral snorm16
PARITY_SURFACE(2, SurfaceTangent, vec4, surfaceTangent);    // unit or zero; w: handedness
PARITY_SURFACE(3, SurfaceUv, vec4, surfaceUv);              // uv0, uv1
PARITY_SURFACE(4, SurfaceUv0Derivatives, vec4, surfaceUv0Derivatives); // d/dx, d/dy in pixels
PARITY_SURFACE(5, SurfaceUv1Derivatives, vec4, surfaceUv1Derivatives);
PARITY_SURFACE(6, SurfaceColor, vec4, surfaceColor);        // vertex colour, linear RGBA
PARITY_SURFACE(7, SurfaceFog, vec4, surfaceFog);            // of the vertices: inscattered radiance, transmittance
PARITY_SURFACE(8, SurfaceLightmap, vec4, surfaceLightmap);  // uv in the page; page + 1, 0: none; 1 front, -1 back

uint packOctahedral(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  if (n.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  return packSnorm2x16(p);
}
vec3 unpackOctahedral(uint bits) {
  vec2 p = unpackSnorm2x16(bits);
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  return normalize(n);
}
