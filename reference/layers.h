// The layers of a surface: a clear coat over a sheen over the base.
#pragma once

#include <vector>

#include "reference/lobes.h"
#include "reference/sheen_albedo.h"

namespace parity::reference {

enum class LayerKind { base, sheen, coat };

// One layer as a surface of its own, and how much of its light the eye sees.
struct Layer {
  LayerKind kind = LayerKind::base;
  double weight = 1;    // above 0, at most 1
  SurfaceSample sample; // without layers; of a coat: with the coat's normal
  Model model;          // not of a sheen
};

// The tables that layers are weighed by, of the model's geometry term and curve.
struct LayerTables {
  const DirectionalAlbedo* albedo = nullptr; // may be null where there is no coat and the model needs none
  const SheenAlbedo* sheenAlbedo = nullptr;  // may be null where there is no sheen
};

inline bool hasSheen(const SurfaceSample& sample) {
  return sample.sheenColor.x > 0 || sample.sheenColor.y > 0 || sample.sheenColor.z > 0;
}
inline bool hasLayers(const SurfaceSample& sample) { return sample.coat > 0 || hasSheen(sample); }

// The layers whose light the eye sees, base first. Weights, with C the coat's share, E an albedo at the view:
//   coat C,  sheen 1 - C Ecoat,  base (1 - C Ecoat) (1 - max(sheenColor) Esheen)
// The order is that of KHR_materials_clearcoat and KHR_materials_sheen; the sheen's weights are the latter's ("Albedo
// scaling technique"). The coat is a GGX lobe with F0 .04 that scatters once. KHR_materials_clearcoat takes Fresnel's
// reflectance at N.V for Ecoat, which is the limit of a smooth coat; with the albedo itself a white furnace stays at 1
// for every roughness (docs/shading.md 10c). As weights depend on the view alone, each layer is integrated by itself.
std::vector<Layer> layersOf(const SurfaceSample& sample, const Model& model, const LayerTables& tables);

// Of light that the base emits: 1 - C Ecoat. The sheen does not dim it.
double emissionWeight(const SurfaceSample& sample, const Model& model, const DirectionalAlbedo* albedo);

// The share of light that a whole coat sends out, Ecoat, in [0, 1].
double coatAlbedo(const SurfaceSample& sample, const Model& model, const DirectionalAlbedo* albedo);

// leastRoughness: of GGX, as analytic lights have it.
Lobes lobesOf(const Layer& layer, const DirectionalAlbedo* albedo, double leastRoughness = 0);

} // namespace parity::reference
