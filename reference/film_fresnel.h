// Fresnel's reflectance of one point under a thin film, tabulated: it is asked thousands of times.
#pragma once

#include <array>

#include <glm/glm.hpp>

namespace parity::reference {

// thinFilmFresnel (shading/thin_film.glsl) of one film and base. Cubic interpolation over the root of VoH, as bright
// bases change within a few degrees of grazing; of the sum before it is cut, so that the cut stays sharp. Within 4e-4
// of the formula (tests/reference). Films that change faster over the angle (thicker than 1500 nm, or of an index below
// 1) are evaluated each time.
class FilmFresnel {
public:
  // ior above 0, thickness in nm, F0: reflectance of the base, cut to [0, 1].
  FilmFresnel(double ior, double thickness, const glm::dvec3& F0);

  // RGB in [0, 1] at VoH in [0, 1].
  glm::dvec3 at(double VoH) const;

private:
  static constexpr int kNodes = 129;
  glm::dvec3 sum(double VoH) const;

  double m_ior, m_thickness;
  glm::dvec3 m_F0;
  bool m_isTabulated;
  std::array<glm::dvec3, kNodes> m_nodes;
};

} // namespace parity::reference
