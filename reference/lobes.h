// The material model of one point: Lambert + GGX with a Fresnel curve + what scatters more than once.
#pragma once

#include <array>
#include <optional>

#include "reference/directional_albedo.h"
#include "reference/film_fresnel.h"
#include "reference/four_stretched.h"
#include "reference/sheen_lobe.h"
#include "reference/stretched_lobe.h"
#include "reference/surface_sample.h"

namespace parity::reference {

// What a direction adds, per unit of radiance and steradian: f cos, and the densities of the ways to sample it.
struct LobeValues {
  glm::dvec3 diffuse{0.0}, specular{0.0};
  double pdfSpecular = 0; // of sampleSpecular
};

// Whether light that scatters more than once between microfacets is counted (Kulla and Conty 2017).
enum class Scattering { multiple, single };

struct Model {
  shading::SurfaceModel surface;
  Scattering scattering = Scattering::multiple;

  bool needsAlbedo() const {
    return scattering == Scattering::multiple || surface.diffuse == shading::DiffuseLobe::balanced;
  }
};

// What depends on the view alone.
struct LobeView {
  double lost = 0;         // 1 - E(NoV); 0 for single scattering
  glm::dvec3 diffuse{1.0}; // share of the light that the diffuse lobe gets
};

// Colour = diffuse + specular, as the high-end path has it; the diffuse lobe is Lambert's times what the specular one
// leaves at NoV (albedo scaling; Portsmouth, Kutz and Hill 2024, "OpenPBR Surface"), or Lambert's alone. Multiple
// scattering after Kulla and Conty 2017 ("Revisiting Physically Based Shading at Imageworks"):
//   f_ms = Fms (1 - E(NoV)) (1 - E(NoL)) / (pi (1 - Eavg)),  Fms = Favg^2 Eavg / (1 - Favg (1 - Eavg)),
// the latter as Hill 2018 has it ("A Multi-Faceted Exploration", part 3): the bounces after the first, of which Favg
// (1 - Eavg) goes on each time. Favg: the cosine-weighted mean of Fresnel's reflectance. At F0 = 1 nothing is lost.
//
// Under a thin film (iridescence) Fresnel's reflectance is mixed with shading/thin_film.glsl's. An anisotropic point
// has the stretched lobe of shading/anisotropic_brdf.glsl; E(NoV) is its own at the view, E(NoL) and Eavg are those of
// the round lobe that loses about as much (docs/shading.md 11e), so that nothing is lost and nothing jumps at
// anisotropy 0. What no table has of either is summed at the view (reference/view_albedo.h).
class Lobes {
public:
  // albedo: of the model's geometry term and curve; may be null where the model does not need one.
  Lobes(const SurfaceSample& sample, const Model& model, double roughness, const DirectionalAlbedo* albedo);
  // A sheen, which is specular light and nothing else; F0 is its colour.
  explicit Lobes(const SheenLobe& sheen);

  // view: unit, in a frame whose +Z is the normal and, of a stretched lobe, whose +X is the tangent; z positive.
  LobeView viewAt(const glm::dvec3& view) const;
  // The same of a lobe that is not stretched.
  LobeView viewAt(double NoV) const;

  // view, light: unit, in such a frame; both cosines positive.
  LobeValues evaluate(const glm::dvec3& view, const glm::dvec3& light, const LobeView& atView) const;
  // The same from cosines, where half vector and view are not of one frame (closed-form lights). Not of a stretched
  // lobe.
  LobeValues evaluate(double NoV, double NoL, double NoH, double VoH, const LobeView& atView) const;

  // About the specular part of the same, in float, for four directions at once, each channel: within a percent or 1e-4.
  // normal, view: of the directions' frame. axes: of a stretched lobe in that frame.
  std::array<Float4, 3> estimateSpecular(const FourDirections& light, const glm::vec3& normal, const glm::vec3& view,
                                         const LobeView& atView,
                                         const std::optional<StretchedAxes>& axes = std::nullopt) const;
  // Of a stretched lobe.
  StretchedAxes stretchedAxes(const glm::vec3& tangent, const glm::vec3& bitangent) const;

  // A direction of the specular lobe (local) for u in (0, 1)^2, by GGX's visible normals or as SheenLobe has it;
  // nothing below the horizon. Its density is pdfSpecular. Not of a mirror.
  std::optional<glm::dvec3> sampleSpecular(const glm::dvec3& view, const glm::dvec2& u) const;

  // What multiplies the irradiance: of all diffuse light, and of specular light that scatters more than once if that
  // were spread by the cosine.
  glm::dvec3 diffuseReflectance(const LobeView& atView) const { return m_diffuseColor * atView.diffuse; }
  glm::dvec3 multipleReflectance(const LobeView& atView) const { return m_Fms * atView.lost; }

  // Fresnel's reflectance alone, the film's included.
  glm::dvec3 fresnel(double VoH) const;

  bool hasDiffuse() const { return glm::dot(m_diffuseColor, m_diffuseColor) > 0; }
  bool hasSpecular() const { return m_film || m_F90 > 0 || glm::dot(m_F0, m_F0) > 0; }
  // So smooth that it is a mirror and no density can be given.
  bool isMirror() const { return m_alpha <= kMirrorAlpha; }
  bool isStretched() const { return m_stretched.has_value(); }
  bool hasFilm() const { return m_film.has_value(); }
  double alpha() const { return m_alpha; }      // of a stretched lobe: the smaller
  const glm::dvec3& F0() const { return m_F0; } // without film
  double F90() const { return m_F90; }
  const SheenLobe* sheen() const { return m_sheen ? &*m_sheen : nullptr; } // null: GGX

  // Beyond double's digits of 1 - NoH.
  static constexpr double kMirrorAlpha = 1e-6;

private:
  double lostAt(double mu) const { return m_hasMultiple ? 1 - m_row->at(mu) : 0; }
  glm::dvec3 bareFresnel(double VoH) const;
  glm::dvec3 meanFresnel() const;
  LobeValues evaluate(double NoL, double VoH, double D, double V, double pdf, const LobeView& atView) const;

  Model m_model;
  double m_alpha = 0, m_F90 = 1;
  glm::dvec3 m_diffuseColor{0.0}, m_F0{0.0};
  std::optional<AlbedoRow> m_row;
  bool m_hasMultiple = false;
  glm::dvec3 m_Fms{0.0};
  double m_lostOnAverage = 1; // 1 - Eavg
  std::optional<SheenLobe> m_sheen;
  std::optional<StretchedLobe> m_stretched;
  std::optional<FilmFresnel> m_film;
  double m_filmShare = 0;
};

} // namespace parity::reference
