// What glTF 2.0 and the extensions that we read say about the types of properties, as data.
#include "scenes/gltf/file/rules.h"

#include <array>

namespace parity::scenes {
namespace {

using Texts = std::span<const std::string_view>;

constexpr Rule number(std::string_view key) { return {.key = key, .kind = RuleKind::number}; }
constexpr Rule numbers(std::string_view key, std::size_t size) {
  return {.key = key, .kind = RuleKind::numbers, .size = size};
}
constexpr Rule text(std::string_view key, Texts choices = {}) {
  return {.key = key, .kind = RuleKind::text, .choices = choices};
}
constexpr Rule texts(std::string_view key) { return {.key = key, .kind = RuleKind::texts}; }
constexpr Rule count(std::string_view key, std::span<const int> codes = {}) {
  return {.key = key, .kind = RuleKind::count, .codes = codes};
}
constexpr Rule boolean(std::string_view key) { return {.key = key, .kind = RuleKind::boolean}; }
constexpr Rule index(std::string_view key, std::string_view target) {
  return {.key = key, .kind = RuleKind::index, .target = target};
}
constexpr Rule indices(std::string_view key, std::string_view target) {
  return {.key = key, .kind = RuleKind::indices, .target = target};
}
constexpr Rule indexMap(std::string_view key, std::string_view target) {
  return {.key = key, .kind = RuleKind::indexMap, .target = target};
}
constexpr Rule object(std::string_view key, std::span<const Rule> rules) {
  return {.key = key, .kind = RuleKind::object, .rules = rules};
}
constexpr Rule objects(std::string_view key, std::span<const Rule> rules) {
  return {.key = key, .kind = RuleKind::objects, .rules = rules};
}
constexpr Rule required(Rule rule) {
  rule.required = true;
  return rule;
}

constexpr std::string_view kLights = "extensions/KHR_lights_punctual/lights";
constexpr std::string_view kVariants = "extensions/KHR_materials_variants/variants";

// ---- textures
constexpr Rule kTransform[] = {numbers("offset", 2), number("rotation"), numbers("scale", 2), count("texCoord")};
constexpr Rule kTextureInfoExtensions[] = {object("KHR_texture_transform", kTransform)};
constexpr Rule kTextureInfo[] = {required(index("index", "textures")), count("texCoord"), number("scale"),
                                 number("strength"), object("extensions", kTextureInfoExtensions)};
constexpr Rule kTextureSource[] = {required(index("source", "images"))};
constexpr Rule kTextureExtensions[] = {object("EXT_texture_webp", kTextureSource),
                                       object("KHR_texture_basisu", kTextureSource)};
constexpr Rule kTexture[] = {index("source", "images"), index("sampler", "samplers"), text("name"),
                             object("extensions", kTextureExtensions)};
constexpr Rule kImage[] = {text("uri"), text("mimeType"), index("bufferView", "bufferViews"), text("name")};
constexpr int kMagFilters[] = {9728, 9729}, kMinFilters[] = {9728, 9729, 9984, 9985, 9986, 9987},
              kWraps[] = {10497, 33071, 33648};
constexpr Rule kSampler[] = {count("magFilter", kMagFilters), count("minFilter", kMinFilters), count("wrapS", kWraps),
                             count("wrapT", kWraps), text("name")};

// ---- materials
constexpr Rule kPbr[] = {numbers("baseColorFactor", 4), object("baseColorTexture", kTextureInfo),
                         number("metallicFactor"), number("roughnessFactor"),
                         object("metallicRoughnessTexture", kTextureInfo)};
constexpr Rule kSpecular[] = {number("specularFactor"), object("specularTexture", kTextureInfo),
                              numbers("specularColorFactor", 3), object("specularColorTexture", kTextureInfo)};
constexpr Rule kCoat[] = {number("clearcoatFactor"), object("clearcoatTexture", kTextureInfo),
                          number("clearcoatRoughnessFactor"), object("clearcoatRoughnessTexture", kTextureInfo),
                          object("clearcoatNormalTexture", kTextureInfo)};
constexpr Rule kSheen[] = {numbers("sheenColorFactor", 3), object("sheenColorTexture", kTextureInfo),
                           number("sheenRoughnessFactor"), object("sheenRoughnessTexture", kTextureInfo)};
constexpr Rule kAnisotropy[] = {number("anisotropyStrength"), number("anisotropyRotation"),
                                object("anisotropyTexture", kTextureInfo)};
constexpr Rule kIridescence[] = {number("iridescenceFactor"),
                                 object("iridescenceTexture", kTextureInfo),
                                 number("iridescenceIor"),
                                 number("iridescenceThicknessMinimum"),
                                 number("iridescenceThicknessMaximum"),
                                 object("iridescenceThicknessTexture", kTextureInfo)};
constexpr Rule kTransmission[] = {number("transmissionFactor"), object("transmissionTexture", kTextureInfo)};
constexpr Rule kDiffuseTransmission[] = {
    number("diffuseTransmissionFactor"), object("diffuseTransmissionTexture", kTextureInfo),
    numbers("diffuseTransmissionColorFactor", 3), object("diffuseTransmissionColorTexture", kTextureInfo)};
constexpr Rule kVolume[] = {number("thicknessFactor"), object("thicknessTexture", kTextureInfo),
                            number("attenuationDistance"), numbers("attenuationColor", 3)};
constexpr Rule kDispersion[] = {number("dispersion")};
constexpr Rule kSpecularGlossiness[] = {numbers("diffuseFactor", 4), object("diffuseTexture", kTextureInfo),
                                        numbers("specularFactor", 3), number("glossinessFactor"),
                                        object("specularGlossinessTexture", kTextureInfo)};
constexpr Rule kIor[] = {number("ior")};
constexpr Rule kEmissiveStrength[] = {number("emissiveStrength")};
constexpr Rule kMaterialExtensions[] = {object("KHR_materials_specular", kSpecular),
                                        object("KHR_materials_ior", kIor),
                                        object("KHR_materials_clearcoat", kCoat),
                                        object("KHR_materials_sheen", kSheen),
                                        object("KHR_materials_anisotropy", kAnisotropy),
                                        object("KHR_materials_iridescence", kIridescence),
                                        object("KHR_materials_transmission", kTransmission),
                                        object("KHR_materials_diffuse_transmission", kDiffuseTransmission),
                                        object("KHR_materials_volume", kVolume),
                                        object("KHR_materials_dispersion", kDispersion),
                                        object("KHR_materials_emissive_strength", kEmissiveStrength),
                                        object("KHR_materials_unlit", {}),
                                        object("KHR_materials_pbrSpecularGlossiness", kSpecularGlossiness)};
constexpr std::string_view kAlphaModes[] = {"OPAQUE", "MASK", "BLEND"};
constexpr Rule kMaterial[] = {text("name"),
                              object("pbrMetallicRoughness", kPbr),
                              object("normalTexture", kTextureInfo),
                              object("occlusionTexture", kTextureInfo),
                              object("emissiveTexture", kTextureInfo),
                              numbers("emissiveFactor", 3),
                              text("alphaMode", kAlphaModes),
                              number("alphaCutoff"),
                              boolean("doubleSided"),
                              object("extensions", kMaterialExtensions)};

// ---- geometry
constexpr std::string_view kMeshoptModes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"},
                           kMeshoptFilters[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
constexpr Rule kMeshopt[] = {
    required(index("buffer", "buffers")), count("byteOffset"),      required(count("byteLength")),
    required(count("byteStride")),        required(count("count")), required(text("mode", kMeshoptModes)),
    text("filter", kMeshoptFilters)};
constexpr Rule kViewExtensions[] = {object("EXT_meshopt_compression", kMeshopt)};
constexpr Rule kMeshoptBuffer[] = {boolean("fallback")};
constexpr Rule kBufferExtensions[] = {object("EXT_meshopt_compression", kMeshoptBuffer)};
constexpr Rule kBuffer[] = {required(count("byteLength")), text("uri"), text("name"),
                            object("extensions", kBufferExtensions)};
constexpr Rule kBufferView[] = {required(index("buffer", "buffers")),
                                count("byteOffset"),
                                required(count("byteLength")),
                                count("byteStride"),
                                text("name"),
                                object("extensions", kViewExtensions)};
constexpr int kComponentTypes[] = {5120, 5121, 5122, 5123, 5125, 5126}, kSparseTypes[] = {5121, 5123, 5125},
              kPrimitiveModes[] = {0, 1, 2, 3, 4, 5, 6};
constexpr std::string_view kAccessorTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
constexpr Rule kSparseIndices[] = {required(index("bufferView", "bufferViews")), count("byteOffset"),
                                   required(count("componentType", kSparseTypes))};
constexpr Rule kSparseValues[] = {required(index("bufferView", "bufferViews")), count("byteOffset")};
constexpr Rule kSparse[] = {required(count("count")), required(object("indices", kSparseIndices)),
                            required(object("values", kSparseValues))};
constexpr Rule kAccessor[] = {index("bufferView", "bufferViews"),
                              count("byteOffset"),
                              required(count("componentType", kComponentTypes)),
                              boolean("normalized"),
                              required(count("count")),
                              required(text("type", kAccessorTypes)),
                              text("name"),
                              numbers("min", 0),
                              numbers("max", 0),
                              object("sparse", kSparse)};
constexpr Rule kDraco[] = {required(index("bufferView", "bufferViews")),
                           required({.key = "attributes", .kind = RuleKind::indexMap})};
constexpr Rule kMapping[] = {required(index("material", "materials")), required(indices("variants", kVariants))};
constexpr Rule kMappings[] = {required(objects("mappings", kMapping))};
constexpr Rule kPrimitiveExtensions[] = {object("KHR_draco_mesh_compression", kDraco),
                                         object("KHR_materials_variants", kMappings)};
constexpr Rule kPrimitive[] = {required(indexMap("attributes", "accessors")),
                               index("indices", "accessors"),
                               index("material", "materials"),
                               count("mode", kPrimitiveModes),
                               {.key = "targets", .kind = RuleKind::indexMaps, .target = "accessors"},
                               object("extensions", kPrimitiveExtensions)};
constexpr Rule kMesh[] = {text("name"), required(objects("primitives", kPrimitive)), numbers("weights", 0)};

// ---- hierarchy
constexpr Rule kNodeLight[] = {required(index("light", kLights))};
constexpr Rule kInstancing[] = {required(indexMap("attributes", "accessors"))};
constexpr Rule kNodeExtensions[] = {object("KHR_lights_punctual", kNodeLight),
                                    object("EXT_mesh_gpu_instancing", kInstancing)};
constexpr Rule kNode[] = {text("name"),
                          index("mesh", "meshes"),
                          index("camera", "cameras"),
                          index("skin", "skins"),
                          indices("children", "nodes"),
                          numbers("matrix", 16),
                          numbers("translation", 3),
                          numbers("rotation", 4),
                          numbers("scale", 3),
                          numbers("weights", 0),
                          object("extensions", kNodeExtensions)};
constexpr Rule kScene[] = {text("name"), indices("nodes", "nodes")};
constexpr Rule kSkin[] = {text("name"), index("inverseBindMatrices", "accessors"), index("skeleton", "nodes"),
                          required(indices("joints", "nodes"))};
constexpr std::string_view kInterpolations[] = {"LINEAR", "STEP", "CUBICSPLINE"};
constexpr Rule kChannelTarget[] = {index("node", "nodes"), required(text("path"))};
constexpr Rule kChannel[] = {required(count("sampler")), required(object("target", kChannelTarget))};
constexpr Rule kAnimationSampler[] = {required(index("input", "accessors")), required(index("output", "accessors")),
                                      text("interpolation", kInterpolations)};
constexpr Rule kAnimation[] = {text("name"), required(objects("channels", kChannel)),
                               required(objects("samplers", kAnimationSampler))};

// ---- cameras and lights
constexpr std::string_view kCameraTypes[] = {"perspective", "orthographic"},
                           kLightTypes[] = {"directional", "point", "spot"};
constexpr Rule kPerspective[] = {required(number("yfov")), required(number("znear")), number("zfar"),
                                 number("aspectRatio")};
constexpr Rule kOrthographic[] = {required(number("xmag")), required(number("ymag")), required(number("znear")),
                                  required(number("zfar"))};
constexpr Rule kCamera[] = {required(text("type", kCameraTypes)), text("name"), object("perspective", kPerspective),
                            object("orthographic", kOrthographic)};
constexpr Rule kSpot[] = {number("innerConeAngle"), number("outerConeAngle")};
constexpr Rule kLight[] = {required(text("type", kLightTypes)),
                           text("name"),
                           numbers("color", 3),
                           number("intensity"),
                           number("range"),
                           object("spot", kSpot)};
constexpr Rule kLightsExtension[] = {required(objects("lights", kLight))};
constexpr Rule kVariant[] = {required(text("name"))};
constexpr Rule kVariantsExtension[] = {required(objects("variants", kVariant))};
constexpr Rule kExtensions[] = {object("KHR_lights_punctual", kLightsExtension),
                                object("KHR_materials_variants", kVariantsExtension)};

constexpr Rule kAsset[] = {required(text("version")), text("minVersion"), text("generator"), text("copyright")};
constexpr Rule kDocument[] = {
    required(object("asset", kAsset)), texts("extensionsUsed"),           texts("extensionsRequired"),
    index("scene", "scenes"),          objects("scenes", kScene),         objects("nodes", kNode),
    objects("meshes", kMesh),          objects("accessors", kAccessor),   objects("bufferViews", kBufferView),
    objects("buffers", kBuffer),       objects("materials", kMaterial),   objects("textures", kTexture),
    objects("images", kImage),         objects("samplers", kSampler),     objects("cameras", kCamera),
    objects("skins", kSkin),           objects("animations", kAnimation), object("extensions", kExtensions)};

} // namespace

std::span<const Rule> gltfRules() { return kDocument; }

} // namespace parity::scenes
