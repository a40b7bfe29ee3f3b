// Words of the formats: what mutations put in, and libFuzzer's dictionaries.
#pragma once

namespace parity::tests {

// clang-format off
inline constexpr const char* kGltfValues[] = {
    "", "SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4", "OPAQUE", "MASK", "BLEND", "LINEAR", "STEP",
    "CUBICSPLINE", "translation", "rotation", "scale", "weights", "pointer", "perspective", "orthographic",
    "directional", "point", "spot", "ATTRIBUTES", "TRIANGLES", "INDICES", "NONE", "OCTAHEDRAL", "QUATERNION",
    "EXPONENTIAL", "image/png", "image/webp", "2.0", "../x", "data:, ", "data:;base64,AAAA", "x.bin", "\xc3\xa4%20/"};

inline constexpr const char* kGltfKeys[] = {
    "accessors", "alphaCutoff", "alphaMode", "animations", "anisotropyRotation", "anisotropyStrength", "anisotropyTexture",
    "attenuationColor", "attenuationDistance", "attributes", "baseColorTexture", "buffer", "bufferView",
    "bufferViews", "byteLength", "byteOffset", "byteStride", "cameras", "channels", "children",
    "clearcoatFactor", "clearcoatNormalTexture", "componentType", "count",
    "diffuseTransmissionColorFactor", "diffuseTransmissionColorTexture", "diffuseTransmissionFactor",
    "diffuseTransmissionTexture", "dispersion", "extensions", "extensionsUsed", "filter",
    "images", "indices", "input", "instances", "interpolation",
    "inverseBindMatrices", "iridescenceFactor", "iridescenceIor", "iridescenceTexture", "iridescenceThicknessMaximum",
    "iridescenceThicknessTexture", "joints", "light", "mappings", "material", "materials", "matrix", "max", "mesh", "meshes",
    "min", "minVersion", "mode", "node", "nodes", "normalized", "normalTexture", "output", "path", "primitives",
    "range", "rotation", "sampler", "samplers", "scale", "scene", "scenes",
    "sheenColorFactor", "sheenColorTexture", "skeleton", "skin", "skins", "source", "sparse", "spot", "target", "targets",
    "texCoord", "textures",
    "thicknessFactor", "thicknessTexture", "translation", "transmissionFactor", "transmissionTexture", "type", "uri", "values",
    "variants", "weights", "POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "TEXCOORD_9", "COLOR_0",
    "JOINTS_0", "JOINTS_1", "WEIGHTS_0", "WEIGHTS_1", "TRANSLATION", "ROTATION", "SCALE", "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression", "EXT_texture_webp", "KHR_draco_mesh_compression", "KHR_lights_punctual",
    "KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion", "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness", "KHR_materials_sheen", "KHR_materials_specular",
    "KHR_materials_transmission", "KHR_materials_unlit", "KHR_materials_variants", "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_basisu", "KHR_texture_transform"};

inline constexpr const char* kEnvironmentWords[] = {
    "#?RADIANCE", "#?RGBE", "FORMAT=32-bit_rle_rgbe", "EXPOSURE=", "GAMMA=", "-Y ", "+Y ", "+X ", "-X ",
    "PIXASPECT=", "PF", "Pf", "-1.0", "channels", "chlist", "compression", "dataWindow", "displayWindow", "box2i",
    "lineOrder", "pixelAspectRatio", "screenWindowCenter", "screenWindowWidth", "float", "v2f", "tiles", "tiledesc",
    "type", "string", "scanlineimage", "tiledimage", "deepscanline", "deeptile", "name", "chunkCount", "version",
    "maxSamplesPerPixel", "preview", "chromaticities", "multiView", "stringvector", "dwaCompressionLevel",
    "rational", "framesPerSecond", "timecode", "keycode", "envmap"};

inline constexpr const char* kImageWords[] = {
    "IHDR", "IDAT", "IEND", "PLTE", "tRNS", "iCCP", "eXIf", "iTXt", "ICC_PROFILE", "Exif", "JFIF", "http://ns.adobe.com/xap/1.0/",
    "Photoshop 3.0", "8BIM", "acsp", "desc", "cprt", "mluc", "mntrRGB XYZ ", "VP8X", "VP8L", "VP8 ", "ICCP", "ALPH", "EXIF",
    "\xff\xe2", "\xff\xe1", "\xff\xed", "\xff\xc0", "\xff\xc2", "\xff\xda", "\xff\xd9", "II*", "MM", "\x73\x87", "\x83\xbb", "\x87\x69"};
// clang-format on

} // namespace parity::tests
