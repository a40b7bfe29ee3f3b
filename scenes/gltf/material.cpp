// Materials of a glTF file.
#include "scenes/gltf/material.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scenes/gltf/file/extensions.h"
#include "scenes/gltf/texture.h"
#include "scenes/names.h"
#include "scenes/texture_slots.h"

namespace parity::scenes {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
// Beyond any film, and so that the path of light in one is a float of which a turn can be told.
constexpr float kMostFilmIor = 10, kMostFilmNm = 1e6f;
// Of an Abbe number of 1; that of rutile is 9.8.
constexpr float kMostDispersion = 20;
// Metres, beyond any body: its square is a float.
constexpr float kMostLength = 1e18f;

// Reads one material; its factors are clamped here, with a warning each.
class MaterialReader {
public:
  MaterialReader(const GltfDocument& document, std::size_t index, DerivedImages& derived,
                 std::vector<std::string>& warnings)
      : m_document(document), m_source(document.model.materials[index]), m_place(fmt::format("/materials/{}", index)),
        m_derived(derived), m_warnings(warnings) {}

  // The rest of glTF's defaults where something is wrong.
  Material read(std::string name, UvSets& sets) {
    m_material.name = std::move(name);
    readSurface();
    readAlpha();
    readExtensions();
    const tinygltf::Value& extras = m_source.extras;
    m_material.fullyRough = extras.IsObject() && extras.Has("fullyRough") && extras.Get("fullyRough").IsBool() &&
                            extras.Get("fullyRough").Get<bool>();
    dropIdleTextures();
    sets = chooseUvSets();
    checkFrames(sets);
    return std::move(m_material);
  }

private:
  float clamp(double value, float lower, float upper, const char* factor) {
    const float clamped = std::clamp(static_cast<float>(value), lower, upper);
    if (clamped != static_cast<float>(value))
      m_warnings.push_back(fmt::format("{}: {} of {} is out of range, {} is used", m_place, factor, value, clamped));
    return clamped;
  }

  TextureSlot slot(const auto& info, const char* key) const {
    return readTextureSlot(m_document, info.index, info.texCoord, info.extensions, fmt::format("{}/{}", m_place, key));
  }

  void readSurface() {
    const tinygltf::PbrMetallicRoughness& pbr = m_source.pbrMetallicRoughness;
    for (int i = 0; i < 4; ++i)
      m_material.baseColor[i] = clamp(pbr.baseColorFactor[static_cast<std::size_t>(i)], 0, 1, "baseColorFactor");
    m_material.metallic = clamp(pbr.metallicFactor, 0, 1, "metallicFactor");
    m_material.roughness = clamp(pbr.roughnessFactor, 0, 1, "roughnessFactor");
    m_material.normalScale = static_cast<float>(m_source.normalTexture.scale);
    m_material.occlusionStrength = clamp(m_source.occlusionTexture.strength, 0, 1, "occlusionTexture.strength");
    for (int i = 0; i < 3; ++i)
      m_material.emissive[i] = clamp(m_source.emissiveFactor[static_cast<std::size_t>(i)], 0, kInf, "emissiveFactor");
    if (std::max({m_material.emissive.x, m_material.emissive.y, m_material.emissive.z}) > 1) // as some exporters write
      m_warnings.push_back(fmt::format("{}: emissiveFactor is above 1 and is used as it is "
                                       "(the proper way is KHR_materials_emissive_strength)",
                                       m_place));
    m_material.baseColorTexture = slot(pbr.baseColorTexture, "pbrMetallicRoughness/baseColorTexture");
    m_material.metallicRoughnessTexture =
        slot(pbr.metallicRoughnessTexture, "pbrMetallicRoughness/metallicRoughnessTexture");
    m_material.normalTexture = slot(m_source.normalTexture, "normalTexture");
    m_material.occlusionTexture = slot(m_source.occlusionTexture, "occlusionTexture");
    m_material.emissiveTexture = slot(m_source.emissiveTexture, "emissiveTexture");
    m_material.doubleSided = m_source.doubleSided;
  }

  void readAlpha() {
    if (m_source.alphaMode == "OPAQUE" || m_source.alphaMode.empty())
      m_material.alphaMode = AlphaMode::opaque;
    else if (m_source.alphaMode == "MASK")
      m_material.alphaMode = AlphaMode::mask;
    else if (m_source.alphaMode == "BLEND")
      m_material.alphaMode = AlphaMode::blend;
    else
      throw m_document.error(m_place + "/alphaMode", fmt::format("'{}' is not a mode", cleanName(m_source.alphaMode)));
    m_material.alphaCutoff = clamp(m_source.alphaCutoff, 0, kInf, "alphaCutoff");
  }

  const tinygltf::Value* extension(const char* name) const {
    const auto found = m_source.extensions.find(name);
    return found == m_source.extensions.end() ? nullptr : &found->second;
  }

  void readExtensions() {
    m_material.unlit = extension("KHR_materials_unlit") != nullptr;
    if (const tinygltf::Value* value = extension("KHR_materials_emissive_strength");
        value && value->Has("emissiveStrength"))
      m_material.emissive *= clamp(value->Get("emissiveStrength").GetNumberAsDouble(), 0, kInf, "emissiveStrength");
    if (const tinygltf::Value* value = extension("KHR_materials_ior"); value && value->Has("ior")) {
      const double ior = value->Get("ior").GetNumberAsDouble();
      m_material.ior = ior == 0 ? 0 : clamp(ior, 1, kInf, "ior"); // 0 is defined: it reflects all
    }
    if (const tinygltf::Value* value = extension("KHR_materials_specular")) readSpecular(*value);
    if (const tinygltf::Value* value = extension("KHR_materials_clearcoat")) readCoat(*value);
    if (const tinygltf::Value* value = extension("KHR_materials_sheen")) readSheen(*value);
    if (const tinygltf::Value* value = extension("KHR_materials_anisotropy")) readAnisotropy(*value);
    if (const tinygltf::Value* value = extension("KHR_materials_iridescence")) readIridescence(*value);
    if (const tinygltf::Value* value = extension("KHR_materials_transmission")) readTransmission(*value);
    if (const tinygltf::Value* value = extension("KHR_materials_diffuse_transmission")) readDiffuseTransmission(*value);
    if (const tinygltf::Value* value = extension("KHR_materials_volume")) readVolume(*value);
    if (const tinygltf::Value* value = extension("KHR_materials_dispersion"))
      readNumber(*value, "dispersion", 0, kMostDispersion, m_material.dispersion);
    constexpr const char* kGlossiness = "KHR_materials_pbrSpecularGlossiness"; // goes before metallic-roughness
    if (const tinygltf::Value* value = extension(kGlossiness))
      readSpecularGlossiness(m_document, *value, fmt::format("{}/extensions/{}", m_place, kGlossiness), m_material,
                             m_derived, m_warnings);
    for (const auto& [name, value] : m_source.extensions)
      if (const std::string_view what = notModelledName(name); !what.empty()) addNotModelled(std::string(what));
    // The product of a factor and its strength may leave the range of floats though both lie within.
    for (int i = 0; i < 3; ++i) m_material.emissive[i] = std::min(m_material.emissive[i], 3.4e38f);
  }

  // Of an extension: what it does not say stays at its default.
  void readNumber(const tinygltf::Value& value, const char* key, float lower, float upper, float& number) {
    if (value.Has(key)) number = clamp(value.Get(key).GetNumberAsDouble(), lower, upper, key);
  }
  void readFactor(const tinygltf::Value& value, const char* key, float& factor) {
    readNumber(value, key, 0, 1, factor);
  }
  void readColor(const tinygltf::Value& value, const char* key, float upper, glm::vec3& color) {
    if (!value.Has(key)) return;
    for (int i = 0; i < 3; ++i) color[i] = clamp(value.Get(key).Get(i).GetNumberAsDouble(), 0, upper, key);
  }
  void readTexture(const tinygltf::Value& value, const char* key, const char* extension, TextureSlot& slot) {
    if (value.Has(key))
      slot = readTextureSlot(m_document, value.Get(key), fmt::format("{}/extensions/{}/{}", m_place, extension, key));
  }

  void readSpecular(const tinygltf::Value& value) {
    constexpr const char* kName = "KHR_materials_specular";
    readFactor(value, "specularFactor", m_material.specular);
    readColor(value, "specularColorFactor", kInf, m_material.specularColor);
    readTexture(value, "specularTexture", kName, m_material.specularTexture);
    readTexture(value, "specularColorTexture", kName, m_material.specularColorTexture);
  }

  void readCoat(const tinygltf::Value& value) {
    constexpr const char *kName = "KHR_materials_clearcoat", *kNormal = "clearcoatNormalTexture";
    readFactor(value, "clearcoatFactor", m_material.coat);
    readFactor(value, "clearcoatRoughnessFactor", m_material.coatRoughness);
    readTexture(value, "clearcoatTexture", kName, m_material.coatTexture);
    readTexture(value, "clearcoatRoughnessTexture", kName, m_material.coatRoughnessTexture);
    readTexture(value, kNormal, kName, m_material.coatNormalTexture);
    if (value.Has(kNormal) && value.Get(kNormal).Has("scale"))
      m_material.coatNormalScale = static_cast<float>(value.Get(kNormal).Get("scale").GetNumberAsDouble());
  }

  void readSheen(const tinygltf::Value& value) {
    constexpr const char* kName = "KHR_materials_sheen";
    readColor(value, "sheenColorFactor", 1, m_material.sheenColor);
    readFactor(value, "sheenRoughnessFactor", m_material.sheenRoughness);
    readTexture(value, "sheenColorTexture", kName, m_material.sheenColorTexture);
    readTexture(value, "sheenRoughnessTexture", kName, m_material.sheenRoughnessTexture);
  }

  void readAnisotropy(const tinygltf::Value& value) {
    readFactor(value, "anisotropyStrength", m_material.anisotropy);
    if (value.Has("anisotropyRotation")) {
      constexpr double kTurn = 2 * std::numbers::pi;
      const double rotation = value.Get("anisotropyRotation").GetNumberAsDouble();
      m_material.anisotropyRotation = // a float of many turns has no digits left for the angle
          static_cast<float>(std::abs(rotation) <= kTurn ? rotation : std::remainder(rotation, kTurn));
    }
    readTexture(value, "anisotropyTexture", "KHR_materials_anisotropy", m_material.anisotropyTexture);
  }

  // The least thickness may be above the greatest: the texture then works the other way.
  void readIridescence(const tinygltf::Value& value) {
    constexpr const char* kName = "KHR_materials_iridescence";
    readFactor(value, "iridescenceFactor", m_material.iridescence);
    readNumber(value, "iridescenceIor", 1, kMostFilmIor, m_material.iridescenceIor);
    readNumber(value, "iridescenceThicknessMinimum", 0, kMostFilmNm, m_material.iridescenceThicknessMin);
    readNumber(value, "iridescenceThicknessMaximum", 0, kMostFilmNm, m_material.iridescenceThicknessMax);
    readTexture(value, "iridescenceTexture", kName, m_material.iridescenceTexture);
    readTexture(value, "iridescenceThicknessTexture", kName, m_material.iridescenceThicknessTexture);
  }

  void readTransmission(const tinygltf::Value& value) {
    readFactor(value, "transmissionFactor", m_material.transmission);
    readTexture(value, "transmissionTexture", "KHR_materials_transmission", m_material.transmissionTexture);
  }

  void readDiffuseTransmission(const tinygltf::Value& value) {
    constexpr const char* kName = "KHR_materials_diffuse_transmission";
    readFactor(value, "diffuseTransmissionFactor", m_material.diffuseTransmission);
    readColor(value, "diffuseTransmissionColorFactor", 1, m_material.diffuseTransmissionColor);
    readTexture(value, "diffuseTransmissionTexture", kName, m_material.diffuseTransmissionTexture);
    readTexture(value, "diffuseTransmissionColorTexture", kName, m_material.diffuseTransmissionColorTexture);
  }

  void readVolume(const tinygltf::Value& value) {
    constexpr const char* kDistance = "attenuationDistance";
    readNumber(value, "thicknessFactor", 0, kMostLength, m_material.thickness);
    readNumber(value, kDistance, 0, kMostLength, m_material.attenuationDistance);
    // Not allowed, and what stands for infinity here.
    if (value.Has(kDistance) && static_cast<float>(value.Get(kDistance).GetNumberAsDouble()) == 0)
      m_warnings.push_back(fmt::format("{}: {} of 0 is out of range, nothing is absorbed", m_place, kDistance));
    readColor(value, "attenuationColor", 1, m_material.attenuationColor);
    readTexture(value, "thicknessTexture", "KHR_materials_volume", m_material.thicknessTexture);
  }

  // A mesh has two uv sets; a material that reads others has them put in their place.
  UvSets chooseUvSets() {
    std::vector<int> sets;
    for (const NamedSlot& each : kTextureSlots)
      if (const TextureSlot& slot = m_material.*each.slot;
          slot.present() && std::find(sets.begin(), sets.end(), slot.texCoord) == sets.end())
        sets.push_back(slot.texCoord);
    const auto isRead = [&](int set) { return std::find(sets.begin(), sets.end(), set) != sets.end(); };
    if (takesFirstSet() && sets.size() == 1 && !isRead(0)) sets.push_back(0);
    std::sort(sets.begin(), sets.end());
    if (sets.empty() || sets.back() <= 1) return {};
    const UvSets chosen{sets[0], sets.size() > 1 ? sets[1] : sets[0]};
    for (const NamedSlot& each : kTextureSlots) {
      TextureSlot& slot = m_material.*each.slot;
      if (!slot.present()) continue;
      if (slot.texCoord == chosen.first)
        slot.texCoord = 0;
      else if (slot.texCoord == chosen.second)
        slot.texCoord = 1;
      else {
        addNotModelled(
            fmt::format("a texture uses TEXCOORD_{}, a third uv set; at most two are supported", slot.texCoord));
        slot = {};
      }
    }
    return chosen;
  }

  // Whether the tangents follow TEXCOORD_0 because no texture says another set.
  bool takesFirstSet() const {
    return m_material.hasAnisotropy() && !frameSlot() && !m_material.anisotropyTexture.present();
  }
  // The normal map whose tangents a mesh has; null without any.
  const TextureSlot* frameSlot() const {
    if (m_material.normalTexture.present()) return &m_material.normalTexture;
    return m_material.coatNormalTexture.present() ? &m_material.coatNormalTexture : nullptr;
  }

  // A mesh has one tangent at a vertex: of the base's normal map, else of the coat's, else of the anisotropy.
  void checkFrames(const UvSets& sets) {
    const TextureSlot &base = m_material.normalTexture, &coat = m_material.coatNormalTexture,
                      &anisotropy = m_material.anisotropyTexture;
    const auto numberOf = [&](const TextureSlot& slot) { return slot.texCoord == 0 ? sets.first : sets.second; };
    if (base.present() && coat.present() && base.texCoord != coat.texCoord)
      m_warnings.push_back(fmt::format("{}: the normal map of the coat uses TEXCOORD_{}, that of the base TEXCOORD_{}; "
                                       "both take their tangents from the base's, so the coat's bumps may be turned",
                                       m_place, numberOf(coat), numberOf(base)));
    const TextureSlot* frame = frameSlot();
    if (frame && anisotropy.present() && frame->texCoord != anisotropy.texCoord)
      m_warnings.push_back(fmt::format("{}: the anisotropyTexture uses TEXCOORD_{}, the normal map{} TEXCOORD_{}; both "
                                       "take their tangents from the normal map's, so the anisotropy may be turned",
                                       m_place, numberOf(anisotropy), frame == &coat ? " of the coat" : "",
                                       numberOf(*frame)));
    if (takesFirstSet() && sets.first != 0)
      m_warnings.push_back(
          fmt::format("{}: the textures use TEXCOORD_{} and TEXCOORD_{}, and more than two sets are not "
                      "supported; the tangents follow TEXCOORD_{} instead of TEXCOORD_0, so the "
                      "anisotropy may be turned",
                      m_place, sets.first, sets.second, sets.first));
  }

  void addNotModelled(std::string what) {
    std::vector<std::string>& list = m_material.notModelled;
    if (std::find(list.begin(), list.end(), what) == list.end()) list.push_back(std::move(what));
  }

  // Work follows need (docs/design.md 7a): no texture is decoded, bound or read that cannot change the colour.
  void dropIdleTextures() {
    if (m_material.emissive == glm::vec3(0)) m_material.emissiveTexture = {};
    if (m_material.occlusionStrength == 0) m_material.occlusionTexture = {};
    const bool neverDielectric = m_material.metallic == 1 && !m_material.metallicRoughnessTexture.present();
    if (m_material.specular == 0 || neverDielectric) m_material.specularTexture = m_material.specularColorTexture = {};
    if (!m_material.hasCoat())
      m_material.coatTexture = m_material.coatRoughnessTexture = m_material.coatNormalTexture = {};
    if (m_material.coatRoughness == 0) m_material.coatRoughnessTexture = {};
    if (!m_material.hasSheen()) m_material.sheenColorTexture = m_material.sheenRoughnessTexture = {};
    if (m_material.sheenRoughness == 0) m_material.sheenRoughnessTexture = {};
    if (!m_material.hasAnisotropy()) m_material.anisotropyTexture = {};
    if (!m_material.hasIridescence()) m_material.iridescenceTexture = m_material.iridescenceThicknessTexture = {};
    if (m_material.iridescenceThicknessMin == m_material.iridescenceThicknessMax)
      m_material.iridescenceThicknessTexture = {};
    if (!m_material.hasTransmission()) m_material.transmissionTexture = {};
    if (!m_material.hasDiffuseTransmission())
      m_material.diffuseTransmissionTexture = m_material.diffuseTransmissionColorTexture = {};
    if (m_material.diffuseTransmissionColor == glm::vec3(0)) m_material.diffuseTransmissionColorTexture = {};
    if (!m_material.hasVolume()) m_material.thicknessTexture = {};
    if (!m_material.unlit) return;
    for (const NamedSlot& each : kTextureSlots)
      if (each.slot != &Material::baseColorTexture) m_material.*each.slot = {};
  }

  const GltfDocument& m_document;
  const tinygltf::Material& m_source;
  std::string m_place;
  DerivedImages& m_derived;
  std::vector<std::string>& m_warnings;
  Material m_material;
};

} // namespace

GltfMaterials readMaterials(const GltfDocument& document, bool needsDefault, Problems& problems,
                            std::vector<std::string>& warnings) {
  GltfMaterials result;
  UniqueNames names;
  for (std::size_t i = 0; i < document.model.materials.size(); ++i) {
    const std::string name = names.make(document.model.materials[i].name, fmt::format("material {}", i));
    Material& material = result.materials.emplace_back();
    UvSets& sets = result.uvSets.emplace_back();
    problems.attempt([&] { material = MaterialReader(document, i, result.derived, warnings).read(name, sets); });
    if (!material.notModelled.empty())
      warnings.push_back(fmt::format("material '{}': not modelled: {}", name, fmt::join(material.notModelled, ", ")));
  }
  if (needsDefault) {
    result.materials.emplace_back(); // glTF 2.0, 3.9.1: all properties at their defaults
    result.materials.back().name = names.make("default material", {});
    result.uvSets.emplace_back();
  }
  return result;
}

} // namespace parity::scenes
