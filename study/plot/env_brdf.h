// The environment BRDF of both paths as functions of roughness and N.V: A and B of F0 A + F90 B, and apart from it what
// each adds for light that scatters more than once between microfacets. In double, but for the table's texels.
//
// How the environment is read away from N = V = R (--off-specular, refit's leaning read) is in neither: that changes
// the light that these are multiplied with.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "base/image/image.h"
#include "highend/options.h"
#include "mobile/options.h"
#include "shading/shading.h"

namespace parity::plot {

struct EnvBrdf {
  double A = 0, B = 0;
};

// The high-end path's: its 128 x 128 table, read as its shader reads it.
class TableBrdf {
public:
  explicit TableBrdf(const highend::Options& options);
  // roughness, NoV in [0, 1].
  EnvBrdf at(double roughness, double NoV) const;
  // F0 A + F90 B, and what the compensation adds to it. F0, F90 in [0, 1].
  glm::dvec3 once(double roughness, double NoV, const glm::dvec3& F0, double F90 = 1) const;
  glm::dvec3 multiple(double roughness, double NoV, const glm::dvec3& F0, double F90 = 1) const;
  const highend::Options& options() const { return m_options; }

private:
  glm::dvec3 read(double roughness, double NoV) const; // A, B, average of A + B

  highend::Options m_options;
  base::Image m_lut;
};

// A mobile preset's: its formulas in double, with its roughness floor.
class ApproximateBrdf {
public:
  explicit ApproximateBrdf(const mobile::Options& options) : m_options(options) {}
  // A and B where nothing of B is faded out (F0 of 2 % or more). roughness, NoV in [0, 1].
  EnvBrdf at(double roughness, double NoV) const;
  // Of a metal of that F0: the general form.
  glm::dvec3 once(double roughness, double NoV, const glm::dvec3& F0) const;
  glm::dvec3 multiple(double roughness, double NoV, const glm::dvec3& F0) const;
  // Of a material as the path has it: nonmetals and fully rough ones by their own formulas (a fully rough one's .45 F0
  // leaves as diffuse light).
  glm::dvec3 once(const shading::f64::MobileMaterial& material, bool nonmetal, bool fullyRough, double NoV) const;
  glm::dvec3 multiple(const shading::f64::MobileMaterial& material, bool nonmetal, bool fullyRough, double NoV) const;
  // "EnvBRDFApprox (Karis 2014)" and so on.
  std::string formula() const;
  const mobile::Options& options() const { return m_options; }

private:
  mobile::Options m_options;
};

// Absolute errors of F0 A + B over the middles of 96 x 96 cells of roughness and NoV from .05 to 1.
struct Deviation {
  double max = 0, rms = 0;
};
Deviation deviationOf(const TableBrdf& table, const ApproximateBrdf& approximate, double F0);

} // namespace parity::plot
