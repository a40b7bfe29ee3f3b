// What the reference is given of each visible point: resolved values, no textures.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace parity::reference {

// Plain data without padding, so that its bytes can be hashed. Colours are linear Rec.709, lengths metres, world space.
struct SurfaceSample {
  std::uint32_t pixel = 0;                  // seeds the sample points: the same pixel gets the same ones
  std::uint32_t unlit = 0;                  // 1: shows its base colour and nothing else
  glm::vec3 position{0.f};                  //
  glm::vec3 normal{0.f, 0.f, 1.f};          // after normal mapping
  glm::vec3 geometricNormal{0.f, 0.f, 1.f}; // unit, on the side of the eye; read for shadows alone
  glm::vec3 view{0.f, 0.f, 1.f};            // towards the eye
  glm::vec3 baseColor{1.f};                 //
  float metallic = 0;                       // [0, 1]
  float roughness = 0.5f;                   // perceptual, [0, 1]: alpha = roughness^2
  glm::vec3 dielectricF0{0.04f};            // reflectance of the dielectric at normal incidence
  float dielectricF90 = 1;                  // and at grazing incidence (KHR_materials_specular's factor)
  float occlusion = 1;                      // [0, 1]
  glm::vec3 emissive{0.f};                  //
  float coat = 0;                           // [0, 1], share of the surface that the clear coat covers
  float coatRoughness = 0;                  // perceptual
  glm::vec3 coatNormal{0.f, 0.f, 1.f};      // unit
  glm::vec3 sheenColor{0.f};                // [0, 1]
  float sheenRoughness = 0;                 // perceptual
  float anisotropy = 0;                     // [0, 1]: alpha along the tangent is mix(alpha, 1, anisotropy^2)
  glm::vec3 tangent{0.f};                   // unit, perpendicular to the normal; read where anisotropy is above 0
  float iridescence = 0;                    // [0, 1], share of the surface under a thin film
  float filmIor = 1.3f;                     // index of refraction of the film
  float filmThickness = 0;                  // nm
  std::uint32_t instance = 0;               // of the scene; read of volumes alone
  float transmission = 0;                   // [0, 1], share of the light that enters which passes through
  float ior = 1.5f;                         // index of refraction of a volume, at least 1
  float thickness = 0;                      // metres, of a volume; 0: a thin wall
  glm::vec3 absorption{0.f};                // 1 / metre: light keeps exp(-absorption distance) in a volume
  float dispersion = 0;                     // 20 / Abbe number
  float diffuseTransmission = 0;            // [0, 1], share of the diffuse light that passes through
  glm::vec3 diffuseTransmissionColor{1.f};  //
};
static_assert(sizeof(SurfaceSample) == 55 * sizeof(float));

} // namespace parity::reference
