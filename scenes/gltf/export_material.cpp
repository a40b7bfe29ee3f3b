// Materials of a scene into a glTF file: what is at its default is not written.
#include "scenes/gltf/export_material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/image/image_io.h"
#include "base/parallel.h"
#include "base/text/text.h"
#include "scenes/gltf/texture.h"
#include "scenes/texture_slots.h"

namespace parity::scenes {

namespace {

using tinygltf::Value;

int codeOf(Wrap wrap) {
  return wrap == Wrap::repeat           ? TINYGLTF_TEXTURE_WRAP_REPEAT
         : wrap == Wrap::mirroredRepeat ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT
                                        : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
}

int minCodeOf(const Sampler& sampler) {
  const bool isLinear = sampler.minFilter == Filter::linear;
  if (!sampler.useMips) return isLinear ? TINYGLTF_TEXTURE_FILTER_LINEAR : TINYGLTF_TEXTURE_FILTER_NEAREST;
  if (sampler.mipFilter == Filter::linear)
    return isLinear ? TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR : TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
  return isLinear ? TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST : TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST;
}

class MaterialWriter {
public:
  MaterialWriter(GlbDraft& draft, const Scene& scene) : m_draft(draft), m_scene(scene) {}

  void write() {
    addImages();
    for (const Material& material : m_scene.materials) {
      m_place = fmt::format("material '{}'", material.name);
      m_draft.model.materials.push_back(describe(material));
    }
  }

private:
  // Each that some slot reads, in the order of the scene: a PNG in a view of its own.
  void addImages() {
    std::set<int> used;
    for (const Material& material : m_scene.materials)
      for (const NamedSlot& each : kTextureSlots)
        if (const TextureSlot& slot = material.*each.slot; slot.present()) used.insert(slot.image);
    std::vector<std::vector<std::byte>> files(used.size());
    std::vector<std::function<void()>> tasks;
    for (const int image : used) {
      const TextureImage& source = m_scene.images[static_cast<std::size_t>(image)];
      std::vector<std::byte>& file = files[m_images.size()];
      m_images.emplace(image, static_cast<int>(m_images.size()));
      if (source.pixels.empty()) throw m_draft.error(fmt::format("image '{}'", source.name), "was not read");
      tasks.emplace_back([&source, &file] {
        constexpr int kCompression = 6; // the file is written once and sent often
        file = base::encodeImage8(source.name + ".png", source.pixels,
                                  {.channelNames = {}, .pngCompression = kCompression});
      });
    }
    base::parallelInvoke(tasks);
    std::size_t place = 0;
    for (const int image : used) {
      tinygltf::Image& added = m_draft.model.images.emplace_back();
      added.name = base::cleanUtf8(m_scene.images[static_cast<std::size_t>(image)].name);
      added.mimeType = "image/png";
      added.bufferView = m_draft.addView(files[place++], 0);
    }
  }

  int samplerOf(const Sampler& sampler) {
    const auto found = std::ranges::find(m_samplers, sampler);
    if (found != m_samplers.end()) return static_cast<int>(found - m_samplers.begin());
    m_samplers.push_back(sampler);
    tinygltf::Sampler& added = m_draft.model.samplers.emplace_back();
    added.wrapS = codeOf(sampler.wrapU);
    added.wrapT = codeOf(sampler.wrapV);
    added.magFilter =
        sampler.magFilter == Filter::linear ? TINYGLTF_TEXTURE_FILTER_LINEAR : TINYGLTF_TEXTURE_FILTER_NEAREST;
    added.minFilter = minCodeOf(sampler);
    return static_cast<int>(m_samplers.size() - 1);
  }

  int textureOf(const TextureSlot& slot) {
    const std::pair key(m_images.at(slot.image), samplerOf(slot.sampler));
    const auto [place, isNew] = m_textures.try_emplace(key, static_cast<int>(m_draft.model.textures.size()));
    if (isNew) {
      tinygltf::Texture& texture = m_draft.model.textures.emplace_back();
      texture.source = key.first;
      texture.sampler = key.second;
    }
    return place->second;
  }

  Value useExtension(const char* name, Value value) {
    m_draft.extensions.insert(name);
    return value;
  }

  // KHR_texture_transform of a slot that has one.
  std::optional<Value> transformOf(const TextureSlot& slot, const char* key) {
    if (slot.uvTransform == TextureSlot().uvTransform) return std::nullopt;
    const std::optional<UvTransformParts> parts = splitUvTransform(slot.uvTransform);
    if (!parts)
      throw m_draft.error(fmt::format("{}: {}", m_place, key),
                          "its uv transform is sheared, which KHR_texture_transform cannot say");
    Value::Object members;
    if (parts->offset != glm::dvec2(0)) members["offset"] = gltfArray(std::array{parts->offset.x, parts->offset.y});
    if (parts->rotation != 0) members["rotation"] = Value(parts->rotation);
    if (parts->scale != glm::dvec2(1)) members["scale"] = gltfArray(std::array{parts->scale.x, parts->scale.y});
    return useExtension("KHR_texture_transform", gltfObject(std::move(members)));
  }

  // Into one of tinygltf's kinds of textureInfo.
  void fill(auto& info, const TextureSlot& slot, const char* key) {
    if (!slot.present()) return;
    info.index = textureOf(slot);
    info.texCoord = slot.texCoord;
    if (std::optional<Value> transform = transformOf(slot, key))
      info.extensions["KHR_texture_transform"] = std::move(*transform);
  }

  // Into an extension: numbers and colours that are not at their default, textures that are there.
  static void addNumber(Value::Object& object, const char* key, float value, float otherwise) {
    if (value != otherwise) object[key] = Value(static_cast<double>(value));
  }
  static void addColor(Value::Object& object, const char* key, const glm::vec3& value, float otherwise) {
    const glm::dvec3 color(value);
    if (value != glm::vec3(otherwise)) object[key] = gltfArray(std::array{color.x, color.y, color.z});
  }
  void addTexture(Value::Object& object, const char* key, const TextureSlot& slot, float scale = 1) {
    if (!slot.present()) return;
    Value::Object info{{"index", Value(textureOf(slot))}};
    if (slot.texCoord != 0) info["texCoord"] = Value(slot.texCoord);
    addNumber(info, "scale", scale, 1);
    if (std::optional<Value> transform = transformOf(slot, key))
      info["extensions"] = gltfObject({{"KHR_texture_transform", std::move(*transform)}});
    object[key] = gltfObject(std::move(info));
  }
  void addExtension(tinygltf::Material& out, const char* name, Value::Object members) {
    if (!members.empty()) out.extensions[name] = useExtension(name, gltfObject(std::move(members)));
  }

  void fillEmission(tinygltf::Material& out, const glm::vec3& emissive) {
    const float largest = std::max({emissive.x, emissive.y, emissive.z});
    double strength = 1;
    if (largest > 1) {
      // A power of two, so that factor times strength is the very number again.
      strength = std::exp2(std::ceil(std::log2(static_cast<double>(largest))));
      if (strength > static_cast<double>(std::numeric_limits<float>::max()))
        strength = largest; // the loader has floats
      out.extensions["KHR_materials_emissive_strength"] =
          useExtension("KHR_materials_emissive_strength", gltfObject({{"emissiveStrength", Value(strength)}}));
    }
    out.emissiveFactor.clear();
    for (int i = 0; i < 3; ++i) out.emissiveFactor.push_back(emissive[i] / strength);
  }

  void fillSpecular(tinygltf::Material& out, const Material& material) {
    if (material.ior != Material().ior)
      out.extensions["KHR_materials_ior"] =
          useExtension("KHR_materials_ior", gltfObject({{"ior", Value(static_cast<double>(material.ior))}}));
    Value::Object specular;
    addNumber(specular, "specularFactor", material.specular, 1);
    addColor(specular, "specularColorFactor", material.specularColor, 1);
    addTexture(specular, "specularTexture", material.specularTexture);
    addTexture(specular, "specularColorTexture", material.specularColorTexture);
    addExtension(out, "KHR_materials_specular", std::move(specular));
  }

  void fillCoat(tinygltf::Material& out, const Material& material) {
    Value::Object coat;
    addNumber(coat, "clearcoatFactor", material.coat, 0);
    addNumber(coat, "clearcoatRoughnessFactor", material.coatRoughness, 0);
    addTexture(coat, "clearcoatTexture", material.coatTexture);
    addTexture(coat, "clearcoatRoughnessTexture", material.coatRoughnessTexture);
    addTexture(coat, "clearcoatNormalTexture", material.coatNormalTexture, material.coatNormalScale);
    addExtension(out, "KHR_materials_clearcoat", std::move(coat));
  }

  void fillSheen(tinygltf::Material& out, const Material& material) {
    Value::Object sheen;
    addColor(sheen, "sheenColorFactor", material.sheenColor, 0);
    addNumber(sheen, "sheenRoughnessFactor", material.sheenRoughness, 0);
    addTexture(sheen, "sheenColorTexture", material.sheenColorTexture);
    addTexture(sheen, "sheenRoughnessTexture", material.sheenRoughnessTexture);
    addExtension(out, "KHR_materials_sheen", std::move(sheen));
  }

  void fillAnisotropy(tinygltf::Material& out, const Material& material) {
    Value::Object anisotropy;
    addNumber(anisotropy, "anisotropyStrength", material.anisotropy, 0);
    addNumber(anisotropy, "anisotropyRotation", material.anisotropyRotation, 0);
    addTexture(anisotropy, "anisotropyTexture", material.anisotropyTexture);
    addExtension(out, "KHR_materials_anisotropy", std::move(anisotropy));
  }

  void fillIridescence(tinygltf::Material& out, const Material& material) {
    const Material none;
    Value::Object film;
    addNumber(film, "iridescenceFactor", material.iridescence, none.iridescence);
    addNumber(film, "iridescenceIor", material.iridescenceIor, none.iridescenceIor);
    addNumber(film, "iridescenceThicknessMinimum", material.iridescenceThicknessMin, none.iridescenceThicknessMin);
    addNumber(film, "iridescenceThicknessMaximum", material.iridescenceThicknessMax, none.iridescenceThicknessMax);
    addTexture(film, "iridescenceTexture", material.iridescenceTexture);
    addTexture(film, "iridescenceThicknessTexture", material.iridescenceThicknessTexture);
    addExtension(out, "KHR_materials_iridescence", std::move(film));
  }

  void fillTransmission(tinygltf::Material& out, const Material& material) {
    Value::Object transmission, diffuse, volume, dispersion;
    addNumber(transmission, "transmissionFactor", material.transmission, 0);
    addTexture(transmission, "transmissionTexture", material.transmissionTexture);
    addExtension(out, "KHR_materials_transmission", std::move(transmission));
    addNumber(diffuse, "diffuseTransmissionFactor", material.diffuseTransmission, 0);
    addColor(diffuse, "diffuseTransmissionColorFactor", material.diffuseTransmissionColor, 1);
    addTexture(diffuse, "diffuseTransmissionTexture", material.diffuseTransmissionTexture);
    addTexture(diffuse, "diffuseTransmissionColorTexture", material.diffuseTransmissionColorTexture);
    addExtension(out, "KHR_materials_diffuse_transmission", std::move(diffuse));
    addNumber(volume, "thicknessFactor", material.thickness, 0);
    addNumber(volume, "attenuationDistance", material.attenuationDistance, 0);
    addColor(volume, "attenuationColor", material.attenuationColor, 1);
    addTexture(volume, "thicknessTexture", material.thicknessTexture);
    addExtension(out, "KHR_materials_volume", std::move(volume));
    addNumber(dispersion, "dispersion", material.dispersion, 0);
    addExtension(out, "KHR_materials_dispersion", std::move(dispersion));
  }

  tinygltf::Material describe(const Material& material) {
    tinygltf::Material out;
    out.name = base::cleanUtf8(material.name);
    tinygltf::PbrMetallicRoughness& pbr = out.pbrMetallicRoughness;
    pbr.baseColorFactor.clear();
    for (int i = 0; i < 4; ++i) pbr.baseColorFactor.push_back(material.baseColor[i]);
    pbr.metallicFactor = material.metallic;
    pbr.roughnessFactor = material.roughness;
    fill(pbr.baseColorTexture, material.baseColorTexture, "baseColorTexture");
    fill(pbr.metallicRoughnessTexture, material.metallicRoughnessTexture, "metallicRoughnessTexture");
    fill(out.normalTexture, material.normalTexture, "normalTexture");
    out.normalTexture.scale = material.normalScale;
    fill(out.occlusionTexture, material.occlusionTexture, "occlusionTexture");
    out.occlusionTexture.strength = material.occlusionStrength;
    fill(out.emissiveTexture, material.emissiveTexture, "emissiveTexture");
    fillEmission(out, material.emissive);
    out.alphaMode = material.alphaMode == AlphaMode::opaque ? "OPAQUE"
                    : material.alphaMode == AlphaMode::mask ? "MASK"
                                                            : "BLEND";
    if (material.alphaMode == AlphaMode::mask) out.alphaCutoff = material.alphaCutoff; // of no use else
    out.doubleSided = material.doubleSided;
    if (material.unlit) out.extensions["KHR_materials_unlit"] = useExtension("KHR_materials_unlit", gltfObject());
    fillSpecular(out, material);
    fillCoat(out, material);
    fillSheen(out, material);
    fillAnisotropy(out, material);
    fillIridescence(out, material);
    fillTransmission(out, material);
    if (material.fullyRough) out.extras = gltfObject({{"fullyRough", Value(true)}});
    return out;
  }

  GlbDraft& m_draft;
  const Scene& m_scene;
  std::string m_place;                           // the material, for messages
  std::map<int, int> m_images;                   // of the scene -> of the file
  std::vector<Sampler> m_samplers;               // of the file
  std::map<std::pair<int, int>, int> m_textures; // by image and sampler of the file
};

} // namespace

void addMaterials(GlbDraft& draft, const Scene& scene) { MaterialWriter(draft, scene).write(); }

} // namespace parity::scenes
