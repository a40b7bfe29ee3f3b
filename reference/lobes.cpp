#include "reference/lobes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "reference/fresnel.h"
#include "reference/interpolation.h"
#include "reference/sampling.h"
#include "reference/view_albedo.h"
#include "shading/shading.h"

namespace parity::reference {

namespace f64 = shading::f64;

namespace {

f64::real3 toReal3(const glm::vec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 toGlm(const f64::real3& v) { return {v.x, v.y, v.z}; }

// Below it the tables that lobes are weighed by have no digits left.
constexpr double kLeastStretchedAlpha = 1e-5;

// 1 - Eavg of the row as it is read, 2 integral (1 - E) mu dmu, so that Kulla and Conty's lobe keeps its light exactly
// where alphaT is far from alphaB. In s as the table has it: dmu/ds = alpha (1 + alpha) / (1 + alpha - s)^2.
double lostOnAverage(const AlbedoRow& row, double alpha) {
  static const QuadratureRule gauss = makeGaussRule(48);
  double lost = 0;
  for (std::size_t k = 0; k < gauss.x.size(); ++k) {
    const double s = gauss.x[k], rest = 1 + alpha - s, mu = s * alpha / rest;
    lost += gauss.weight[k] * 2 * mu * (1 - row.at(mu)) * alpha * (1 + alpha) / (rest * rest);
  }
  return lost;
}

} // namespace

Lobes::Lobes(const SurfaceSample& sample, const Model& model, double roughness, const DirectionalAlbedo* albedo)
    : m_model(model), m_alpha(f64::sqr(roughness)),
      m_F90(sample.dielectricF90 * (1.0 - sample.metallic) + sample.metallic),
      m_diffuseColor(toGlm(f64::diffuseColor(toReal3(sample.baseColor), sample.metallic)) *
                     ((1.0 - sample.transmission) * (1.0 - sample.diffuseTransmission))),
      m_F0(toGlm(f64::specularColor(toReal3(sample.dielectricF0), toReal3(sample.baseColor), sample.metallic))) {
  assert(albedo || !model.needsAlbedo());
  if (sample.iridescence > 0) {
    m_film.emplace(sample.filmIor, sample.filmThickness, m_F0);
    m_filmShare = sample.iridescence;
  }
  if (sample.anisotropy > 0 && m_alpha < 1) {
    // Smooth across the tangent alone it is no mirror: it has a density.
    m_alpha = std::max(m_alpha, kLeastStretchedAlpha);
    m_stretched = {.alphaT = f64::anisotropicAlpha(m_alpha, sample.anisotropy),
                   .alphaB = m_alpha,
                   .term = model.surface.geometryTerm};
  }
  if (!model.needsAlbedo() || isMirror() || !hasSpecular()) return;
  const double round = m_stretched ? f64::projectedAlpha(m_stretched->alphaT, m_stretched->alphaB, 0, 0) : m_alpha;
  m_row = albedo->row(m_stretched ? std::sqrt(round) : roughness);
  m_lostOnAverage = m_stretched ? lostOnAverage(*m_row, round) : 1 - m_row->average();
  if (model.scattering == Scattering::single || !(m_lostOnAverage > 1e-12)) return;
  m_hasMultiple = true;
  const glm::dvec3 Favg = meanFresnel();
  m_Fms = Favg * Favg * (m_stretched ? 1 - m_lostOnAverage : m_row->average()) / (1.0 - Favg * m_lostOnAverage);
}

Lobes::Lobes(const SheenLobe& sheen) : m_alpha(sheen.alpha()), m_F90(0), m_F0(sheen.color()), m_sheen(sheen) {}

LobeView Lobes::viewAt(double NoV) const {
  assert(!m_stretched);
  if (m_film) return viewAt({std::sqrt((1 - NoV) * (1 + NoV)), 0, NoV});
  LobeView view{.lost = lostAt(NoV)};
  if (m_model.surface.diffuse == shading::DiffuseLobe::lambert || !hasSpecular()) return view;
  const double E = m_row ? m_row->at(NoV) : 1;
  const double f = m_row ? m_row->fresnelWeightAt(NoV) : fresnelWeight(m_model.surface.fresnel, NoV);
  const glm::dvec3 reflected = E * (m_F0 + (m_F90 - m_F0) * f) + m_Fms * view.lost;
  view.diffuse = glm::clamp(1.0 - reflected, 0.0, 1.0);
  return view;
}

LobeView Lobes::viewAt(const glm::dvec3& view) const {
  if (!m_stretched && !m_film) return viewAt(view.z);
  LobeView at;
  const bool isBalanced = m_model.surface.diffuse == shading::DiffuseLobe::balanced && hasSpecular();
  if (!isBalanced && !m_hasMultiple) return at;
  if (isMirror()) {
    at.diffuse = 1.0 - fresnel(view.z);
    return at;
  }
  const StretchedLobe round{.alphaT = m_alpha, .alphaB = m_alpha, .term = m_model.surface.geometryTerm};
  const ViewAlbedo own =
      integrateView(m_stretched ? *m_stretched : round, view, [&](double VoH) { return fresnel(VoH); });
  // The table is more exact, where there is one.
  const double E = std::min(m_stretched ? own.E : m_row->at(view.z), 1.0);
  if (m_hasMultiple) at.lost = 1 - E;
  if (isBalanced) at.diffuse = glm::clamp(1.0 - (own.reflected * (E / own.E) + m_Fms * at.lost), 0.0, 1.0);
  return at;
}

glm::dvec3 Lobes::bareFresnel(double VoH) const {
  const double f = fresnelWeight(m_model.surface.fresnel, VoH);
  return m_F0 * (1 - f) + m_F90 * f;
}

glm::dvec3 Lobes::fresnel(double VoH) const {
  const glm::dvec3 bare = bareFresnel(VoH);
  return m_film ? bare * (1 - m_filmShare) + m_film->at(VoH) * m_filmShare : bare;
}

glm::dvec3 Lobes::meanFresnel() const {
  const glm::dvec3 bare = m_F0 + (m_F90 - m_F0) * fresnelMean(m_model.surface.fresnel);
  if (!m_film) return bare;
  static const QuadratureRule cosines = makeGaussRule(32);
  glm::dvec3 film(0);
  for (std::size_t i = 0; i < cosines.x.size(); ++i)
    film += 2 * cosines.weight[i] * cosines.x[i] * m_film->at(cosines.x[i]);
  return bare * (1 - m_filmShare) + film * m_filmShare;
}

LobeValues Lobes::evaluate(double NoV, double NoL, double NoH, double VoH, const LobeView& atView) const {
  assert(!m_stretched);
  LobeValues values;
  if (m_sheen) {
    const double D = m_sheen->distribution(NoH);
    values.specular = m_sheen->color() * m_sheen->reflected(D, NoV, NoL);
    values.pdfSpecular = m_sheen->pdf(D, NoL, NoH, VoH);
    return values;
  }
  const double D = f64::D_GGX(m_alpha, NoH);
  const double V = m_model.surface.geometryTerm == GeometryTerm::heightCorrelated
                       ? f64::V_SmithGGXCorrelated(m_alpha, NoV, NoL)
                       : f64::V_SchlickSmith(m_alpha, NoV, NoL);
  return evaluate(NoL, VoH, D, V, pdfVisibleNormal(D, m_alpha, NoV), atView);
}

LobeValues Lobes::evaluate(double NoL, double VoH, double D, double V, double pdf, const LobeView& atView) const {
  LobeValues values;
  values.diffuse = m_diffuseColor * atView.diffuse * (f64::Fd_Lambert() * NoL);
  if (!hasSpecular() || isMirror()) return values;
  values.specular = fresnel(VoH) * (D * V * NoL);
  if (m_hasMultiple)
    values.specular += m_Fms * (atView.lost * lostAt(NoL) / m_lostOnAverage * std::numbers::inv_pi * NoL);
  values.pdfSpecular = pdf;
  return values;
}

StretchedAxes Lobes::stretchedAxes(const glm::vec3& tangent, const glm::vec3& bitangent) const {
  assert(m_stretched);
  return {tangent, bitangent, static_cast<float>(m_stretched->alphaT), static_cast<float>(m_stretched->alphaB),
          m_stretched->term};
}

std::array<Float4, 3> Lobes::estimateSpecular(const FourDirections& light, const glm::vec3& normal,
                                              const glm::vec3& view, const LobeView& atView,
                                              const std::optional<StretchedAxes>& axes) const {
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
  Float4 single;
  if (m_stretched) {
    assert(axes);
    single = FourStretched(*axes, normal, view, light, at, NoL, Float4{}).value * NoL;
  } else {
    Float4 V;
    if (m_model.surface.geometryTerm == GeometryTerm::heightCorrelated) {
      V = V_SmithGGXCorrelated(alpha2, NoV, NoL);
    } else {
      const auto k = static_cast<float>(0.5 * m_alpha);
      V = 0.25f / ((NoV * (1 - k) + k) * (NoL * (1 - k) + k));
    }
    single = D_GGX(alpha2, at.tan2) * V * NoL;
  }
  Float4 multiple{};
  if (m_hasMultiple)
    multiple = (1 - m_row->near(NoL)) * NoL * static_cast<float>(atView.lost / m_lostOnAverage * std::numbers::inv_pi);
  std::array<Float4, 3> values;
  if (m_film) {
    for (int i = 0; i < 4; ++i) {
      const glm::dvec3 F = fresnel(std::min<double>(at.VoH[i], 1));
      for (int c = 0; c < 3; ++c)
        values[static_cast<std::size_t>(c)][i] =
            static_cast<float>(F[c]) * single[i] + static_cast<float>(m_Fms[c]) * multiple[i];
    }
    return values;
  }
  for (int c = 0; c < 3; ++c) {
    const auto F0 = static_cast<float>(m_F0[c]), F90 = static_cast<float>(m_F90);
    values[static_cast<std::size_t>(c)] = (F0 + (F90 - F0) * f) * single + static_cast<float>(m_Fms[c]) * multiple;
  }
  return values;
}

std::optional<glm::dvec3> Lobes::sampleSpecular(const glm::dvec3& view, const glm::dvec2& u) const {
  if (m_sheen) return m_sheen->sample(view, u);
  const glm::dvec3 h = m_stretched ? m_stretched->sampleHalf(view, u) : sampleVisibleNormal(m_alpha, view, u);
  const glm::dvec3 light = 2 * glm::dot(view, h) * h - view;
  if (!(light.z > 0)) return std::nullopt;
  return light;
}

LobeValues Lobes::evaluate(const glm::dvec3& view, const glm::dvec3& light, const LobeView& atView) const {
  const glm::dvec3 h = glm::normalize(view + light);
  const double VoH = glm::clamp(glm::dot(view, h), 0.0, 1.0);
  if (!m_stretched) return evaluate(view.z, light.z, std::min(h.z, 1.0), VoH, atView);
  const double D = m_stretched->D(h);
  return evaluate(light.z, VoH, D, m_stretched->V(view, light), D * m_stretched->pdfOverD(view), atView);
}

} // namespace parity::reference
