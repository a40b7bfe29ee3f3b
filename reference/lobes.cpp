#include "reference/lobes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "reference/fresnel.h"
#include "reference/sampling.h"
#include "shading/shading.h"

namespace parity::reference {

namespace f64 = shading::f64;

namespace {

f64::real3 toReal3(const glm::vec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 toGlm(const f64::real3& v) { return {v.x, v.y, v.z}; }

} // namespace

Lobes::Lobes(const SurfaceSample& sample, const Model& model, double roughness, const DirectionalAlbedo* albedo)
    : m_model(model), m_alpha(f64::sqr(roughness)),
      m_F90(sample.dielectricF90 * (1.0 - sample.metallic) + sample.metallic),
      m_diffuseColor(toGlm(f64::diffuseColor(toReal3(sample.baseColor), sample.metallic))),
      m_F0(toGlm(f64::specularColor(toReal3(sample.dielectricF0), toReal3(sample.baseColor), sample.metallic))) {
  assert(albedo || !model.needsAlbedo());
  if (!model.needsAlbedo() || isMirror() || !hasSpecular()) return;
  m_row = albedo->row(roughness);
  m_lostOnAverage = 1 - m_row->average();
  if (model.scattering == Scattering::single || !(m_lostOnAverage > 1e-12)) return;
  m_hasMultiple = true;
  const glm::dvec3 Favg = m_F0 + (m_F90 - m_F0) * fresnelMean(model.surface.fresnel);
  m_Fms = Favg * Favg * m_row->average() / (1.0 - Favg * m_lostOnAverage);
}

Lobes::Lobes(const SheenLobe& sheen) : m_alpha(sheen.alpha()), m_F90(0), m_F0(sheen.color()), m_sheen(sheen) {}

LobeView Lobes::viewAt(double NoV) const {
  LobeView view{.lost = lostAt(NoV)};
  if (m_model.surface.diffuse == shading::DiffuseLobe::lambert || !hasSpecular()) return view;
  const double E = m_row ? m_row->at(NoV) : 1;
  const double f = m_row ? m_row->fresnelWeightAt(NoV) : fresnelWeight(m_model.surface.fresnel, NoV);
  const glm::dvec3 reflected = E * (m_F0 + (m_F90 - m_F0) * f) + m_Fms * view.lost;
  view.diffuse = glm::clamp(1.0 - reflected, 0.0, 1.0);
  return view;
}

glm::dvec3 Lobes::fresnel(double VoH) const {
  const double f = fresnelWeight(m_model.surface.fresnel, VoH);
  return m_F0 * (1 - f) + m_F90 * f;
}

LobeValues Lobes::evaluate(double NoV, double NoL, double NoH, double VoH, const LobeView& atView) const {
  LobeValues values;
  if (m_sheen) {
    const double D = m_sheen->distribution(NoH);
    values.specular = m_sheen->color() * m_sheen->reflected(D, NoV, NoL);
    values.pdfSpecular = m_sheen->pdf(D, NoL, NoH, VoH);
    return values;
  }
  values.diffuse = m_diffuseColor * atView.diffuse * (f64::Fd_Lambert() * NoL);
  if (!hasSpecular() || isMirror()) return values;
  const double D = f64::D_GGX(m_alpha, NoH);
  const double V = m_model.surface.geometryTerm == GeometryTerm::heightCorrelated
                       ? f64::V_SmithGGXCorrelated(m_alpha, NoV, NoL)
                       : f64::V_SchlickSmith(m_alpha, NoV, NoL);
  values.specular = fresnel(VoH) * (D * V * NoL);
  if (m_hasMultiple)
    values.specular += m_Fms * (atView.lost * lostAt(NoL) / m_lostOnAverage * std::numbers::inv_pi * NoL);
  values.pdfSpecular = pdfVisibleNormal(D, m_alpha, NoV);
  return values;
}

std::array<Float4, 3> Lobes::estimateSpecular(const FourDirections& light, const glm::vec3& normal,
                                              const glm::vec3& view, const LobeView& atView) const {
  const FourCosines at(normal, view, light);
  const float NoV = glm::dot(normal, view);
  if (m_sheen) {
    const Float4 white = m_sheen->estimate(NoV, at.NoL, at.tan2, Float4{}) * at.NoL;
    const glm::vec3 color(m_sheen->color());
    return {color.x * white, color.y * white, color.z * white};
  }
  const Float4 alpha2 = Float4{} + static_cast<float>(m_alpha * m_alpha), &NoL = at.NoL;
  Float4 f;
  if (m_model.surface.fresnel == FresnelCurve::schlick) {
    f = schlickWeight(at.VoH);
  } else {
    for (int i = 0; i < 4; ++i)
      f[i] = static_cast<float>(fresnelWeight(m_model.surface.fresnel, std::min<double>(at.VoH[i], 1)));
  }
  Float4 V;
  if (m_model.surface.geometryTerm == GeometryTerm::heightCorrelated) {
    V = V_SmithGGXCorrelated(alpha2, NoV, NoL);
  } else {
    const auto k = static_cast<float>(0.5 * m_alpha);
    V = 0.25f / ((NoV * (1 - k) + k) * (NoL * (1 - k) + k));
  }
  const Float4 single = D_GGX(alpha2, at.tan2) * V * NoL;
  Float4 multiple{};
  if (m_hasMultiple)
    multiple = (1 - m_row->near(NoL)) * NoL * static_cast<float>(atView.lost / m_lostOnAverage * std::numbers::inv_pi);
  std::array<Float4, 3> values;
  for (int c = 0; c < 3; ++c) {
    const auto F0 = static_cast<float>(m_F0[c]), F90 = static_cast<float>(m_F90);
    values[static_cast<std::size_t>(c)] = (F0 + (F90 - F0) * f) * single + static_cast<float>(m_Fms[c]) * multiple;
  }
  return values;
}

std::optional<glm::dvec3> Lobes::sampleSpecular(const glm::dvec3& view, const glm::dvec2& u) const {
  if (m_sheen) return m_sheen->sample(view, u);
  const glm::dvec3 h = sampleVisibleNormal(m_alpha, view, u), light = 2 * glm::dot(view, h) * h - view;
  if (!(light.z > 0)) return std::nullopt;
  return light;
}

LobeValues Lobes::evaluate(const glm::dvec3& view, const glm::dvec3& light, const LobeView& atView) const {
  const glm::dvec3 h = glm::normalize(view + light);
  return evaluate(view.z, light.z, std::min(h.z, 1.0), glm::clamp(glm::dot(view, h), 0.0, 1.0), atView);
}

} // namespace parity::reference
