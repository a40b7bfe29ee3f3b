#include "reference/lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/sampling.h"
#include "shading/shading.h"

namespace parity::reference {

namespace f64 = shading::f64;

namespace {

f64::real3 toReal3(const glm::vec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 toGlm(const f64::real3& v) { return {v.x, v.y, v.z}; }

} // namespace

Lobes::Lobes(const SurfaceSample& sample, GeometryTerm term, double roughness, const DirectionalAlbedo* albedo)
    : m_term(term), m_alpha(f64::sqr(roughness)),
      m_F90(sample.dielectricF90 * (1.0 - sample.metallic) + sample.metallic),
      m_diffuseColor(toGlm(f64::diffuseColor(toReal3(sample.baseColor), sample.metallic))),
      m_F0(toGlm(f64::specularColor(toReal3(sample.dielectricF0), toReal3(sample.baseColor), sample.metallic))) {
  if (!albedo || isMirror() || !hasSpecular()) return;
  m_row = albedo->row(roughness);
  const double Eavg = m_row->average(), lost = 1 - Eavg;
  if (!(lost > 1e-12)) {
    m_row.reset();
    return;
  }
  const glm::dvec3 Favg = m_F0 + (m_F90 - m_F0) / 21.0;
  m_multiple = Favg * Favg * Eavg / (1.0 - Favg * lost) * std::numbers::inv_pi / lost;
}

glm::dvec3 Lobes::fresnel(double VoH) const {
  const double f = f64::F_Schlick(f64::real3(0, 0, 0), VoH).x;
  return m_F0 * (1 - f) + m_F90 * f;
}

LobeValues Lobes::evaluate(double NoV, double NoL, double NoH, double VoH, double lostAtView) const {
  LobeValues values;
  values.diffuse = m_diffuseColor * (f64::Fd_Lambert() * NoL);
  if (!hasSpecular() || isMirror()) return values;
  const double D = f64::D_GGX(m_alpha, NoH);
  const double V = m_term == GeometryTerm::heightCorrelated ? f64::V_SmithGGXCorrelated(m_alpha, NoV, NoL)
                                                            : f64::V_SchlickSmith(m_alpha, NoV, NoL);
  values.specular = fresnel(VoH) * (D * V * NoL);
  if (m_row) values.specular += m_multiple * (lostAtView * lostAt(NoL) * NoL);
  values.pdfSpecular = pdfVisibleNormal(D, m_alpha, NoV);
  return values;
}

LobeValues Lobes::evaluate(const glm::dvec3& view, const glm::dvec3& light, double lostAtView) const {
  const glm::dvec3 h = glm::normalize(view + light);
  return evaluate(view.z, light.z, std::min(h.z, 1.0), glm::clamp(glm::dot(view, h), 0.0, 1.0), lostAtView);
}

} // namespace parity::reference
