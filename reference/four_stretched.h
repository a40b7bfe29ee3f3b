// The stretched lobe towards four directions at once, in float: for estimates, as in four_directions.h.
#pragma once

#include <numbers>

#include <glm/glm.hpp>

#include "reference/four_directions.h"
#include "shading/surface_model.h"

namespace parity::reference {

// What an estimate of a stretched lobe needs beside normal and view: axes of the directions' frame, and both alphas.
struct StretchedAxes {
  glm::vec3 tangent{1.f, 0.f, 0.f}, bitangent{0.f, 1.f, 0.f};
  float alphaT = 1, alphaB = 1;
  shading::GeometryTerm term = shading::GeometryTerm::heightCorrelated;
};

// D V towards the directions, and how steep it is there.
class FourStretched {
public:
  // spread: angle that half vectors are off, by which the lobe is widened.
  FourStretched(const StretchedAxes& axes, const glm::vec3& N, const glm::vec3& V, const FourDirections& L,
                const FourCosines& at, const Float4& NoL, const Float4& spread)
      : m_spread(spread), m_alphaT2(widen(axes.alphaT)), m_alphaB2(widen(axes.alphaB)) {
    const Float4 across = lighting::larger(N.x * (V.x + L.x) + N.y * (V.y + L.y) + N.z * (V.z + L.z), Float4{} + 1e-3f);
    const Float4 ToL = along(axes.tangent, L), BoL = along(axes.bitangent, L);
    const float ToV = glm::dot(axes.tangent, V), BoV = glm::dot(axes.bitangent, V), NoV = glm::dot(N, V);
    // The half vector's slopes along both axes.
    const Float4 t = (ToV + ToL) / across, b = (BoV + BoL) / across;
    m_t2 = t * t;
    m_b2 = b * b;
    m_e = 1 + m_t2 / m_alphaT2 + m_b2 / m_alphaB2;
    const Float4 k = (1 + at.tan2) / m_e;
    const Float4 D = k * k * static_cast<float>(std::numbers::inv_pi) / lighting::squareRoot(m_alphaT2 * m_alphaB2);
    const Float4 ofView = m_alphaT2 * ToV * ToV + m_alphaB2 * BoV * BoV,
                 ofLight = m_alphaT2 * ToL * ToL + m_alphaB2 * BoL * BoL;
    if (axes.term == shading::GeometryTerm::heightCorrelated) {
      value =
          D * 0.5f / (NoL * lighting::squareRoot(ofView + NoV * NoV) + NoV * lighting::squareRoot(ofLight + NoL * NoL));
      return;
    }
    const auto halved = [](const Float4& slope2, const Float4& side2) {
      return 0.5f * lighting::squareRoot(slope2 / lighting::larger(side2, Float4{} + 1e-12f));
    };
    const Float4 kV = halved(ofView + 1e-12f * m_alphaT2, Float4{} + (ToV * ToV + BoV * BoV) + 1e-12f),
                 kL = halved(ofLight + 1e-12f * m_alphaT2, ToL * ToL + BoL * BoL + 1e-12f);
    value = D * 0.25f / ((NoV * (1 - kV) + kV) * (NoL * (1 - kL) + kL));
  }

  Float4 value; // D V

  // By how much D changes over the spread, relative to itself: the slope of log D / 4, or the lobe's width across at
  // these slopes where that says nothing.
  Float4 steepness() const {
    const Float4 slope2 = m_t2 / (m_alphaT2 * m_alphaT2) + m_b2 / (m_alphaB2 * m_alphaB2);
    return m_spread * lighting::squareRoot(slope2 + m_e / m_alphaB2) / m_e;
  }

private:
  Float4 widen(float alpha) const {
    return lighting::smaller(alpha * alpha + 0.25f * m_spread * m_spread, Float4{} + 1.f);
  }
  static Float4 along(const glm::vec3& axis, const FourDirections& L) {
    return axis.x * L.x + axis.y * L.y + axis.z * L.z;
  }

  Float4 m_spread, m_alphaT2, m_alphaB2, m_t2{}, m_b2{}, m_e{};
};

} // namespace parity::reference
