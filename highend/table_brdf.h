// The environment BRDF of the high-end path: its table, read as its shader reads it, but in double.
#pragma once

#include "base/image/image.h"
#include "highend/options.h"
#include "paths/env_brdf.h"

namespace parity::highend {

class TableBrdf final : public paths::EnvBrdf {
public:
  explicit TableBrdf(const Options& options);

  paths::EnvBrdfWords words() const override;
  AB at(double roughness, double NoV) const override;
  using EnvBrdf::multiple;
  using EnvBrdf::once;
  glm::dvec3 once(const paths::EnvBrdfMaterial& material, double NoV) const override;
  glm::dvec3 multiple(const paths::EnvBrdfMaterial& material, double NoV) const override;

private:
  glm::dvec3 read(double roughness, double NoV) const; // A, B, average of A + B

  Options m_options;
  base::Image m_lut;
};

} // namespace parity::highend
