// The layers of a surface: a clear coat over a sheen over the base, and what passes through the base.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reference/lobes.h"
#include "reference/sheen_albedo.h"

namespace parity::reference {

// thinWall and body: light that passes through and keeps its direction, but for refraction and roughness
// (KHR_materials_transmission); diffuseBehind: light from behind that is spread (KHR_materials_diffuse_transmission).
enum class LayerKind { base, sheen, coat, thinWall, body, diffuseBehind };

// One layer as a surface of its own, and how much of its light the eye sees.
struct Layer {
  LayerKind kind = LayerKind::base;
  glm::dvec3 weight{1.0}; // at least 0, and above in one channel
  // Without layers; of a coat: with the coat's normal; of a thin wall and of what is diffuse behind: looked at from
  // behind, mirrored at the surface; of a body: the base, whose Fresnel reflectance light has to pass.
  SurfaceSample sample;
  Model model; // not of a sheen
};

// The tables that layers are weighed by, of the model's geometry term and curve.
struct LayerTables {
  // May be null where there is no coat and no transmission and the model needs none.
  const DirectionalAlbedo* albedo = nullptr;
  const SheenAlbedo* sheenAlbedo = nullptr; // may be null where there is no sheen
};

inline bool hasSheen(const SurfaceSample& sample) {
  return sample.sheenColor.x > 0 || sample.sheenColor.y > 0 || sample.sheenColor.z > 0;
}
// Light of either kind passes through.
inline bool isPassedThrough(const SurfaceSample& sample) {
  return sample.transmission > 0 || sample.diffuseTransmission > 0;
}
inline bool hasLayers(const SurfaceSample& sample) {
  return sample.coat > 0 || hasSheen(sample) || isPassedThrough(sample);
}
// Looked at from behind.
inline bool isFromBehind(LayerKind kind) { return kind == LayerKind::thinWall || kind == LayerKind::diffuseBehind; }

// The layers whose light the eye sees, base first. Weights, with C the coat's share, E an albedo at the view:
//   coat C,  sheen 1 - C Ecoat,  base (1 - C Ecoat) (1 - max(sheenColor) Esheen)
// The order is that of KHR_materials_clearcoat and KHR_materials_sheen; the sheen's weights are the latter's ("Albedo
// scaling technique"). The coat is a GGX lobe with F0 .04 that scatters once. KHR_materials_clearcoat takes Fresnel's
// reflectance at N.V for Ecoat, which is the limit of a smooth coat; with the albedo itself a white furnace stays at 1
// for every roughness (docs/shading.md 10c). As weights depend on the view alone, each layer is integrated by itself.
// With m metallic, T transmission, t diffuse transmission, and D what the base's specular lobe leaves (LobeView), light
// that passes through the base, of weight w, has
//   thin wall or body  w (1 - m) T baseColor D,   diffuse behind  w (1 - m) (1 - T) t color D exp(-absorption
//   thickness)
// and the base's diffuse lobe keeps (1 - T) (1 - t) (Lobes): a white surface loses nothing.
//
// The lobe of a thin wall is that of its reflection mirrored at the surface, as light that is bent on its way in is
// bent back on its way out (Walter et al. 2007 of two parallel surfaces; KHR_materials_transmission's "microfacet
// BTDF"): GGX's reflection at F = 1, seen from behind along the mirrored view, over its albedo E(N.V), so that its
// directions have the weight 1 together. The lobe of diffuse light from behind is Lambert's about -N.
std::vector<Layer> layersOf(const SurfaceSample& sample, const Model& model, const LayerTables& tables);

// The body that does not hide what is behind it from a layer.
inline std::optional<std::uint32_t> passedOverBy(const Layer& layer) {
  const bool isOfBody = layer.kind == LayerKind::diffuseBehind && layer.sample.thickness > 0;
  return isOfBody ? std::optional(layer.sample.instance) : std::nullopt;
}

// Of light that the base emits: 1 - C Ecoat. The sheen does not dim it.
double emissionWeight(const SurfaceSample& sample, const Model& model, const DirectionalAlbedo* albedo);

// The share of light that a whole coat sends out, Ecoat, in [0, 1].
double coatAlbedo(const SurfaceSample& sample, const Model& model, const DirectionalAlbedo* albedo);

// leastRoughness: of GGX, as analytic lights have it.
Lobes lobesOf(const Layer& layer, const DirectionalAlbedo* albedo, double leastRoughness = 0);

} // namespace parity::reference
