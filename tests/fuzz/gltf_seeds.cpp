// Small sound glTF files: images, materials, lights, hierarchies; and all seeds together.
#include "fuzz/gltf_seeds.h"

#include <stdexcept>

#include <webp/encode.h>

#include "base/file.h"
#include "fuzz/seed_parts.h"
#include "scenes/gltf/gltf_writer.h"

namespace parity::tests {
namespace {

using nlohmann::json;
// 8 x 8 grey pixels: one block whose only coefficient is 0 (ITU-T T.81: tables of one code each).
Bytes makeJpeg() {
  std::string text = "\xff\xd8\xff\xdb" + std::string("\0\x43\0", 3) + std::string(64, '\1');
  text += std::string("\xff\xc0\0\x0b\x08\0\x08\0\x08\1\1\x11\0", 13);
  for (const char table : {'\x00', '\x10'}) {
    text += std::string("\xff\xc4\0\x14", 4) + table + '\1';
    text += std::string(16, '\0');
  }
  text += std::string("\xff\xda\0\x08\1\1\0\0\x3f\0\x3f\xff\xd9", 13);
  return toBytes(text.data(), text.size());
}

Bytes makeWebp(bool lossless) {
  const base::Image8 rgba(5, 3, 4, 77);
  std::uint8_t* out = nullptr;
  const std::size_t size = lossless ? WebPEncodeLosslessRGBA(rgba.pixels.data(), 5, 3, 20, &out)
                                    : WebPEncodeRGBA(rgba.pixels.data(), 5, 3, 20, 50, &out);
  if (size == 0) throw std::runtime_error("libwebp encodes nothing");
  Bytes bytes = toBytes(out, size);
  WebPFree(out);
  return bytes;
}

void addTexture(GltfFile& file, const Bytes& image, const char* type) {
  file.json["images"].push_back({{"bufferView", file.addBufferView(image)}, {"mimeType", type}});
  file.json["textures"].push_back({{"source", file.json["images"].size() - 1}, {"sampler", 0}});
  file.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"minFilter", 9987}, {"magFilter", 9729}}};
}

} // namespace

GltfFile makeTextured(const Bytes& image, const char* type) {
  GltfFile file = makeQuad();
  addTexture(file, image, type);
  file.material()["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}, {"roughnessFactor", 0.5}};
  return file;
}

namespace {

GltfFile makeMaterials() {
  GltfFile file = makeTextured(makePng(3, 3), "image/png");
  use(file, {"KHR_texture_transform", "KHR_materials_specular", "KHR_materials_ior", "KHR_materials_emissive_strength",
             "KHR_materials_unlit", "KHR_materials_subsurface"});
  const json transform = {
      {"KHR_texture_transform", {{"offset", {0.5, 0}}, {"rotation", 1}, {"scale", {2, -1}}, {"texCoord", 0}}}};
  file.json["materials"] = {{{"name", "a"},
                             {"pbrMetallicRoughness",
                              {{"baseColorFactor", {1, 0.5, 0, 1}},
                               {"metallicFactor", 0},
                               {"baseColorTexture", {{"index", 0}, {"extensions", transform}}},
                               {"metallicRoughnessTexture", {{"index", 0}}}}},
                             {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
                             {"occlusionTexture", {{"index", 0}, {"strength", 0.5}}},
                             {"emissiveTexture", {{"index", 0}}},
                             {"emissiveFactor", {1, 1, 1}},
                             {"alphaMode", "MASK"},
                             {"alphaCutoff", 0.25},
                             {"doubleSided", true},
                             {"extensions",
                              {{"KHR_materials_specular",
                                {{"specularFactor", 0.5},
                                 {"specularTexture", {{"index", 0}}},
                                 {"specularColorFactor", {1, 0.5, 0.25}},
                                 {"specularColorTexture", {{"index", 0}}}}},
                               {"KHR_materials_ior", {{"ior", 1.4}}},
                               {"KHR_materials_subsurface", {{"subsurfaceFactor", 1}}},
                               {"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}},
                            {{"name", "b"},
                             {"alphaMode", "BLEND"},
                             {"extensions", {{"KHR_materials_unlit", json::object()}}},
                             {"extras", {{"fullyRough", true}}}}};
  json second = file.primitive();
  second["material"] = 1;
  file.json["meshes"][0]["primitives"].push_back(second);
  return file;
}

// A coat and a sheen with all that they can have; the coat's normal map reads another uv set than the base's.
GltfFile makeLobes() {
  GltfFile file = makeTextured(makePng(3, 3), "image/png");
  use(file, {"KHR_texture_transform", "KHR_materials_clearcoat", "KHR_materials_sheen"}, true);
  file.primitive()["attributes"]["TEXCOORD_1"] = file.primitive()["attributes"]["TEXCOORD_0"];
  const json transform = {{"KHR_texture_transform", {{"offset", {0, 0.5}}, {"scale", {2, 2}}, {"texCoord", 1}}}};
  file.material() = {{"normalTexture", {{"index", 0}}},
                     {"extensions",
                      {{"KHR_materials_clearcoat",
                        {{"clearcoatFactor", 0.5},
                         {"clearcoatTexture", {{"index", 0}}},
                         {"clearcoatRoughnessFactor", 0.25},
                         {"clearcoatRoughnessTexture", {{"index", 0}, {"extensions", transform}}},
                         {"clearcoatNormalTexture", {{"index", 0}, {"texCoord", 1}, {"scale", 2}}}}},
                       {"KHR_materials_sheen",
                        {{"sheenColorFactor", {1, 0.5, 0.25}},
                         {"sheenColorTexture", {{"index", 0}}},
                         {"sheenRoughnessFactor", 0.5},
                         {"sheenRoughnessTexture", {{"index", 0}}}}}}}};
  return file;
}

// An anisotropy and a thin film with all that they can have; the tangents follow the anisotropy's texture.
GltfFile makeFilm() {
  GltfFile file = makeTextured(makePng(3, 3), "image/png");
  use(file, {"KHR_texture_transform", "KHR_materials_anisotropy", "KHR_materials_iridescence"}, true);
  file.primitive()["attributes"]["TEXCOORD_1"] = file.primitive()["attributes"]["TEXCOORD_0"];
  const json transform = {{"KHR_texture_transform", {{"rotation", 1}, {"texCoord", 1}}}};
  file.material() = {{"extensions",
                      {{"KHR_materials_anisotropy",
                        {{"anisotropyStrength", 0.5},
                         {"anisotropyRotation", 1},
                         {"anisotropyTexture", {{"index", 0}, {"extensions", transform}}}}},
                       {"KHR_materials_iridescence",
                        {{"iridescenceFactor", 0.5},
                         {"iridescenceTexture", {{"index", 0}}},
                         {"iridescenceIor", 1.5},
                         {"iridescenceThicknessMinimum", 200},
                         {"iridescenceThicknessMaximum", 700},
                         {"iridescenceThicknessTexture", {{"index", 0}, {"texCoord", 1}}}}}}}};
  return file;
}

// A body with all that light through it can have, and diffuse transmission.
GltfFile makeThrough() {
  GltfFile file = makeTextured(makePng(3, 3), "image/png");
  use(file,
      {"KHR_materials_transmission", "KHR_materials_volume", "KHR_materials_ior", "KHR_materials_dispersion",
       "KHR_materials_diffuse_transmission"},
      true);
  file.material() = {
      {"extensions",
       {{"KHR_materials_transmission", {{"transmissionFactor", 0.5}, {"transmissionTexture", {{"index", 0}}}}},
        {"KHR_materials_volume",
         {{"thicknessFactor", 0.5},
          {"thicknessTexture", {{"index", 0}}},
          {"attenuationDistance", 2},
          {"attenuationColor", {0.5, 1, 0.25}}}},
        {"KHR_materials_ior", {{"ior", 1.7}}},
        {"KHR_materials_dispersion", {{"dispersion", 0.5}}},
        {"KHR_materials_diffuse_transmission",
         {{"diffuseTransmissionFactor", 0.25},
          {"diffuseTransmissionTexture", {{"index", 0}}},
          {"diffuseTransmissionColorFactor", {1, 0.5, 0.25}},
          {"diffuseTransmissionColorTexture", {{"index", 0}}}}}}}};
  return file;
}

GltfFile makeSpecularGlossiness() {
  GltfFile file = makeTextured(makePng(2, 2), "image/png");
  use(file, {"KHR_materials_pbrSpecularGlossiness"}, true);
  file.material() = {{"extensions",
                      {{"KHR_materials_pbrSpecularGlossiness",
                        {{"diffuseFactor", {1, 0.5, 0.5, 1}},
                         {"diffuseTexture", {{"index", 0}}},
                         {"specularFactor", {0.2, 0.2, 0.2}},
                         {"glossinessFactor", 0.5},
                         {"specularGlossinessTexture", {{"index", 0}}}}}}}};
  return file;
}

GltfFile makeVariants() {
  GltfFile file = makeQuad();
  use(file, {"KHR_materials_variants"});
  file.json["materials"].push_back({{"name", "other"}});
  file.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "day"}}, {{"name", "night"}}};
  file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0, 1}}}};
  return file;
}

GltfFile makeLightsAndCameras() {
  GltfFile file = makeQuad();
  use(file, {"KHR_lights_punctual"});
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"color", {1, 0.5, 0}}, {"intensity", 3}},
      {{"type", "point"}, {"range", 5}, {"name", "lamp"}, {"extras", {{"falloffExponent", 8}}}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}};
  file.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}, {"zfar", 9}, {"aspectRatio", 1.5}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 2}, {"znear", 0.1}, {"zfar", 10}}}}};
  for (int i = 0; i < 3; ++i)
    file.json["nodes"].push_back({{"translation", {0, i, 2}},
                                  {"rotation", {0, 1, 0, 0}},
                                  {"camera", i % 2},
                                  {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  file.json["nodes"][0]["children"] = {1, 2, 3};
  return file;
}

GltfFile makeHierarchy() {
  GltfFile file = makeQuad();
  file.json["nodes"] = {{{"children", {1, 2}}, {"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 0, 0, 1}}},
                        {{"mesh", 0}, {"scale", {-1, 1, 1}}},
                        {{"children", {3}}, {"name", "b"}},
                        {{"mesh", 0}, {"rotation", {0, 0, 0.6, 0.8}}}};
  file.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {2}}, {"name", "second"}}};
  file.json["scenes"][1]["nodes"] = json::array();
  return file;
}

// Points, lines, strips, fans; with and without indices.
GltfFile makeModes() {
  GltfFile file = makeQuad();
  const json quad = file.primitive();
  for (int mode = 0; mode < 7; ++mode) {
    json primitive = quad;
    primitive["mode"] = mode;
    if (mode % 2) primitive.erase("indices");
    file.json["meshes"][0]["primitives"].push_back(primitive);
  }
  return file;
}

// The same file as text, its buffer in a data uri.
Bytes makeText(const GltfFile& file) {
  json document = file.json;
  document["buffers"] = {
      {{"uri", "data:application/octet-stream;base64," + encodeBase64(file.bin)}, {"byteLength", file.bin.size()}}};
  const std::string text = document.dump();
  return toBytes(text.data(), text.size());
}

} // namespace

std::map<std::string, Bytes> makeGltfSeeds() {
  GltfFile webp = makeTextured(makeWebp(true), "image/webp");
  use(webp, {"EXT_texture_webp"}, true);
  webp.json["textures"][0] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
  const auto makeBasis = [](const char* name) {
    const std::filesystem::path data = std::filesystem::path(PARITY_SOURCE_DIR) / "tests/base/data/ktx2";
    GltfFile file = makeTextured(base::readFile(data / name), "image/ktx2");
    use(file, {"KHR_texture_basisu"}, true);
    file.json["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    return file;
  };
  GltfFile dataImage = makeTextured(makePng(2, 2), "image/png");
  dataImage.json["images"][0] = {{"uri", "data:image/png;base64," + encodeBase64(makePng(2, 2))}};
  const std::map<std::string, GltfFile> files = {{"quad", makeQuad()},
                                                 {"png", makeTextured(makePng(3, 3), "image/png")},
                                                 {"jpeg", makeTextured(makeJpeg(), "image/jpeg")},
                                                 {"basis-etc1s", makeBasis("etc1s.ktx2")},
                                                 {"basis-uastc", makeBasis("uastc_zstd.ktx2")},
                                                 {"webp", webp},
                                                 {"webp-lossy", makeTextured(makeWebp(false), "image/webp")},
                                                 {"data-image", dataImage},
                                                 {"materials", makeMaterials()},
                                                 {"lobes", makeLobes()},
                                                 {"film", makeFilm()},
                                                 {"through", makeThrough()},
                                                 {"specular-glossiness", makeSpecularGlossiness()},
                                                 {"variants", makeVariants()},
                                                 {"lights-cameras", makeLightsAndCameras()},
                                                 {"hierarchy", makeHierarchy()},
                                                 {"modes", makeModes()},
                                                 {"interleaved", makeInterleaved()},
                                                 {"quantized", makeQuantized()},
                                                 {"sparse", makeSparse()},
                                                 {"morphed", makeMorphed()},
                                                 {"skinned", makeSkinned()},
                                                 {"instanced", makeInstanced()},
                                                 {"draco", makeDraco(false)},
                                                 {"draco-edgebreaker", makeDraco(true)},
                                                 {"meshopt", makeMeshopt(nullptr)},
                                                 {"meshopt-filtered", makeMeshopt("EXPONENTIAL")}};
  std::map<std::string, Bytes> seeds;
  for (const auto& [name, file] : files) seeds[name + ".glb"] = makeGlb(file);
  for (const char* name : {"quad", "data-image", "skinned", "draco", "meshopt"})
    seeds[name + std::string(".gltf")] = makeText(files.at(name));
  return seeds;
}

} // namespace parity::tests
