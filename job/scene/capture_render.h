// Environment captures: what the high-end path shows around a point, preconvolved as the environment is.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "job/context.h"
#include "job/scene/prepared_scene.h"
#include "lighting/environment/environment_light.h"
#include "scenes/scene.h"

namespace parity::job {

struct CaptureOptions {
  lighting::PrefilterOptions filter = {.faceSize = 128}; // and the size of the pictures
  int samples = 4;                                       // of the pictures, per pixel, 1..64
};

// The camera whose picture, 1:1 and flipped from left to right, is a face of the cube about `position`: a cube's faces
// are laid out as seen from outside (lighting/environment/cube.h). Planes enclose `bounds`.
scenes::Camera makeFaceCamera(const glm::vec3& position, int face, const scenes::Bounds& bounds);

// One a position, in their order, as it is lit in `prepared` for the high-end path, by its settings but for those of
// the picture. Where the scene is not seen, or seen through, the environment is (times the sky light's colour; suns
// that were extracted from it are lights, and not seen). On a device of their own. Throws base::Error (exit 4) where
// the device fails or the scene shows a radiance that is not finite.
std::vector<lighting::EnvironmentLight>
renderCaptures(const PreparedScene& prepared, std::span<const glm::vec3> positions, const CaptureOptions& options);

} // namespace parity::job
