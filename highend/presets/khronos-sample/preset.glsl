// The shading model of Khronos' glTF sample viewer.
//
// Source: Khronos Group, glTF Sample Renderer (2024 and later; KhronosGroup/glTF-Sample-Renderer, before glTF Sample
// Viewer): source/Renderer/shaders/pbr.frag, brdf.glsl, punctual.glsl and ibl.glsl. The lobe is that of the glTF 2.0
// specification, appendix B; the falloff and the cone are those of KHR_lights_punctual.
//
// Deviations:
// - compensation = "fdez-aguera" gives what scatters more than once to lights, too. The viewer gives it to the
//   environment alone. It takes that light from the reflected direction, where the path takes it from the irradiance.
// - The viewer's FssEss has a Fresnel curve of roughness and N.V in place of F0. The path has F0 A + F90 B.
// - The diffuse part of lights has 1 - F of the mixed F0. The viewer mixes a whole dielectric and a whole metal. Both
//   are the same unless Metallic is between 0 and 1.
// - The squared distance is at least (1 cm)^2. The viewer divides by 0 at the light.
// - The roughness of lights is at least 0.0156, the path's floor. The viewer has none.
// - The environment's levels and its lamps are the path's. Coats, sheen, brushed metal, thin films and glass are, too.

// D_GGX, V_GGX and F_Schlick of brdf.glsl; a thin film takes the path's Fresnel curve.
vec3 presetDirectLobe(Shader s, vec3 L, float NoL, float NoH, float VoH) {
  float a2 = s.alpha * s.alpha;
  float f = NoH * NoH * (a2 - 1.0) + 1.0;
  float D = a2 / (kPi * f * f);
  float lambdaV = NoL * sqrt(s.NoV * s.NoV * (1.0 - a2) + a2);
  float lambdaL = s.NoV * sqrt(NoL * NoL * (1.0 - a2) + a2);
  float sum = lambdaV + lambdaL;
  float V = sum > 0.0 ? 0.5 / sum : 0.0;
  return (NoL * D * V) * fresnelOf(s, VoH);
}

// Lambert by what the facets let through: mix(diffuse, specular, F) of pbr.frag. diffuse = "balanced" has multiplied
// s.diffuseColor with its own share already. The viewer's lights do not have that share, so it is divided out again.
vec3 presetDiffuseLobe(Shader s, float NoL, float VoH) {
  vec3 color = s.diffuseColor;
  if (kDiffuse == kDiffuseBalanced) color /= max(albedoScaling(s.single + s.multiple), vec3(1e-3));
  return color * (1.0 - fresnelOf(s, VoH));
}

// getRangeAttenuation. Lights whose falloff has an exponent keep it.
float presetDistanceFalloff(int falloff, float d2, float range, float exponent) {
  if (falloff == kFalloffExponent) return exponentFalloff(d2, range, exponent);
  float window = 1.0;
  if (range > 0.0) {
    float q = d2 / range / range;
    window = clamp(1.0 - q * q, 0.0, 1.0);
  }
  return window / max(d2, 1e-4);
}

// getSpotAttenuation: the square of the way from the outer cosine to the inner one.
float presetSpotCone(float cosAngle, float cosInner, float cosOuter) {
  if (cosAngle <= cosOuter) return 0.0;
  if (cosAngle >= cosInner) return 1.0;
  float x = (cosAngle - cosOuter) / (cosInner - cosOuter);
  return x * x;
}
