// What crosses the border between C++ and the shaders: structs, bindings, specialization constants. Included by both.
#ifndef PARITY_GPU_INTERFACE_H
#define PARITY_GPU_INTERFACE_H

#ifdef __cplusplus
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
namespace parity::gpu {
using vec4 = glm::vec4;
using uvec4 = glm::uvec4;
using uint = std::uint32_t;
#define PARITY_CONST inline constexpr
#else
#define PARITY_CONST const
#endif

// Texture slots of a material, in the order of their bindings in set 1 and of the bits of a texture mask.
PARITY_CONST int kSlotBaseColor = 0;
PARITY_CONST int kSlotMetallicRoughness = 1;
PARITY_CONST int kSlotNormal = 2;
PARITY_CONST int kSlotOcclusion = 3;
PARITY_CONST int kSlotEmissive = 4;
PARITY_CONST int kSlotSpecular = 5;
PARITY_CONST int kSlotSpecularColor = 6;
PARITY_CONST int kSlotCoat = 7;
PARITY_CONST int kSlotCoatRoughness = 8;
PARITY_CONST int kSlotCoatNormal = 9;
PARITY_CONST int kSlotSheenColor = 10;
PARITY_CONST int kSlotSheenRoughness = 11;
PARITY_CONST int kSlotAnisotropy = 12;
PARITY_CONST int kSlotIridescence = 13;
PARITY_CONST int kSlotIridescenceThickness = 14;
PARITY_CONST int kSlotTransmission = 15;
PARITY_CONST int kSlotThickness = 16;
PARITY_CONST int kSlotDiffuseTransmission = 17;
PARITY_CONST int kSlotDiffuseTransmissionColor = 18;
PARITY_CONST int kSlotCount = 19;
// The slots of lobes beside the base's own, which shaders of scenes without them lack (PARITY_LOBES of path.glsl).
PARITY_CONST uint kCoatTextures = 1u << kSlotCoat | 1u << kSlotCoatRoughness | 1u << kSlotCoatNormal;
PARITY_CONST uint kSheenTextures = 1u << kSlotSheenColor | 1u << kSlotSheenRoughness;
PARITY_CONST uint kAnisotropyTextures = 1u << kSlotAnisotropy;
PARITY_CONST uint kIridescenceTextures = 1u << kSlotIridescence | 1u << kSlotIridescenceThickness;
PARITY_CONST uint kTransmissionTextures = 1u << kSlotTransmission;
PARITY_CONST uint kDiffuseTransmissionTextures = 1u << kSlotDiffuseTransmission | 1u << kSlotDiffuseTransmissionColor;
PARITY_CONST uint kThicknessTextures = 1u << kSlotThickness; // of either
PARITY_CONST uint kLobeTextures = kCoatTextures | kSheenTextures | kAnisotropyTextures | kIridescenceTextures |
                                  kTransmissionTextures | kDiffuseTransmissionTextures | kThicknessTextures;
// In a texture mask, besides the slots: the alpha of normal maps holds the spread of their normals
// (gpu/surface/normal_variance.h).
PARITY_CONST uint kNormalVariance = 1u << kSlotCount;
// Some texture's uvs are transformed, or of the second set.
PARITY_CONST uint kTransformedUvs = 1u << (kSlotCount + 1);
// Occlusion is read apart from metallic-roughness: of another image, or in another way.
PARITY_CONST uint kOcclusionApart = 1u << (kSlotCount + 2);
// What a shader of several materials does if one of them needs it.
PARITY_CONST uint kTextureReads = kTransformedUvs | kOcclusionApart;
// Of a shader, not of a material: some of its materials lack some of its textures.
PARITY_CONST uint kTexturesVary = 1u << (kSlotCount + 3);

// Features of a material, as bits.
PARITY_CONST uint kFeatureUnlit = 1u;
PARITY_CONST uint kFeatureNonmetal = 2u;
PARITY_CONST uint kFeatureFullyRough = 4u;
PARITY_CONST uint kFeatureBlend = 8u;
PARITY_CONST uint kFeatureCoat = 16u;
PARITY_CONST uint kFeatureSheen = 32u;
PARITY_CONST uint kFeatureAnisotropy = 64u;
PARITY_CONST uint kFeatureIridescence = 128u;
PARITY_CONST uint kFeatureTransmission = 256u;
PARITY_CONST uint kFeatureDiffuseTransmission = 512u;
PARITY_CONST uint kFeatureVolume = 1024u; // the mesh bounds a body
// Light passes through the surface.
PARITY_CONST uint kFeatureThrough = kFeatureTransmission | kFeatureDiffuseTransmission;
// What needs the shaders with PARITY_LOBES.
PARITY_CONST uint kFeatureLobes =
    kFeatureCoat | kFeatureSheen | kFeatureAnisotropy | kFeatureIridescence | kFeatureThrough;

// Lights.
PARITY_CONST uint kLightDirectional = 0u;
PARITY_CONST uint kLightPoint = 1u;
PARITY_CONST uint kLightSpot = 2u;
// Kinds of local lights that a scene has, as bits.
PARITY_CONST uint kLocalPoint = 1u;
PARITY_CONST uint kLocalSpot = 2u;
PARITY_CONST uint kLocalAll = 3u;
// Ways in which they fade, as bits: 1 << a kFalloff... number of shading/light.glsl.
PARITY_CONST uint kFalloffsAll = 7u;

// What the vertices of a scene carry, as bits.
PARITY_CONST uint kVertexColors = 1u;
PARITY_CONST uint kVertexUvs = 2u;
PARITY_CONST uint kVertexTangents = 4u;
PARITY_CONST uint kVertexSecondUv = 8u;  // some texture reads the second uv set
PARITY_CONST uint kVertexFog = 16u;      // the scene has fog
PARITY_CONST uint kVertexLightmap = 32u; // some object has a lightmap
PARITY_CONST uint kVertexAll = 63u;
PARITY_CONST uint kVertexMustShift = 16u; // in the constant: what all scenes have, above what some may

PARITY_CONST uint kLampIsLeaf = 1u;
PARITY_CONST uint kLampIsCompact = 2u; // no level holds it
PARITY_CONST uint kMaxLamps = 1152u;   // 512 wide leaves, 64 compact ones, fewer nodes above them than leaves

// Points that stand for the environment (lighting/environment/median_cut.h): the first few serve wide lobes, the many
// after them narrow ones.
PARITY_CONST uint kFewPoints = 512u;
PARITY_CONST uint kManyPoints = 1024u;
PARITY_CONST uint kEnvironmentPoints = kFewPoints + kManyPoints;

// What of baked light a path reads (gpu/surface/baked_maps.h), as bits.
PARITY_CONST uint kBakedLightmap = 1u;
PARITY_CONST uint kBakedSunShadow = 2u;
PARITY_CONST uint kBakedCaptures = 4u;

// Instead of a number known when a shader is specialised: sceneCounts (path.glsl) says it.
PARITY_CONST uint kUnknown = 0xffffffffu;
// Instead of the number of local lights: each group of invocations has a list of those that reach it (highend/).
PARITY_CONST uint kListed = 0xfffffffeu;

PARITY_CONST uint kTermsInA =
    5u; // planes of the first term buffer; the others are in the second: a buffer ends at 128 MiB

// Pictures without a light each (highend/shaders/left_out.glsl), in the planes of terms: at most as many as terms.
PARITY_CONST uint kMaxLeftOut = 8u;

// Planes of resolved materials (shaders/material.comp), in the first term buffer.
PARITY_CONST uint kPlanePosition = 0u; // w: 1 where unlit
PARITY_CONST uint kPlaneNormal = 1u;   // w: metallic
PARITY_CONST uint kPlaneView = 2u;     // w: roughness
PARITY_CONST uint kPlaneF0 = 3u;       // w: F90
PARITY_CONST uint kPlaneEmissive = 4u; // w: occlusion
// In the second.
PARITY_CONST uint kPlaneGeometricNormal = 5u; // w: roughness of the coat
// Of scenes with lobes beside the base's own.
PARITY_CONST uint kPlaneCoatNormal = 6u; // w: coat
PARITY_CONST uint kPlaneSheen = 7u;      // colour; w: roughness
PARITY_CONST uint kPlaneTangent = 8u;    // w: anisotropy
PARITY_CONST uint kPlaneFilm = 9u;       // iridescence, index of refraction, thickness in nm; dispersion
PARITY_CONST uint kPlaneThrough = 10u;   // transmission, index of refraction, thickness in metres; diffuse transmission
PARITY_CONST uint kPlaneAbsorption = 11u;     // of a volume, 1 / metre
PARITY_CONST uint kPlaneDiffuseThrough = 12u; // colour of the diffuse transmission
PARITY_CONST uint kPlaneCount = 13u;

// The mobile path: local lights of an object, and the index that means none.
PARITY_CONST uint kLightsPerObject = 4u;
PARITY_CONST uint kNoLight = 0xffffffffu;

// Values of the paths' own constants.
PARITY_CONST uint kGeometryHeightCorrelated = 0u;
PARITY_CONST uint kGeometrySchlickSmith = 1u;
PARITY_CONST uint kFresnelSchlick = 0u;
PARITY_CONST uint kFresnelSphericalGaussian = 1u;
PARITY_CONST uint kFresnelDielectric = 2u;
PARITY_CONST uint kDiffuseBalanced = 0u;
PARITY_CONST uint kDiffuseLambert = 1u;
PARITY_CONST uint kCompensationNone = 0u;
PARITY_CONST uint kCompensationTurquin = 1u;
PARITY_CONST uint kCompensationFdezAguera = 2u;
PARITY_CONST uint kCompensationKullaConty = 3u;
PARITY_CONST uint kOffSpecularNone = 0u;
PARITY_CONST uint kOffSpecularDominant = 1u;
PARITY_CONST uint kOffSpecularStretched = 2u;
PARITY_CONST uint kOffSpecularTwoTaps = 3u;
PARITY_CONST uint kOffSpecularThreeTaps = 4u;

PARITY_CONST int kPathNumbers = 12;
// Those of the mobile path.
PARITY_CONST int kPathSkySh =
    0; // nine, shading/sky_sh.glsl; or of shading/tinted_sky.glsl c, tint, q of xx xy xz, q of yy yz
PARITY_CONST int kTintedSkyNumbers = 7;
PARITY_CONST int kPathAverageBrightness = 9; // x: of the capture; y: transition scale of the distance-field shadow
PARITY_CONST int kPathMixing = 10;           // MixingRange of shading/capture.glsl: scale, bias, largest
PARITY_CONST int kPathShadows = 11; // of shadow maps; xy: DistanceFade of the sun's; z: sharpen, w: fade of the spot's

// Of the high-end path.
PARITY_CONST int kPathPanorama = 0; // x: turns of PanoramaCells

// Lights that one dispatch of highend/shaders/cull_lights.comp asks, and that a path's shader loops over for a pixel:
// lavapipe ends an invocation's loops after 65,535 turns.
PARITY_CONST uint kMaxCandidates = 32768u;
PARITY_CONST uint kMaxLightsOfAPixel = 60000u;

PARITY_CONST uint kGroupSize = 64u;         // invocations of a compute group
PARITY_CONST uint kMaxGroupsInRow = 32768u; // a dispatch is (row, rows, 1): devices stop at 65,535 groups in x

struct GpuTextureSlot {
  vec4 uvRow0; // m00, m01, m02, uv set (0 or 1)
  vec4 uvRow1; // m10, m11, m12, 1 where the slot has a texture
};

struct GpuMaterial {
  vec4 baseColor;        // linear RGBA
  vec4 emissiveMetallic; // linear RGB; metallic
  vec4 f0Roughness;      // dielectric F0 before `specular`, linear RGB; roughness
  vec4 factors;          // normalScale, occlusionStrength, specular, alphaCutoff (blend: 1/255)
  vec4 coat;             // coat, its roughness, its normalScale; 0
  vec4 sheen;            // linear RGB; roughness
  vec4 anisotropy;       // strength; cosine and sine of its rotation; 0
  vec4 film;             // iridescence, index of refraction, least and greatest thickness in nm
  vec4 through;          // transmission, index of refraction, thickness in the mesh's coordinates; diffuse transmission
  vec4 absorption;       // of a volume, 1 / metre; dispersion
  vec4 diffuseThrough;   // colour of the diffuse transmission; 0
  uvec4 flags;           // features; 0; 0; 0
  GpuTextureSlot slots[kSlotCount];
};

struct GpuInstance {
  vec4 toWorld[3];       // rows of an affine matrix
  vec4 normalToWorld[3]; // rows of the inverse transpose; [0].w: sign of the determinant
  uvec4 geometry;        // first index, base vertex, material, 0
  uvec4 baked;           // first corner of the lightmap's uvs, page + 1 or 0 for none, nearest capture, 0
  vec4 lightmap;         // added to those uvs; 0, 0
};

struct GpuLight {
  vec4 colorRange;        // linear RGB: lux or candela; range (0: infinite)
  vec4 positionKind;      // world; kind as a number
  vec4 directionCosOuter; // unit, the way light travels; cosine of the outer cone
  vec4 cone;              // cosine of the inner cone; scale of its specular light; 1 + its first shadow view, how many
  vec4 falloff;           // kFalloff... of shading/light.glsl; its exponent; 1 + the picture that lacks it, 0: none; 0
};

// A square shadow map in a tile of a layer (gpu/shadows/shadow_views.h), as gpu/shaders/shadow.glsl reads it.
struct GpuShadowView {
  vec4 right;   // unit; texels per tangent (perspective) or metre (orthographic)
  vec4 up;      // unit; layer
  vec4 forward; // unit; near (perspective) or -1 / (far - near) (orthographic)
  vec4 origin;  // world; metres that coordinates may be wrong by
  vec4 tile;    // its centre in texels of the layer; half its side, 0 where there is no map; 1 / side of the layer
};

// An environment capture: a cube of the environment's array, or with the high-end path kPrefilterLayers of them.
struct GpuCapture {
  vec4 position; // where it was taken, world; radius within which it counts
  vec4 boxLower; // of the box whose walls it shows, world; luminance (.3, .59, .11) of its mean radiance
  vec4 boxUpper;
};

// A node of the environment's trees of lamps (lighting/environment/lamp_tree.h), compact lamps first.
struct GpuLamp {
  vec4 directionSpread; // unit, world; mean square distance of the light below from it
  // Radiance times solid angle, linear RGB; 4 n + kLampIsLeaf + kLampIsCompact with the first node n that is not below
  // this one, 0 for none.
  vec4 lightNext;
};

// A point that stands for a part of the environment.
struct GpuEnvironmentPoint {
  vec4 direction; // unit, world; 0
  vec4 light;     // radiance times solid angle, linear RGB; 0
};

// Of an object's LQ lightmap: texel times scale plus add, of the upper half [0] and the lower one [1].
struct GpuLightmapScales {
  vec4 scale0, add0, scale1, add1;
};

// What a view's shaders need. The camera's rays: pixel (x,y) looks from origin + x*originX + y*originY along
// direction + x*directionX + y*directionY. No shader may branch by it (mix selects): lavapipe compiles one that does
// anew for each value, so for each camera.
struct GpuView {
  vec4 eye;                               // perspective: position; w = 1 where orthographic
  vec4 viewer;                            // xyz - w place points from a place to the eye
  vec4 origin, originX, originY;          // relative to eye
  vec4 direction, directionX, directionY; // not normalised
  vec4 forward;                           // unit, along the camera's axis; that of the eye: depth is dot(xyz, p) - w
  vec4 skyLightColor;                     // rgb: scales the sky's light (scenes::LightScales)
  vec4 indirectColorScale;                // rgb: scales the lightmap
  vec4 fog;                               // density, height falloff, height, start distance (shading/fog.glsl)
  vec4 fogColor;                          // rgb: radiance where the fog is dense; its maximum opacity
  vec4 picture[3];                        // w times (u, v) of a world position in the picture, from 0 to 1; w
  vec4 pictureScale;                      // pixels a metre across the view where w is 1; 0, 0, 0
  vec4 path[kPathNumbers];                // the path's own
};

#ifdef __cplusplus
// Of the largest uniform buffer: of the points, which scenes with sheen have; the lamps' is smaller.
inline constexpr std::size_t kLargestUniform = kEnvironmentPoints * sizeof(GpuEnvironmentPoint);
static_assert(kLargestUniform >= kMaxLamps * sizeof(GpuLamp));
} // namespace parity::gpu
#endif
#undef PARITY_CONST
#endif
