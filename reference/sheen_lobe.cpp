#include "reference/sheen_lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/sampling.h"
#include "shading/shading.h"

namespace parity::reference {

namespace f64 = shading::f64;

SheenLobe::SheenLobe(const glm::dvec3& color, double sheenRoughness)
    : m_alpha(f64::sheenAlpha(sheenRoughness)), m_color(color) {
  for (std::size_t i = 0; i <= kNodes; ++i) {
    const double root = std::max(static_cast<double>(i) / kNodes, 1e-2), cosine = root * root;
    m_shadowing[i] = static_cast<float>(cosine * f64::charlieLambda(m_alpha, cosine));
  }
}

double SheenLobe::distribution(double NoH) const { return f64::D_Charlie(m_alpha, NoH); }

double SheenLobe::reflected(double D, double NoV, double NoL) const {
  return D > 0 ? D * f64::V_Charlie(m_alpha, NoV, NoL) * NoL : 0;
}

// D NoH = (2 + 1/alpha) sin^(1/alpha) cos / (2 pi): the share within theta is sin(theta)^(2 + 1/alpha).
std::optional<glm::dvec3> SheenLobe::sample(const glm::dvec3& view, const glm::dvec2& u) const {
  if (u.x < 0.5) return sampleCosine({2 * u.x, u.y});
  const double logSine = std::log(2 * u.x - 1) / (2 + 1 / m_alpha), phi = 2 * std::numbers::pi * u.y;
  const double sine = std::exp(logSine), cosine = std::sqrt(-std::expm1(2 * logSine));
  const glm::dvec3 h(sine * std::cos(phi), sine * std::sin(phi), cosine);
  const double VoH = glm::dot(view, h);
  const glm::dvec3 light = 2 * VoH * h - view;
  if (!(VoH > 0 && light.z > 0)) return std::nullopt;
  return light;
}

double SheenLobe::pdf(double D, double NoL, double NoH, double VoH) const {
  constexpr double kLeastVoH = 1e-12; // light opposite to the view, both at the horizon
  return 0.5 * (pdfCosine(NoL) + D * NoH / (4 * std::max(VoH, kLeastVoH)));
}

float SheenLobe::shadowingAt(float cosine) const {
  const float place = std::sqrt(cosine) * static_cast<float>(kNodes);
  const std::size_t node = std::min(static_cast<std::size_t>(place), kNodes - 1);
  return m_shadowing[node] + (place - static_cast<float>(node)) * (m_shadowing[node + 1] - m_shadowing[node]);
}

// sin^(1/alpha) is about a Gaussian exp(-NoH^2 / (2 alpha)), so the spread's square adds to alpha.
Float4 SheenLobe::estimate(float NoV, const Float4& NoL, const Float4& tan2, const Float4& spread) const {
  const float ofView = shadowingAt(std::clamp(NoV, 0.f, 1.f));
  const auto narrow = static_cast<float>(m_alpha);
  constexpr auto kInvTwoPi = static_cast<float>(0.5 * std::numbers::inv_pi);
  Float4 value;
  for (int i = 0; i < 4; ++i) {
    const float invAlpha = 1 / std::min(narrow + 0.25f * spread[i] * spread[i], 1.f);
    const float D = (2 + invAlpha) * kInvTwoPi * std::exp2(0.5f * invAlpha * std::log2(tan2[i] / (1 + tan2[i])));
    const float cosine = std::clamp(NoL[i], 1e-6f, 1.f);
    value[i] = 0.25f * D / (NoV * cosine + cosine * ofView + NoV * shadowingAt(cosine));
  }
  return value;
}

// d log D = cos / (alpha sin); half vectors nearer to the normal than the spread are as steep as at it.
Float4 SheenLobe::steepness(const Float4& tan2, const Float4& spread) const {
  return spread / (static_cast<float>(m_alpha) * lighting::squareRoot(tan2 + spread * spread + 1e-12f));
}

} // namespace parity::reference
