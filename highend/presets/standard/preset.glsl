// The formulas of the high-end path.

// GGX about the half vector, the height-correlated Smith term, and the Fresnel curve of the knob `fresnel`.
vec3 presetDirectLobe(Shader s, vec3 L, float NoL, float NoH, float VoH) {
  float V = kGeometryTerm == kGeometryHeightCorrelated ? V_SmithGGXCorrelated(s.alpha, s.NoV, NoL)
                                                       : V_SchlickSmith(s.alpha, s.NoV, NoL);
  return (NoL * D_GGX(s.alpha, NoH) * V) * fresnelOf(s, VoH) * s.factor;
}

// Lambert.
vec3 presetDiffuseLobe(Shader s, float NoL, float VoH) { return s.diffuseColor; }

// KHR_lights_punctual or Unreal Engine 4, as the scene says.
float presetDistanceFalloff(int falloff, float d2, float range, float exponent) {
  return distanceFalloff(falloff, d2, range, exponent);
}

// KHR_lights_punctual, "Inner and Outer Cone Angles".
float presetSpotCone(float cosAngle, float cosInner, float cosOuter) {
  return spotAttenuation(cosAngle, cosInner, cosOuter);
}
