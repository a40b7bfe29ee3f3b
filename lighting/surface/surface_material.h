// What a material is at one point of a surface, read on the CPU: textures' base level, no footprint.
#pragma once

#include <glm/glm.hpp>

#include "lighting/surface/surface_point.h"

namespace parity::lighting {

// Factors times textures times vertex colours, linear Rec.709; the slots' images must have their pixels.
glm::dvec3 baseColorAt(const scenes::Scene& scene, const scenes::Mesh& mesh, const TrianglePoint& point);
double metallicAt(const scenes::Scene& scene, const scenes::Mesh& mesh, const TrianglePoint& point);
glm::dvec3 emissiveAt(const scenes::Scene& scene, const scenes::Mesh& mesh, const TrianglePoint& point); // radiance

// All of it, by the rules of gpu/shaders/path.glsl.
struct SurfaceMaterial {
  glm::dvec3 normal{0.0}; // world, unit: after normal mapping
  glm::dvec3 baseColor{0.0};
  double metallic = 0, roughness = 1; // roughness: perceptual, [0, 1]
  glm::dvec3 F0{0.0};                 // of the dielectric
  double F90 = 1;                     // of the dielectric
  double occlusion = 1;
  glm::dvec3 emissive{0.0};
};
// point: of the same hit.
SurfaceMaterial surfaceMaterialAt(const scenes::Scene& scene, const Visibility::Hit& hit, const SurfacePoint& point);

} // namespace parity::lighting
