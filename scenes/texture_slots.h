// The texture slots of a material as a table: who lists them takes them from here.
#pragma once

#include <array>

#include "scenes/scene.h"

namespace parity::scenes {

struct NamedSlot {
  const char* name; // for people
  const char* key;  // glTF's
  TextureSlot Material::*slot;
};

inline constexpr std::array<NamedSlot, 15> kTextureSlots = {
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
     {"iridescence thickness", "iridescenceThicknessTexture", &Material::iridescenceThicknessTexture}}};

// The slot whose uv set a mesh's tangents follow: the normal map, or the coat's where the base has none. Null: the
// material needs no tangents.
inline const TextureSlot* tangentSlotOf(const Material& material) {
  if (material.normalTexture.present()) return &material.normalTexture;
  return material.coatNormalTexture.present() ? &material.coatNormalTexture : nullptr;
}

} // namespace parity::scenes
