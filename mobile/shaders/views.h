// What a pass of the mobile path can show besides the lit picture; C++ and GLSL. Names are those of the base pass
// (mobile/views.h).
#ifndef PARITY_MOBILE_SHADERS_VIEWS_H
#define PARITY_MOBILE_SHADERS_VIEWS_H

#ifdef __cplusplus
namespace parity::mobile {
#define PARITY_CONST inline constexpr unsigned
#else
#define PARITY_CONST const uint
#endif

PARITY_CONST kViewLit = 0u;
PARITY_CONST kViewIndirectColor = 1u;
PARITY_CONST kViewSkyDiffuseLighting = 2u;
PARITY_CONST kViewDiffuseLookup = 3u;
PARITY_CONST kViewIndirectIrradiance = 4u;
PARITY_CONST kViewDirectionalLight = 5u;
PARITY_CONST kViewLightingDiffuse = 6u;
PARITY_CONST kViewLightingSpecular = 7u;
PARITY_CONST kViewLighting = 8u;
PARITY_CONST kViewSpecularIBL = 9u;
PARITY_CONST kViewSpecularIBLLit = 10u;
PARITY_CONST kViewColorAfterIBL = 11u;
PARITY_CONST kViewDynamicPointLights = 12u;
PARITY_CONST kViewSkyLight = 13u;
PARITY_CONST kViewEmissive = 14u;
PARITY_CONST kViewVertexFog = 15u;
PARITY_CONST kViewVertexFogA = 16u;
PARITY_CONST kViewDiffuseColor = 17u;
PARITY_CONST kViewSpecPreEnvBrdf = 18u;
PARITY_CONST kViewSpecularColor = 19u;
PARITY_CONST kViewDielectricSpecular = 20u;
PARITY_CONST kViewBaseColor = 21u;
PARITY_CONST kViewMetallic = 22u;
PARITY_CONST kViewRoughness = 23u;
PARITY_CONST kViewMaterialAO = 24u;
PARITY_CONST kViewOpacity = 25u;
PARITY_CONST kViewShadow = 26u;
PARITY_CONST kViewNoL = 27u;
PARITY_CONST kViewNoH = 28u;
PARITY_CONST kViewNoV = 29u;
PARITY_CONST kViewH = 30u;
PARITY_CONST kViewWorldNormal = 31u;
PARITY_CONST kViewReflectionVector = 32u;
PARITY_CONST kViewSkyLightColor = 33u;
PARITY_CONST kViewEnvBrdfA = 34u;
PARITY_CONST kViewEnvBrdfB = 35u;
PARITY_CONST kViewEnvBrdf = 36u;
PARITY_CONST kViewEnvBrdfMultiple = 37u;
PARITY_CONST kViewCount = 38u;

#ifdef __cplusplus
} // namespace parity::mobile
#endif
#undef PARITY_CONST
#endif
