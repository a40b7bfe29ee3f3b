// The directional albedo of one point's own specular lobe, where it has too many dimensions for a table.
#pragma once

#include <functional>

#include <glm/glm.hpp>

#include "reference/stretched_lobe.h"

namespace parity::reference {

struct ViewAlbedo {
  double E = 0;              // share of light that leaves after one scattering at F = 1
  glm::dvec3 reflected{0.0}; // the same with the point's Fresnel reflectance
};

// The integral of D V NoL, and of F D V NoL, over light directions: a lattice of Fibonacci's numbers over the view's
// visible normals (Heitz 2018), the cap's height u = y^2 (3 - 2 y) so that the integrand ends in 0 at both ends (Sloan
// and Joe 1994, "Lattice Methods for Multiple Integration"). Of a stretched lobe within 1e-3 of the integral, 2e-4 on
// average; of a round one reflected / E is (tests/reference). fresnel: F at VoH. view: as StretchedLobe has it, view.z
// > 0.
ViewAlbedo integrateView(const StretchedLobe& lobe, const glm::dvec3& view,
                         const std::function<glm::dvec3(double VoH)>& fresnel);

} // namespace parity::reference
