// The material model of one point: Lambert + GGX with Schlick's Fresnel + what scatters more than once.
#pragma once

#include <optional>

#include "reference/directional_albedo.h"
#include "reference/surface_sample.h"

namespace parity::reference {

// What a direction adds, per unit of radiance and steradian: f cos, and the densities of the ways to sample it.
struct LobeValues {
  glm::dvec3 diffuse{0.0}, specular{0.0};
  double pdfSpecular = 0; // of sampleVisibleNormal
};

// Colour = diffuse + specular, without 1 - F on the diffuse lobe, as the high-end path has it (Unreal Engine 4's base
// pass). Multiple scattering after Kulla and Conty 2017 ("Revisiting Physically Based Shading at Imageworks"):
//   f_ms = Fms (1 - E(NoV)) (1 - E(NoL)) / (pi (1 - Eavg)),  Fms = Favg^2 Eavg / (1 - Favg (1 - Eavg)),
// the latter as Hill 2018 has it ("A Multi-Faceted Exploration", part 3): the bounces after the first, of which Favg
// (1 - Eavg) goes on each time. Favg = F0 + (F90 - F0) / 21, Schlick's cosine-weighted mean. At F0 = 1 nothing is lost.
class Lobes {
public:
  // albedo: null for single scattering.
  Lobes(const SurfaceSample& sample, GeometryTerm term, double roughness, const DirectionalAlbedo* albedo);

  // 1 - E of this cosine: what evaluate() takes, so that a view's is looked up once. 0 for single scattering.
  double lostAt(double mu) const { return m_row ? 1 - m_row->at(mu) : 0; }

  // view, light: unit, in a frame whose +Z is the normal; both cosines positive.
  LobeValues evaluate(const glm::dvec3& view, const glm::dvec3& light, double lostAtView) const;
  // The same from cosines, where half vector and view are not of one frame (closed-form lights).
  LobeValues evaluate(double NoV, double NoL, double NoH, double VoH, double lostAtView) const;

  // Fresnel's reflectance alone.
  glm::dvec3 fresnel(double VoH) const;

  bool hasDiffuse() const { return glm::dot(m_diffuseColor, m_diffuseColor) > 0; }
  bool hasSpecular() const { return m_F90 > 0 || glm::dot(m_F0, m_F0) > 0; }
  // So smooth that it is a mirror and no density can be given.
  bool isMirror() const { return m_alpha <= kMirrorAlpha; }
  double alpha() const { return m_alpha; }

  // Beyond double's digits of 1 - NoH.
  static constexpr double kMirrorAlpha = 1e-6;

private:
  GeometryTerm m_term;
  double m_alpha = 0, m_F90 = 1;
  glm::dvec3 m_diffuseColor{0.0}, m_F0{0.0};
  std::optional<AlbedoRow> m_row;
  glm::dvec3 m_multiple{0.0}; // Fms / (pi (1 - Eavg))
};

} // namespace parity::reference
