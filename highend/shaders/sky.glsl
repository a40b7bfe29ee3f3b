// The environment as the high-end path reads it: an irradiance cube, the prefiltered cube at any level, and the panorama's
// own cells for what is sharper.
#include "shading/mips.glsl"

// Irradiance of the environment over pi, per unit of diffuse colour.
vec3 skyIrradianceOverPi(vec3 n) { return textureLod(environmentIrradiance, vec4(n, 0.0), 0.0).xyz; }

// capture: of those in the array; 0 where it is one environment.
vec3 skyRadianceOfLevel(vec3 direction, int level, int capture) {
  return textureLod(prefilteredEnvironment, vec4(direction, float(level % kPrefilterLayers + capture * kPrefilterLayers)),
                    float(level / kPrefilterLayers)).xyz;
}

vec3 skyRadianceBetweenLevels(vec3 direction, PrefilterBlend blend, int capture) {
  return mix(skyRadianceOfLevel(direction, blend.lower, capture), skyRadianceOfLevel(direction, blend.upper, capture),
             blend.upperShare);
}

// Of cubes without fine levels. Between the lobes in between, too (shading/mips.glsl): for as many texels read a tenth
// of a trilinear reading's error.
vec3 skyRadianceAtMip(vec3 direction, float mip, int capture) {
  return skyRadianceBetweenLevels(direction, prefilterBlend(clamp(mip, 0.0, float(kPrefilterRoughestMip))), capture);
}

// Share of the cell above in a box of `width` (in cells, at most 1) around a place between two: 0 and 1 are exact, so
// that a lamp of one cell does not leak into the next.
float shareAbove(float place, float width) { return clamp((fract(place) - 0.5) / max(width, 1e-6) + 0.5, 0.0, 1.0); }

// lighting/environment/panorama_cells.h, readCells.
vec3 panoramaMean(vec3 direction, float boxWidth) {
  ivec2 base = textureSize(panorama, 0);
  float rowsWide = boxWidth * kInvPi * float(base.y);
  int mip = min(int(ceil(log2(max(rowsWide, 1.0)))), textureQueryLevels(panorama) - 1);
  ivec2 size = base >> mip; // lavapipe's textureSize takes one mip for all invocations
  float horizontal = length(direction.xz), polar = atan(horizontal, direction.y);
  float turns = fract(atan(direction.z, direction.x) * (0.5 * kInvPi) + 0.5 + view.path[kPathPanorama].x);
  vec2 place = vec2(turns * float(size.x), polar * kInvPi * float(size.y)) - 0.5;
  float cellsWide = boxWidth * kInvPi * 0.5 * float(size.x) / max(horizontal, 1e-6);
  vec2 share = vec2(shareAbove(place.x, min(cellsWide, 1.0)),
                    shareAbove(place.y, min(boxWidth * kInvPi * float(size.y), 1.0)));
  ivec2 below = ivec2(floor(place));
  ivec2 x = (ivec2(below.x, below.x + 1) + size.x) % size.x, y = clamp(ivec2(below.y, below.y + 1), 0, size.y - 1);
  vec3 upper = mix(texelFetch(panorama, ivec2(x.x, y.x), mip).xyz, texelFetch(panorama, ivec2(x.y, y.x), mip).xyz, share.x);
  vec3 lower = mix(texelFetch(panorama, ivec2(x.x, y.y), mip).xyz, texelFetch(panorama, ivec2(x.y, y.y), mip).xyz, share.x);
  return mix(upper, lower, share.y);
}

// Of the environment with fine levels: the sharpest of them at least.
vec3 fineSkyRadianceAtMip(vec3 direction, float mip) {
  return skyRadianceBetweenLevels(direction, finePrefilterBlend(mip), 0);
}
