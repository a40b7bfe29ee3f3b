// The scene that an engine renders to be calibrated: unlit marks of known places and values, and a mirror ball under a
// map of six coloured spots. Seen by one camera, square.
#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::external {

inline constexpr int kCalibrationSize = 512; // pixels, each side

// Places are in the picture: x to the right and y up, each from -1 to 1.
struct Mark {
  glm::dvec2 at;
  glm::dvec3 color; // linear
};
// The same in pixels from the picture's middle, y down. size: pixels of a side.
inline glm::dvec2 pixelOf(const glm::dvec2& at, int size) { return glm::dvec2(at.x, -at.y) * (0.5 * size); }
inline constexpr double kMarkRadius = 0.06;
// Discs around the picture. The corners have colours of their own: they tell a turned or mirrored picture.
const std::array<Mark, 8>& marks();

// Patches of grey, from left to right.
inline constexpr std::size_t kRampSteps = 17;
double rampLight(double part); // linear light of a part of the ramp, from 0 at its left to 1: steps that look even
double rampValue(std::size_t step);
glm::dvec2 rampPlace(std::size_t step);
inline constexpr double kRampHalf = 0.04, kRampHalfHeight = 0.065; // of a patch

// A white bar, whose upper edge is slanted: it shows how wide a pixel's filter is.
inline constexpr double kBarAt = -0.62, kBarHalf = 0.35, kBarHalfHeight = 0.07, kBarAngleDeg = 5;

// A mirror in the middle, and the spots of the environment that it shows.
inline constexpr double kBallRadius = 1.3; // metres
struct Spot {
  glm::dvec3 direction, color;
};
inline constexpr double kSpotRadiusDeg = 8;
const std::array<Spot, 6>& spots();

// The camera looks along -Z from there, with that field of view.
inline constexpr double kCameraDistance = 10, kCameraFovDeg = 40;
scenes::Camera calibrationCamera();

scenes::Scene calibrationScene();
// Equirectangular, 2048 x 1024: a spot of one in each axis' direction over black.
scenes::Environment calibrationEnvironment();

} // namespace parity::external
