// The lobe of light that a rough surface of glass refracts: directions, values and densities.
#pragma once

#include <optional>

#include <glm/glm.hpp>

namespace parity::reference {

// What a direction adds per unit of radiance and steradian, and with what density it is drawn.
struct RefractedValues {
  double value = 0, pdf = 0;
};

// Microfacets of GGX, each of which refracts by Snell's law and reflects by Fresnel's. Directions are unit and local:
// +Z is the normal on the side of the view, and light comes from below. For a view i, light o and eta = the index on
// the light's side over that on the view's, the microfacet between them is h = +-(i + eta o), normalised (Walter et al.
// 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 16), and a density of visible normals D_i(h)
// (Heitz 2018, eq. 2) gives directions the density
//   p(o) = D_i(h) eta^2 |o.h| / (i.h + eta o.h)^2                                   (eq. 17)
// The lobe's value is (1 - F(i.h)) p(o), which is eq. 21's f_t |o.n| but for two things. Light is not masked on its
// way out: what one microfacet hides, another one passes on, so that nothing is lost. And radiance does not grow by
// eta^2, as light that enters a body also leaves it. A direction that would stay above the surface is mirrored at it,
//   value(o) = value_s(o) + value_s(o'),  o' = o mirrored at the surface.
// So the integral of value is the mean of 1 - F over visible normals, and with the mean of F, which is reflected, it is
// 1.
class RefractedLobe {
public:
  // alpha in [0, 1], eta above 0.
  RefractedLobe(double alpha, double eta);

  // A microfacet's normal for u in (0, 1)^2, by the view's visible normals; the surface's own of a mirror.
  glm::dvec3 sampleHalf(const glm::dvec3& view, const glm::dvec2& u) const;
  // The direction of light that the microfacet refracts to the view, below the surface; nothing where it reflects
  // totally.
  std::optional<glm::dvec3> refract(const glm::dvec3& view, const glm::dvec3& half) const;
  // The same of light that it reflects, above the surface.
  static glm::dvec3 reflect(const glm::dvec3& view, const glm::dvec3& half);
  // The share that a microfacet reflects, [0, 1]; VoH in [0, 1].
  double fresnel(double VoH) const;

  // Of the density of refract(sampleHalf()); light.z < 0. Where hasDensity().
  RefractedValues evaluate(const glm::dvec3& view, const glm::dvec3& light) const;
  // Not of a mirror, nor of an index so near to 1 that light goes straight on.
  bool hasDensity() const { return m_hasDensity; }
  bool isMirror() const { return m_isMirror; }

private:
  RefractedValues single(const glm::dvec3& view, const glm::dvec3& light) const;

  double m_alpha, m_eta;
  bool m_isMirror, m_hasDensity;
};

// Fresnel's reflectance of a dielectric for unpolarised light (Walter et al. 2007, eq. 22): eta as above, 1 beyond the
// critical angle. VoH in [0, 1].
double dielectricReflectance(double eta, double VoH);

} // namespace parity::reference
