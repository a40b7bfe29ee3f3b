// The environment BRDF of the high-end path: split-sum A,B over (NoV, roughness) by deterministic quadrature.
#pragma once

#include "base/image.h"

namespace parity::highend {

// Geometry term of the specular lobe (SHADING.md 1).
enum class GeometryTerm { heightCorrelated, schlickSmith };

// A size x size image of 2 channels (A, B), F0*A + B (Karis 2013): x -> NoV, y -> roughness, both at texel centres
// ((i + 0.5) / size). Reads at other values are bilinear with clamped edges. Converged quadrature of each texel: rms
// error after bilinear reading <= 2e-4 over NoV, roughness >= 0.05. Bit-identical for any number of threads.
base::Image makeEnvBrdfLut(GeometryTerm term, int size = 128);

} // namespace parity::highend
