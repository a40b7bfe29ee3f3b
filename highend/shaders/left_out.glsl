// Pictures that lack a light each, in place of the terms: each light is shaded once for all of them.

layout(constant_id = 20) const uint kLeftOut = 0u; // how many; at most kMaxLeftOut
layout(constant_id = 21) const uint kLightsAlone = 0u; // 1: they hold the light of lights alone

Terms withoutLight[kMaxLeftOut]; // of each picture: the sum over all lights but one

void beginLeftOut() {
  for (uint k = 0u; k < kLeftOut; ++k) withoutLight[k] = noTerms();
}

// Terms that lights add to.
bool isOfLights(int term) { return term <= kTermLocalSpecular || term > kTermFog; }

// Adds what this light gives to all pictures but its own, and clears `added` for the next light.
void shareOut(inout Terms added, GpuLight light) {
  uint own = uint(light.falloff.z); // 1 + its picture; 0: none
  for (uint k = 0u; k < kLeftOut; ++k)
    for (int t = 0; t < kTermCount; ++t)
      if (isOfLights(t)) withoutLight[k].t[t] += own == k + 1u ? vec3(0.0) : added.t[t];
  added = noTerms();
}

// rest: the terms without any light source: sky, lightmap, emission.
Terms withLightsBut(uint picture, Terms rest) {
  if (kLightsAlone != 0u) return withoutLight[picture];
  for (int t = 0; t < kTermCount; ++t)
    if (isOfLights(t)) rest.t[t] += withoutLight[picture].t[t];
  return rest;
}
