// The environment BRDF of a preset folder: the device's own results on a grid, as only its shader knows the formula.
#pragma once

#include <array>
#include <vector>

#include "gpu/device/device.h"
#include "mobile/options.h"
#include "paths/env_brdf.h"

namespace parity::mobile {

// Linear between 385 x 385 nodes of roughness and N.V, and between F0 = .04 and 1. In the precision of the options.
class SampledBrdf final : public paths::EnvBrdf {
public:
  SampledBrdf(const gpu::Device& device, const Options& options);

  paths::EnvBrdfWords words() const override;
  AB at(double roughness, double NoV) const override;
  using EnvBrdf::multiple;
  using EnvBrdf::once;
  glm::dvec3 once(const paths::EnvBrdfMaterial& material, double NoV) const override;
  glm::dvec3 multiple(const paths::EnvBrdfMaterial&, double) const override { return glm::dvec3(0); }
  std::string form(const paths::EnvBrdfMaterial& material) const override;

private:
  using Nodes = std::vector<glm::dvec3>; // A, B, F0 A + B
  static glm::dvec3 read(const Nodes& nodes, double roughness, double NoV);

  Options m_options;
  bool m_half;
  std::array<Nodes, 2> m_general; // at F0 = .04 and 1
  Nodes m_nonmetal;
};

} // namespace parity::mobile
