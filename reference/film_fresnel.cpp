#include "reference/film_fresnel.h"

#include <cmath>

#include "reference/interpolation.h"
#include "shading/shading.h"

namespace parity::reference {

namespace {

constexpr double kMostTabulated = 1500; // nm

double sqr(double x) { return x * x; }

} // namespace

FilmFresnel::FilmFresnel(double ior, double thickness, const glm::dvec3& F0)
    : m_ior(ior), m_thickness(thickness), m_F0(glm::clamp(F0, 0.0, 1.0)),
      m_isTabulated(ior >= 1 && thickness <= kMostTabulated) {
  if (!m_isTabulated) return;
  for (int i = 0; i < kNodes; ++i) m_nodes[static_cast<std::size_t>(i)] = sum(sqr(i / (kNodes - 1.0)));
}

glm::dvec3 FilmFresnel::sum(double VoH) const {
  const shading::f64::real3 F = shading::f64::thinFilmSum(m_ior, m_thickness, {m_F0.x, m_F0.y, m_F0.z}, VoH);
  return {F.x, F.y, F.z};
}

glm::dvec3 FilmFresnel::at(double VoH) const {
  if (!m_isTabulated) return glm::clamp(sum(VoH), 0.0, 1.0);
  const Stencil stencil = makeStencil(std::sqrt(VoH) * (kNodes - 1), kNodes);
  glm::dvec3 F(0);
  for (std::size_t k = 0; k < 4; ++k) F += stencil.weight[k] * m_nodes[static_cast<std::size_t>(stencil.first) + k];
  return glm::clamp(F, 0.0, 1.0);
}

} // namespace parity::reference
