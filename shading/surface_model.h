// The choices of the material model: of the high-end path and, but for Compensation, of the reference alike.
#pragma once

namespace parity::shading {

// Geometry term of the specular lobe (docs/shading.md 1).
enum class GeometryTerm { heightCorrelated, schlickSmith };

// How Fresnel's reflectance runs from F0 to F90 (shading/brdf.glsl): schlickWeight, sphericalGaussianWeight or
// dielectricWeight.
enum class FresnelCurve { schlick, sphericalGaussian, dielectric };

// What the diffuse lobe gets: what the specular one leaves (albedoScaling), or all the light, as in Unreal Engine 4.
enum class DiffuseLobe { balanced, lambert };

// What returns the light that single scattering loses between microfacets (shading/brdf.glsl).
enum class Compensation {
  none,
  turquin,    // a factor on the specular lobe (Turquin 2019)
  fdezAguera, // a Lambertian lobe (Fdez-Aguera 2019)
  kullaConty, // a lobe of its own, as the reference has it (Kulla and Conty 2017)
};

// What the high-end path and the truth have in common: one is held against the other only where these agree.
struct SurfaceModel {
  GeometryTerm geometryTerm = GeometryTerm::heightCorrelated;
  FresnelCurve fresnel = FresnelCurve::schlick;
  DiffuseLobe diffuse = DiffuseLobe::balanced;
};

} // namespace parity::shading
