#include "reference/refracted_lobe.h"

#include <algorithm>
#include <cmath>

#include "reference/lobes.h"
#include "reference/sampling.h"
#include "shading/shading.h"

namespace parity::reference {

namespace f64 = shading::f64;

namespace {

// Below, the half vector has no digits: it is the difference of two directions that are all but opposite.
constexpr double kLeastDensity = 1e-6;

} // namespace

double dielectricReflectance(double eta, double VoH) {
  const double g2 = f64::sqr(eta) - 1 + f64::sqr(VoH);
  if (!(g2 > 0)) return 1;
  const double g = std::sqrt(g2), c = VoH;
  if (!(g + c > 0)) return 1;
  const double ratio = (c * (g + c) - 1) / (c * (g - c) + 1);
  return std::min(0.5 * f64::sqr((g - c) / (g + c)) * (1 + f64::sqr(ratio)), 1.0);
}

RefractedLobe::RefractedLobe(double alpha, double eta)
    : m_alpha(alpha), m_eta(eta), m_isMirror(alpha <= Lobes::kMirrorAlpha),
      m_hasDensity(!m_isMirror && alpha * std::abs(eta - 1) > kLeastDensity) {}

double RefractedLobe::fresnel(double VoH) const { return dielectricReflectance(m_eta, VoH); }

glm::dvec3 RefractedLobe::sampleHalf(const glm::dvec3& view, const glm::dvec2& u) const {
  return m_isMirror ? glm::dvec3(0, 0, 1) : sampleVisibleNormal(m_alpha, view, u);
}

std::optional<glm::dvec3> RefractedLobe::refract(const glm::dvec3& view, const glm::dvec3& half) const {
  const double c = glm::dot(view, half), cos2 = 1 - (1 - f64::sqr(c)) / f64::sqr(m_eta); // of the refracted angle
  if (!(cos2 > 0)) return std::nullopt;
  glm::dvec3 light = glm::normalize(-view / m_eta + (c / m_eta - std::sqrt(cos2)) * half);
  if (light.z > 0) light.z = -light.z;
  return light;
}

glm::dvec3 RefractedLobe::reflect(const glm::dvec3& view, const glm::dvec3& half) {
  glm::dvec3 light = glm::normalize(2 * glm::dot(view, half) * half - view);
  if (light.z < 0) light.z = -light.z;
  return light;
}

RefractedValues RefractedLobe::single(const glm::dvec3& view, const glm::dvec3& light) const {
  glm::dvec3 h = glm::normalize(view + m_eta * light);
  if (h.z < 0) h = -h;
  const double VoH = glm::dot(view, h), LoH = glm::dot(light, h);
  if (!(VoH > 0 && LoH < 0 && h.z > 0)) return {};
  const double D = f64::D_GGX(m_alpha, std::min(h.z, 1.0));
  const double ofVisible = 4 * VoH * pdfVisibleNormal(D, m_alpha, view.z); // D_i(h)
  const double pdf = ofVisible * f64::sqr(m_eta) * -LoH / f64::sqr(VoH + m_eta * LoH);
  return {.value = (1 - fresnel(std::min(VoH, 1.0))) * pdf, .pdf = pdf};
}

RefractedValues RefractedLobe::evaluate(const glm::dvec3& view, const glm::dvec3& light) const {
  if (!(light.z < 0)) return {};
  const RefractedValues through = single(view, light), mirrored = single(view, {light.x, light.y, -light.z});
  return {.value = through.value + mirrored.value, .pdf = through.pdf + mirrored.pdf};
}

} // namespace parity::reference
