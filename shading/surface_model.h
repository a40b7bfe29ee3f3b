// The choices of the material model that the high-end path and the reference make alike.
#pragma once

namespace parity::shading {

// Geometry term of the specular lobe (SHADING.md 1).
enum class GeometryTerm { heightCorrelated, schlickSmith };

// How Fresnel's reflectance runs from F0 to F90 (shading/brdf.glsl): schlickWeight, sphericalGaussianWeight or
// dielectricWeight.
enum class FresnelCurve { schlick, sphericalGaussian, dielectric };

// What the diffuse lobe gets: what the specular one leaves (albedoScaling), or all the light, as in Unreal Engine 4.
enum class DiffuseLobe { balanced, lambert };

} // namespace parity::shading
