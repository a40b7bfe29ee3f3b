// The material values of every entry of a surface, after texturing and normal mapping: for renderers on the CPU.
#pragma once

#include <vector>

#include "gpu/surface/shading_pass.h"

namespace parity::gpu {

// What the paths' shaders begin with (shaders/path.glsl, Point and Resolved): the very same code fills it. Linear
// Rec.709, metres, world space.
struct ResolvedMaterial {
  glm::vec3 position{0.f}, normal{0.f}, view{0.f};  // normal: shading, mapped, unit; view: towards the eye, unit
  glm::vec3 geometricNormal{0.f};                   // unit, on the side of the eye; within 5e-5 radians
  glm::vec3 baseColor{0.f}, F0{0.f}, emissive{0.f}; // F0: of the dielectric
  float opacity = 1, metallic = 0, roughness = 1, F90 = 1, occlusion = 1;
  bool unlit = false;
  float coat = 0, coatRoughness = 0, sheenRoughness = 0;
  glm::vec3 coatNormal{0.f}, sheenColor{0.f};                               // coatNormal: unit
  float anisotropy = 0, iridescence = 0, filmIor = 1.3f, filmThickness = 0; // nm
  glm::vec3 tangent{0.f};                                                   // of the anisotropy, unit
  float transmission = 0, diffuseTransmission = 0;
  glm::vec3 diffuseTransmissionColor{1.f};
  float ior = 1.5f, thickness = 0, dispersion = 0; // of a body; thickness: metres, 0: a thin wall
  glm::vec3 absorption{0.f};                       // of a body, 1 / metre
};

class MaterialPass {
public:
  // expectedEntries: that the run will resolve, for the choice of permutations.
  MaterialPass(const Device& device, const SceneBuffers& scene, const std::vector<BinKind>& binKinds,
               std::uint64_t expectedEntries, const Compilation& compilation = {});

  // In the surface's order.
  std::vector<ResolvedMaterial> resolve(const Surface& surface, const scenes::Camera& camera) const;

private:
  ShadingPass m_pass;
  bool m_hasLobes;
};

} // namespace parity::gpu
