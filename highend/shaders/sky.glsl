// The environment as the high-end path reads it: SH irradiance, and the prefiltered cube at any level.
#include "shading/mips.glsl"
#include "shading/sh.glsl"

// Irradiance of the environment over pi, per unit of diffuse colour.
vec3 skyIrradianceOverPi(vec3 n) {
  IrradianceSh sh;
  for (int k = 0; k < 9; ++k) sh.c[k] = view.sh[k].xyz;
  return evalIrradianceSH(sh, n) * kInvPi;
}

vec3 skyRadianceOfLevel(vec3 direction, int level) {
  return textureLod(prefilteredEnvironment, vec4(direction, float(level % kPrefilterLayers)), float(level / kPrefilterLayers)).xyz;
}

// Between the lobes in between, too (shading/mips.glsl): for as many texels read a tenth of a trilinear reading's error.
vec3 skyRadianceAtMip(vec3 direction, float mip) {
  PrefilterBlend blend = prefilterBlend(mip);
  return mix(skyRadianceOfLevel(direction, blend.lower), skyRadianceOfLevel(direction, blend.upper), blend.upperShare);
}

vec3 skyRadianceBetweenLevels(vec3 direction, float roughness) { return skyRadianceAtMip(direction, mipFromRoughness(roughness)); }
