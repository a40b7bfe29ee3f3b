// The environment as the high-end path reads it: SH irradiance, and the prefiltered cube at any level.
#include "shading/mips.glsl"
#include "shading/sh.glsl"

// Irradiance of the environment over pi, per unit of diffuse colour.
vec3 skyIrradianceOverPi(vec3 n) {
  IrradianceSh sh;
  for (int k = 0; k < 9; ++k) sh.c[k] = view.sh[k].xyz;
  return evalIrradianceSH(sh, n) * kInvPi;
}

// capture: of those in the array; 0 where it is one environment.
vec3 skyRadianceOfLevel(vec3 direction, int level, int capture) {
  return textureLod(prefilteredEnvironment, vec4(direction, float(level % kPrefilterLayers + capture * kPrefilterLayers)),
                    float(level / kPrefilterLayers)).xyz;
}

// Between the lobes in between, too (shading/mips.glsl): for as many texels read a tenth of a trilinear reading's error.
vec3 skyRadianceAtMip(vec3 direction, float mip, int capture) {
  PrefilterBlend blend = prefilterBlend(mip);
  return mix(skyRadianceOfLevel(direction, blend.lower, capture), skyRadianceOfLevel(direction, blend.upper, capture),
             blend.upperShare);
}
