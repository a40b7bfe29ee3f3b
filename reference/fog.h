// Fog over a shaded point, evaluated at the point as in the high-end path, in double.
#pragma once

#include "reference/shade.h"
#include "scenes/scene.h"

namespace parity::reference {

// Between the camera's eye (orthographic: its plane) and a place of the world.
struct FogBetween {
  glm::dvec3 inscattered{0.0}; // radiance
  double transmittance = 1;
};
FogBetween fogBetween(const scenes::Fog& fog, const scenes::Camera& camera, const glm::dvec3& place);

// The point seen through it: its terms and its error times the transmittance, the inscattered light as the fog's term.
ShadedSample seenThrough(const FogBetween& fog, ShadedSample point);

} // namespace parity::reference
