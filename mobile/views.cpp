#include "mobile/views.h"

#include <iterator>

namespace parity::mobile {

const std::vector<View>& views() {
  static constexpr View kViews[] = {
      {"Lit", "all of it"},
      {"IndirectColor", "ComputeIndirect: the lightmap times DiffuseColor and IndirectLightingColorScale"},
      {"SkyDiffuseLighting", "GetSkySHDiffuseSimple: SH irradiance over pi"},
      {"DiffuseLookup", "SkyDiffuseLighting times SkyLightColor"},
      {"IndirectIrradiance", "luminance of the indirect light, with material AO: scales SpecularIBL"},
      {"DirectionalLight", "Shadow DirectionalLightColor (Lighting.Diffuse + Lighting.Specular SpecularScale)"},
      {"Lighting.Diffuse", "NoL DiffuseColor, of the directional light"},
      {"Lighting.Specular", "SpecularColor NoL lobe, of the directional light"},
      {"Lighting", "Lighting.Diffuse + Lighting.Specular"},
      {"SpecularIBL", "GetImageBasedReflectionLighting: the environment as fetched, in its scale and SkyLightColor"},
      {"SpecularIBL.Lit", "SpecularIBL times SpecularColor"},
      {"Color.AfterIBL", "what has been added up once SpecularIBL is in"},
      {"DynamicPointLights", "AccumulateLightingOfDynamicPointLight, of all local lights"},
      {"SkyLight", "SkyDiffuseLighting SkyLightColor DiffuseColor MaterialAO"},
      {"Emissive", "of the material"},
      {"VertexFog", "inscattered light, interpolated from the vertices"},
      {"VertexFog.a", "what fog lets through"},
      {"DiffuseColor", "BaseColor - BaseColor Metallic"},
      {"SpecPreEnvBrdf", "specular colour before the environment BRDF"},
      {"SpecularColor", "specular colour through the environment BRDF"},
      {"DielectricSpecular", "0.08 Specular: F0 of a dielectric"},
      {"BaseColor", "of the material"},
      {"Metallic", "of the material"},
      {"Roughness", "of the material, not below the preset's floor"},
      {"MaterialAO", "of the material"},
      {"Opacity", "of the material"},
      {"Shadow", "of the directional light: 1 without a distance field and without --mobile-sun-shadow"},
      {"NoL", "max(0, N.L) of the directional light"},
      {"NoH", "max(0, N.H) of the directional light"},
      {"NoV", "max(0, N.V)"},
      {"H", "half vector of the directional light"},
      {"WorldNormal", "after normal mapping"},
      {"ReflectionVector", "2 (N.V) N - V"},
      {"SkyLightColor", "the scale of the sky's light"},
      {"EnvBRDF.A", "of the preset's approximation: what SpecPreEnvBrdf is multiplied with"},
      {"EnvBRDF.B", "of it: what is added, in all three channels"},
      {"EnvBRDF", "SpecPreEnvBrdf A + B as the material has it, nonmetal or fully rough as it may be"},
      {"EnvBRDF.Multiple", "what refit adds for light that scatters more than once; 0 of the other presets"},
  };
  static_assert(std::size(kViews) == kViewCount);
  static const std::vector<View> all(std::begin(kViews), std::end(kViews));
  return all;
}

} // namespace parity::mobile
