// Fresnel's reflectance by the curve that a model names.
#pragma once

#include "shading/shading.h"
#include "shading/surface_model.h"

namespace parity::reference {

// The weight of F90 at VoH in [0, 1] (shading/brdf.glsl).
inline double fresnelWeight(shading::FresnelCurve curve, double VoH) {
  switch (curve) {
  case shading::FresnelCurve::sphericalGaussian:
    return shading::f64::sphericalGaussianWeight(VoH);
  case shading::FresnelCurve::dielectric:
    return shading::f64::dielectricWeight(VoH);
  default:
    return shading::f64::schlickWeight(VoH);
  }
}

// Its cosine-weighted mean over the hemisphere.
inline double fresnelMean(shading::FresnelCurve curve) {
  switch (curve) {
  case shading::FresnelCurve::sphericalGaussian:
    return shading::f64::sphericalGaussianMean();
  case shading::FresnelCurve::dielectric:
    return shading::f64::dielectricMean();
  default:
    return shading::f64::schlickMean();
  }
}

} // namespace parity::reference
