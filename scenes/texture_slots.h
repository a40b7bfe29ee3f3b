// The texture slots of a material as a table: who lists them takes them from here.
#pragma once

#include <array>
#include <optional>

#include "scenes/scene.h"

namespace parity::scenes {

struct NamedSlot {
  const char* name; // for people
  const char* key;  // glTF's
  TextureSlot Material::*slot;
};

inline constexpr std::array<NamedSlot, 19> kTextureSlots = {
    {{"base color", "baseColorTexture", &Material::baseColorTexture},
     {"metallic-roughness", "metallicRoughnessTexture", &Material::metallicRoughnessTexture},
     {"normal", "normalTexture", &Material::normalTexture},
     {"occlusion", "occlusionTexture", &Material::occlusionTexture},
     {"emissive", "emissiveTexture", &Material::emissiveTexture},
     {"specular", "specularTexture", &Material::specularTexture},
     {"specular color", "specularColorTexture", &Material::specularColorTexture},
     {"coat", "clearcoatTexture", &Material::coatTexture},
     {"coat roughness", "clearcoatRoughnessTexture", &Material::coatRoughnessTexture},
     {"coat normal", "clearcoatNormalTexture", &Material::coatNormalTexture},
     {"sheen color", "sheenColorTexture", &Material::sheenColorTexture},
     {"sheen roughness", "sheenRoughnessTexture", &Material::sheenRoughnessTexture},
     {"anisotropy", "anisotropyTexture", &Material::anisotropyTexture},
     {"iridescence", "iridescenceTexture", &Material::iridescenceTexture},
     {"iridescence thickness", "iridescenceThicknessTexture", &Material::iridescenceThicknessTexture},
     {"transmission", "transmissionTexture", &Material::transmissionTexture},
     {"thickness", "thicknessTexture", &Material::thicknessTexture},
     {"diffuse transmission", "diffuseTransmissionTexture", &Material::diffuseTransmissionTexture},
     {"diffuse transmission color", "diffuseTransmissionColorTexture", &Material::diffuseTransmissionColorTexture}}};

// The uv set (0: Mesh::uv0, 1: Mesh::uv1) that a mesh's tangents follow: that of the normal map, else of the coat's,
// else of the anisotropy texture; the first for an anisotropy without any of these. None: the material needs no
// tangents.
inline std::optional<int> tangentSetOf(const Material& material) {
  for (const TextureSlot* slot : {&material.normalTexture, &material.coatNormalTexture, &material.anisotropyTexture})
    if (slot->present()) return slot->texCoord;
  return material.hasAnisotropy() ? std::optional(0) : std::nullopt;
}

} // namespace parity::scenes
