#include "mobile/views.h"

#include <algorithm>

namespace parity::mobile {

const std::array<View, kViewCount> kViews = {{
    {"Lit", "all of it"},
    {"IndirectColor", "ComputeIndirect: the lightmap times DiffuseColor and IndirectLightingColorScale"},
    {"SkyDiffuseLighting", "GetSkySHDiffuseSimple: SH irradiance over pi"},
    {"DiffuseLookup", "SkyDiffuseLighting times SkyLightColor"},
    {"IndirectIrradiance", "luminance of the indirect light, with material AO: scales SpecularIBL"},
    {"DirectionalLight", "Shadow DirectionalLightColor (Lighting.Diffuse + Lighting.Specular SpecularScale)"},
    {"Lighting.Diffuse", "NoL DiffuseColor, of the directional light"},
    {"Lighting.Specular", "SpecularColor NoL lobe, of the directional light"},
    {"Lighting", "Lighting.Diffuse + Lighting.Specular"},
    {"SpecularIBL", "GetImageBasedReflectionLighting: the environment as fetched, in its scale"},
    {"SpecularIBL.Lit", "SpecularIBL times SpecularColor; of refit in the sky light's colour, too"},
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
    {"Shadow", "of the directional light: 1 without a distance-field shadow"},
    {"NoL", "max(0, N.L) of the directional light"},
    {"NoH", "max(0, N.H) of the directional light"},
    {"NoV", "max(0, N.V)"},
    {"H", "half vector of the directional light"},
    {"WorldNormal", "after normal mapping"},
    {"ReflectionVector", "2 (N.V) N - V"},
    {"SkyLightColor", "the scale of the sky's light"},
}};

std::optional<std::uint32_t> viewByName(const std::string& name) {
  const auto found = std::find_if(kViews.begin(), kViews.end(), [&](const View& view) { return view.name == name; });
  if (found == kViews.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - kViews.begin());
}

} // namespace parity::mobile
