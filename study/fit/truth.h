// What is fitted to: the directional albedo of the high-end path's specular lobe, by the reference's quadrature.
#pragma once

#include <vector>

#include "reference/directional_albedo.h"
#include "shading/surface_model.h"

namespace parity::fit {

using shading::Compensation;
using shading::FresnelCurve;
using shading::GeometryTerm;

// Of the high-end path; as its defaults.
struct Settings {
  GeometryTerm geometryTerm = GeometryTerm::heightCorrelated;
  FresnelCurve fresnel = FresnelCurve::schlick;
  Compensation compensation = Compensation::kullaConty;
};

// One place of the domain, and the integrals there: F0 A + F90 B scatters once, 1 - A - B is lost at F = 1, and
// lostAverage is that loss averaged over the hemisphere with the cosine.
struct Point {
  double roughness, NoV, A, B, lostAverage;
  double lost() const { return 1 - A - B; }
};

// docs/shading.md 2a's domains: full is NoV in [1/256, 1] and roughness in [1/64, 1], core is both in [0.05, 1].
enum class Domain { full, core };

// The integrals for one high-end path's settings, from a table that is made once, in about 0.4 s on 2 cores.
class Truth {
public:
  explicit Truth(const Settings& settings);
  const Settings& settings() const { return m_settings; }
  // The same, but for the compensation, by the same table.
  Truth with(Compensation compensation) const;

  // The middles of n x n equal cells of the domain, so that a mean over them is one over its area. n >= 1.
  std::vector<Point> pointsOf(Domain domain, int n) const;

  // F0 A + B, at F90 = 1. F0 in [0, 1].
  double single(const Point& p, double F0) const { return F0 * p.A + p.B; }
  // What the compensation adds to it, as shading/brdf.glsl has it. F0 in [0, 1], F90 = 1.
  double multiple(const Point& p, double F0) const;
  double total(const Point& p, double F0) const { return single(p, F0) + multiple(p, F0); }

  // By least squares, the constant g of g + 3/2 (1 - g) NoL, which integrates to 1 with the cosine, in place of Kulla
  // and Conty's (1 - E(NoL)) / (1 - Eavg), weighted with the cosine and the square of what is lost. 1, a Lambertian
  // lobe, for Fdez-Aguera's; 0 where multiple scattering has no lobe of its own.
  double spread() const;

private:
  Settings m_settings;
  reference::DirectionalAlbedo m_albedo;
};

} // namespace parity::fit
