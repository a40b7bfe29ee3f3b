// The environment BRDF of the high-end path: split-sum A,B over (NoV, roughness) by deterministic quadrature.
#pragma once

#include "base/image/image.h"
#include "shading/surface_model.h"

namespace parity::highend {

using shading::FresnelCurve;
using shading::GeometryTerm;

// A size x size image of 4 channels: A, B of F0 A + F90 B (Karis 2013), the cosine-weighted mean of A + B at this
// roughness (what Kulla and Conty's compensation takes), and 1. x -> NoV, y -> roughness: texel i stands for i / (size
// - 1), so that 0 and 1 are texels of their own. Reads at other values are bilinear. Converged quadrature of each
// texel: rms error after bilinear reading <= 2e-4 over NoV, roughness >= 0.05, <= 5e-4 over NoV >= 1/256 and roughness
// >= 1/64. Bit-identical for any number of threads.
base::Image makeEnvBrdfLut(GeometryTerm term, FresnelCurve fresnel = FresnelCurve::schlick, int size = 128);

} // namespace parity::highend
