// The sheen of one point: what it reflects, how its directions are sampled, and about the same in float.
#pragma once

#include <array>
#include <optional>

#include <glm/glm.hpp>

#include "reference/four_directions.h"

namespace parity::reference {

// color D_Charlie V_Charlie NoL (shading/sheen.glsl). Directions are of a frame whose +Z is the normal.
class SheenLobe {
public:
  // color: linear, [0, 1]; sheenRoughness: perceptual, [0, 1].
  SheenLobe(const glm::dvec3& color, double sheenRoughness);

  double alpha() const { return m_alpha; }
  const glm::dvec3& color() const { return m_color; }

  // Per unit of radiance and steradian, of a white sheen; D: D_Charlie(alpha(), NoH). All cosines in [0, 1].
  double distribution(double NoH) const;
  double reflected(double D, double NoV, double NoL) const;

  // Half the directions by the cosine, half by half vectors distributed as D NoH: masking and shadowing fall off about
  // as the cosine, and D is bright where the cosine has few directions. Nothing below the horizon.
  std::optional<glm::dvec3> sample(const glm::dvec3& view, const glm::dvec2& u) const;
  // Its density per steradian.
  double pdf(double D, double NoL, double NoH, double VoH) const;

  // About the same as reflected() over NoL, for four directions at once: within 2 percent. spread: angle that half
  // vectors are off, over which D is widened.
  Float4 estimate(float NoV, const Float4& NoL, const Float4& tan2, const Float4& spread) const;
  // By how much D changes over that angle, relative to itself.
  Float4 steepness(const Float4& tan2, const Float4& spread) const;

private:
  float shadowingAt(float cosine) const;

  static constexpr std::size_t kNodes = 48;
  double m_alpha;
  glm::dvec3 m_color;
  std::array<float, kNodes + 1> m_shadowing; // cosine times Lambda, even in the cosine's root
};

} // namespace parity::reference
