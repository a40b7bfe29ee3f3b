// Where baked light of a surface's entry lies, and how its pages are read. To be included behind path.glsl. kBaked, a
// specialization constant: kBaked... bits of interface.h.

bool hasLightmap(uint i) { return (kBaked & kBakedLightmap) != 0u && surfaceLightmap[i].z > 0.5; }

// lower: 0 the upper half, 1 the lower one. Bilinear, and kept half a texel inside of the half, so that the other one never
// mixes in.
vec4 readLightmap(vec4 place, float lower) {
  float rows = 0.5 * float(textureSize(lightmapPages, 0).y);
  float row = clamp(place.y * rows, 0.5, rows - 0.5) + lower * rows;
  return textureLod(lightmapPages, vec3(place.x, row / (2.0 * rows), place.z - 1.0), 0.0);
}

// 1 where the entry has none.
float readSunShadow(uint i) {
  if ((kBaked & kBakedSunShadow) == 0u) return 1.0;
  vec4 place = surfaceLightmap[i];
  return place.z > 0.5 ? textureLod(sunShadowPages, vec3(place.xy, place.z - 1.0), 0.0).x : 1.0;
}
