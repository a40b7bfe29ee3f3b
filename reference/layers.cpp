#include "reference/layers.h"

#include <algorithm>
#include <cassert>

#include "reference/fresnel.h"
#include "reference/reflection.h"
#include "reference/sampling.h"

namespace parity::reference {

namespace {

// Polyurethane, index 1.5 (KHR_materials_clearcoat).
constexpr float kCoatF0 = 0.04f, kCoatF90 = 1;

// The view's cosine, as the integrators take it.
double cosineOfView(const glm::vec3& normal, const glm::vec3& view) {
  return std::clamp(glm::dot(glm::normalize(glm::dvec3(normal)), glm::normalize(glm::dvec3(view))), kMinNoV, 1.0);
}

// Its sample points are independent of the other layers', so that errors add in quadrature.
SurfaceSample alone(const SurfaceSample& sample, LayerKind kind) {
  SurfaceSample layer = sample;
  if (kind != LayerKind::base) layer.pixel = hashCombine(sample.pixel, static_cast<std::uint32_t>(kind));
  layer.emissive = glm::vec3(0);
  if (kind != LayerKind::base) layer.anisotropy = layer.iridescence = 0; // the base alone has them
  if (kind != LayerKind::coat) return layer;
  layer.normal = sample.coatNormal;
  layer.roughness = sample.coatRoughness;
  layer.baseColor = glm::vec3(0);
  layer.metallic = 0;
  layer.dielectricF0 = glm::vec3(kCoatF0);
  layer.dielectricF90 = kCoatF90;
  return layer;
}

Model coatModel(const Model& model) {
  return {.surface = {.geometryTerm = model.surface.geometryTerm,
                      .fresnel = model.surface.fresnel,
                      .diffuse = shading::DiffuseLobe::lambert},
          .scattering = Scattering::single};
}

} // namespace

double coatAlbedo(const SurfaceSample& sample, const Model& model, const DirectionalAlbedo* albedo) {
  const double NoV = cosineOfView(sample.coatNormal, sample.view), roughness = sample.coatRoughness;
  const bool isMirror = roughness * roughness <= Lobes::kMirrorAlpha;
  assert(isMirror || albedo);
  double E = 1, f = 0;
  if (isMirror) {
    f = fresnelWeight(model.surface.fresnel, NoV);
  } else {
    const AlbedoRow row = albedo->row(roughness);
    E = row.at(NoV);
    f = row.fresnelWeightAt(NoV);
  }
  const double F0 = kCoatF0, F90 = kCoatF90;
  return E * (F0 + (F90 - F0) * f);
}

double emissionWeight(const SurfaceSample& sample, const Model& model, const DirectionalAlbedo* albedo) {
  return sample.coat > 0 ? 1 - sample.coat * coatAlbedo(sample, model, albedo) : 1;
}

std::vector<Layer> layersOf(const SurfaceSample& sample, const Model& model, const LayerTables& tables) {
  const double underCoat = emissionWeight(sample, model, tables.albedo);
  double underSheen = underCoat;
  if (hasSheen(sample)) {
    assert(tables.sheenAlbedo);
    const double NoV = cosineOfView(sample.normal, sample.view);
    const double color = std::max({sample.sheenColor.x, sample.sheenColor.y, sample.sheenColor.z});
    underSheen *= std::max(1 - color * tables.sheenAlbedo->shareAt(sample.sheenRoughness, NoV), 0.0);
  }
  std::vector<Layer> layers;
  const auto add = [&](LayerKind kind, double weight, const Model& of) {
    if (weight > 0) layers.push_back({kind, weight, alone(sample, kind), of});
  };
  add(LayerKind::base, underSheen, model);
  if (hasSheen(sample)) add(LayerKind::sheen, underCoat, model);
  add(LayerKind::coat, sample.coat, coatModel(model));
  return layers;
}

Lobes lobesOf(const Layer& layer, const DirectionalAlbedo* albedo, double leastRoughness) {
  const SurfaceSample& s = layer.sample;
  if (layer.kind == LayerKind::sheen) return Lobes(SheenLobe(s.sheenColor, s.sheenRoughness));
  return {s, layer.model, std::max<double>(s.roughness, leastRoughness), albedo};
}

} // namespace parity::reference
