// GGX whose roughness along the tangent is another than across it: values, densities and directions.
#pragma once

#include <glm/glm.hpp>

#include "reference/sampling.h"
#include "shading/shading.h"
#include "shading/surface_model.h"

namespace parity::reference {

// Vectors are unit, of a frame whose +X is the tangent and whose +Z is the normal. Both alphas in (0, 1].
struct StretchedLobe {
  double alphaT = 1, alphaB = 1;
  shading::GeometryTerm term = shading::GeometryTerm::heightCorrelated;

  double D(const glm::dvec3& h) const { return shading::f64::D_GGXAnisotropic(alphaT, alphaB, h.x, h.y, h.z); }

  // Heitz 2014's height-correlated term, or Schlick and Smith's by the projected alphas (docs/shading.md 11c).
  double V(const glm::dvec3& view, const glm::dvec3& light) const {
    if (term == shading::GeometryTerm::heightCorrelated)
      return shading::f64::V_SmithGGXAnisotropic(alphaT, alphaB, view.x, view.y, view.z, light.x, light.y, light.z);
    return shading::f64::V_SchlickSmithAnisotropic(projected(view), projected(light), view.z, light.z);
  }

  // A half vector by the visible normals of `view` (view.z > 0), for u in (0, 1)^2.
  glm::dvec3 sampleHalf(const glm::dvec3& view, const glm::dvec2& u) const {
    return sampleVisibleNormal(alphaT, alphaB, view, u);
  }
  // The density, per steradian of light directions, of the view's mirror image in such a half vector is D times this:
  //   G1 / (4 NoV) = 1 / (2 (NoV + length(view)))
  // Heitz 2018, eq. 17, with Heitz 2014's Lambda.
  double pdfOverD(const glm::dvec3& view) const {
    return 0.5 / (view.z + shading::f64::anisotropicLength(alphaT, alphaB, view.x, view.y, view.z));
  }

private:
  double projected(const glm::dvec3& v) const { return shading::f64::projectedAlpha(alphaT, alphaB, v.x, v.y); }
};

} // namespace parity::reference
