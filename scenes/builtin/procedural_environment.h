// Environments made by formula: a clear sky, a photo studio, a moonless night, plain white.
#pragma once

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::scenes {

inline constexpr int kProceduralWidth = 512, kProceduralHeight = 256;

// The unit direction at (u, v) of an equirectangular panorama: u = atan2(z, x) / 2pi + 0.5, v from +Y down.
glm::dvec3 directionAt(double u, double v);

// Options of the clear sky. Angles as SunRequest has them.
struct SkyOptions {
  double turbidity = 3;       // 2 (very clear) to 6 (hazy)
  double sunAzimuthDeg = 120; // from +X towards +Z: front left of a camera on +Z
  double sunElevationDeg = 42;
  double skyIrradiance = 1.2; // of the sky alone on a level surface, luminance-weighted
  double sunIrradiance = 2.2; // of the sun alone on a surface that faces it
  double sunRadiusDeg = 2;    // eight times the real one: a map of this size can hold it
  double groundAlbedo = 0.2;
};

// Sky by Preetham, Shirley and Smits 1999 ("A Practical Analytic Model for Daylight", Perez distribution, appendix A),
// scaled to skyIrradiance; a sun disc with a soft edge; a Lambertian ground lit by both.
Environment makeSky(const SkyOptions& options = {});

// The Perez luminance of the sky relative to the zenith: F(theta, gamma) / F(0, thetaSun), angles from the zenith
// (theta, thetaSun) and from the sun (gamma), radians.
double perezLuminance(double turbidity, double theta, double gamma, double thetaSun);

// Four soft boxes on a dim dome above a dark floor.
Environment makeStudio();

// A dim bluish dome, so that lamps stand out but no shadow is black.
Environment makeNight();

// Radiance 1 from everywhere.
Environment makeWhite();

} // namespace parity::scenes
