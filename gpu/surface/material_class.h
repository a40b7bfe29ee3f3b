// What of a material its shaders are specialised by.
#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "gpu/shaders/interface.h"
#include "scenes/scene.h"

namespace parity::gpu {

// What of a material asks for code of its own: texture slots (and kNormalVariance, kTextureReads) and features, as
// bits (interface.h).
struct MaterialClass {
  std::uint32_t textures = 0, features = 0;
  auto operator<=>(const MaterialClass&) const = default;
};
MaterialClass classify(const scenes::Material& material);

// The lobes that a material may have beside the base's own, and their names for people.
struct LobeFeature {
  std::uint32_t feature;
  const char* name;
};
inline constexpr std::array<LobeFeature, 6> kLobeFeatures = {{{kFeatureCoat, "clear coat"},
                                                              {kFeatureSheen, "sheen"},
                                                              {kFeatureAnisotropy, "anisotropy"},
                                                              {kFeatureIridescence, "iridescence"},
                                                              {kFeatureTransmission, "transmission"},
                                                              {kFeatureDiffuseTransmission, "diffuse transmission"}}};
// Those that it has, as bits. An unlit material has none.
std::uint32_t lobesOf(const scenes::Material& material);
// Its texture slots in the order of kSlot... of interface.h.
std::array<const scenes::TextureSlot*, kSlotCount> slotsOf(const scenes::Material& material);

// Roughness that grows where a normal map is minified (shading/specular_aa.glsl), alike in every path.
enum class SpecularAa { off, toksvig };

} // namespace parity::gpu
