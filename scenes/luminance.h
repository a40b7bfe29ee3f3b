// Luminance of linear light in glm's vectors.
#pragma once

#include <glm/glm.hpp>

#include "shading/shading.h"

namespace parity::scenes {

// As shading/real.glsl has it.
inline double luminanceOf(const glm::dvec3& c) { return shading::f64::luminance(shading::f64::real3(c.x, c.y, c.z)); }
inline float luminanceOf(const glm::vec3& c) { return shading::f32::luminance(shading::f32::real3(c.x, c.y, c.z)); }

} // namespace parity::scenes
