// Where baked light of a surface's entry lies, and how its pages are read. To be included behind path.glsl. kBaked, a
// specialization constant: kBaked... bits of interface.h.
#include "shading/lightmap.glsl"

// The entry's, read once for all that is baked: uv in the page; page + 1, 0: none; 1 front, -1 back.
vec4 bakedPlace = vec4(0.0);

void readBakedPlace(uint i) {
  if ((kBaked & (kBakedLightmap | kBakedSunShadow)) != 0u) bakedPlace = surfaceLightmap[i];
}

bool hasLightmap() { return (kBaked & kBakedLightmap) != 0u && bakedPlace.z > 0.5; }

// lower: 0 the upper half, 1 the lower one. Bilinear, and kept half a texel inside of the half, so that the other one never
// mixes in.
vec4 readLightmap(vec4 place, float lower) {
  float rows = 0.5 * float(textureSize(lightmapPages, 0).y);
  float row = clamp(place.y * rows, 0.5, rows - 0.5) + lower * rows;
  return textureLod(lightmapPages, vec3(place.x, row / (2.0 * rows), place.z - 1.0), 0.0);
}

// Of the high-end path's pages, at the shading normal n, of an entry that has a lightmap. Of a double-sided object (alpha 0)
// what is stored is from everywhere, and the direction tells one side from the other. In fp32 in every path.
vec3 lightmapIrradianceOverPi(Point p, vec3 n) {
  vec4 stored = readLightmap(bakedPlace, 0.0);
  vec3 r = readLightmap(bakedPlace, 1.0).xyz;
  float ratio = stored.w > 0.5 ? directionalLightmapRatio(r, n, bakedPlace.w * p.normal) : nonlinearIrradiance(r, n);
  return max(stored.xyz, vec3(0.0)) * ratio;
}

// 1 where the entry has none.
float readSunShadow() {
  if ((kBaked & kBakedSunShadow) == 0u) return 1.0;
  return bakedPlace.z > 0.5 ? textureLod(sunShadowPages, vec3(bakedPlace.xy, bakedPlace.z - 1.0), 0.0).x : 1.0;
}
