#include "mobile/views.h"

#include <iterator>

namespace parity::mobile {

const std::vector<View>& views() {
  static constexpr View kViews[] = {
      {"Lit", "all light together"},
      {"IndirectColor", "ComputeIndirect: the lightmap times DiffuseColor and IndirectLightingColorScale"},
      {"SkyDiffuseLighting", "GetSkySHDiffuseSimple: SH irradiance over pi"},
      {"DiffuseLookup", "SkyDiffuseLighting times SkyLightColor"},
      {"IndirectIrradiance", "luminance of the indirect light times material AO; it scales SpecularIBL"},
      {"DirectionalLight", "Shadow DirectionalLightColor (Lighting.Diffuse + Lighting.Specular SpecularScale)"},
      {"Lighting.Diffuse", "NoL DiffuseColor of the directional light"},
      {"Lighting.Specular", "SpecularColor NoL lobe of the directional light"},
      {"Lighting", "Lighting.Diffuse + Lighting.Specular"},
      {"SpecularIBL", "GetImageBasedReflectionLighting: environment as fetched, times its scale and SkyLightColor"},
      {"SpecularIBL.Lit", "SpecularIBL times SpecularColor"},
      {"Color.AfterIBL", "sum of the light up to SpecularIBL"},
      {"DynamicPointLights", "AccumulateLightingOfDynamicPointLight for all local lights"},
      {"SkyLight", "SkyDiffuseLighting SkyLightColor DiffuseColor MaterialAO"},
      {"Emissive", "emitted light of the material"},
      {"VertexFog", "light of the fog, interpolated from the vertices"},
      {"VertexFog.a", "transmittance of the fog"},
      {"DiffuseColor", "BaseColor - BaseColor Metallic"},
      {"SpecPreEnvBrdf", "specular colour before the environment BRDF"},
      {"SpecularColor", "specular colour through the environment BRDF"},
      {"DielectricSpecular", "0.08 Specular: F0 of a dielectric"},
      {"BaseColor", "base colour of the material"},
      {"Metallic", "metallic value of the material"},
      {"Roughness", "roughness of the material, not below the floor of the preset"},
      {"MaterialAO", "ambient occlusion of the material"},
      {"Opacity", "opacity of the material"},
      {"Shadow", "shadow of the directional light; 1 without a distance field and without --mobile-sun-shadow"},
      {"NoL", "max(0, N.L) of the directional light"},
      {"NoH", "max(0, N.H) of the directional light"},
      {"NoV", "max(0, N.V)"},
      {"H", "half vector of the directional light"},
      {"WorldNormal", "normal after normal mapping"},
      {"ReflectionVector", "2 (N.V) N - V"},
      {"SkyLightColor", "scale of the sky light"},
      {"EnvBRDF.A", "scale of SpecPreEnvBrdf, from the approximation of the preset"},
      {"EnvBRDF.B", "addition of the same approximation, in all three channels"},
      {"EnvBRDF", "SpecPreEnvBrdf A + B, in the form of the material (nonmetal, fully rough)"},
      {"EnvBRDF.Multiple", "addition of refit for multiple scattering; 0 for the other presets"},
  };
  static_assert(std::size(kViews) == kViewCount);
  static const std::vector<View> all(std::begin(kViews), std::end(kViews));
  return all;
}

} // namespace parity::mobile
