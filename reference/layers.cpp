#include "reference/layers.h"

#include <algorithm>
#include <cassert>

#include "reference/fresnel.h"
#include "reference/reflection.h"
#include "reference/replicates.h"
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
  if (kind == LayerKind::base) return layer;
  layer.anisotropy = layer.transmission = layer.diffuseTransmission = 0; // the base alone has them
  if (kind == LayerKind::body) return layer;
  layer.iridescence = 0;
  if (kind == LayerKind::coat) {
    layer.normal = sample.coatNormal;
    layer.roughness = sample.coatRoughness;
    layer.baseColor = glm::vec3(0);
    layer.metallic = 0;
    layer.dielectricF0 = glm::vec3(kCoatF0);
    layer.dielectricF90 = kCoatF90;
  }
  if (!isFromBehind(kind)) return layer;
  layer.baseColor = glm::vec3(1);
  layer.metallic = kind == LayerKind::thinWall ? 1 : 0;
  layer.dielectricF0 = glm::vec3(0);
  layer.dielectricF90 = 0;
  const glm::dvec3 N = glm::normalize(glm::dvec3(sample.normal)), V = glm::normalize(glm::dvec3(sample.view));
  layer.view = glm::vec3(V - 2 * glm::dot(N, V) * N);
  layer.normal = -sample.normal;
  layer.geometricNormal = -sample.geometricNormal;
  return layer;
}

// Of layers that scatter once.
Model singleModel(const Model& model) {
  return {.surface = {.geometryTerm = model.surface.geometryTerm,
                      .fresnel = model.surface.fresnel,
                      .diffuse = shading::DiffuseLobe::lambert},
          .scattering = Scattering::single};
}

// What the base's specular lobe leaves of light from the view.
glm::dvec3 leftBySpecular(const SurfaceSample& sample, const Model& model, const DirectionalAlbedo* albedo) {
  const Lobes lobes(sample, model, sample.roughness, albedo);
  const glm::dvec3 view = frameOf(sample, lobes).toLocal(glm::normalize(glm::dvec3(sample.view)));
  return lobes.viewAt(visibleView(view)).diffuse;
}

// E(N.V) of the mirrored lobe.
double thinWallAlbedo(const SurfaceSample& sample, const DirectionalAlbedo* albedo) {
  const double roughness = sample.roughness;
  if (roughness * roughness <= Lobes::kMirrorAlpha) return 1;
  assert(albedo);
  return albedo->row(roughness).at(cosineOfView(sample.normal, sample.view));
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
  const auto add = [&](LayerKind kind, const glm::dvec3& weight, const Model& of) {
    if (largest(weight) > 0) layers.push_back({kind, weight, alone(sample, kind), of});
  };
  add(LayerKind::base, glm::dvec3(underSheen), model);
  if (hasSheen(sample)) add(LayerKind::sheen, glm::dvec3(underCoat), model);
  add(LayerKind::coat, glm::dvec3(sample.coat), singleModel(model));
  if (!isPassedThrough(sample) || !(underSheen > 0)) return layers;
  const double metallic = sample.metallic, T = sample.transmission, t = sample.diffuseTransmission;
  const glm::dvec3 entering = underSheen * (1 - metallic) * leftBySpecular(sample, model, tables.albedo);
  const glm::dvec3 straight = entering * T * glm::dvec3(sample.baseColor);
  if (T > 0 && sample.thickness > 0) add(LayerKind::body, straight, model);
  if (T > 0 && !(sample.thickness > 0))
    add(LayerKind::thinWall, straight / thinWallAlbedo(sample, tables.albedo), singleModel(model));
  const glm::dvec3 kept = glm::exp(-glm::dvec3(sample.absorption) * static_cast<double>(sample.thickness));
  add(LayerKind::diffuseBehind, entering * (1 - T) * t * glm::dvec3(sample.diffuseTransmissionColor) * kept,
      singleModel(model));
  return layers;
}

Lobes lobesOf(const Layer& layer, const DirectionalAlbedo* albedo, double leastRoughness) {
  const SurfaceSample& s = layer.sample;
  if (layer.kind == LayerKind::sheen) return Lobes(SheenLobe(s.sheenColor, s.sheenRoughness));
  return {s, layer.model, std::max<double>(s.roughness, leastRoughness), albedo};
}

} // namespace parity::reference
