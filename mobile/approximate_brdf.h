// The environment BRDF of the mobile path: its preset's formulas in double, with its roughness floor.
#pragma once

#include "mobile/options.h"
#include "paths/env_brdf.h"

namespace parity::mobile {

class ApproximateBrdf final : public paths::EnvBrdf {
public:
  explicit ApproximateBrdf(const Options& options) : m_options(options) {}

  paths::EnvBrdfWords words() const override;
  AB at(double roughness, double NoV) const override;
  using EnvBrdf::multiple;
  using EnvBrdf::once;
  // A fully rough material's .45 F0 leaves as diffuse light.
  glm::dvec3 once(const paths::EnvBrdfMaterial& material, double NoV) const override;
  glm::dvec3 multiple(const paths::EnvBrdfMaterial& material, double NoV) const override;
  std::string form(const paths::EnvBrdfMaterial& material) const override;

private:
  Options m_options;
};

} // namespace parity::mobile
