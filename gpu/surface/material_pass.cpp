#include "gpu/surface/material_pass.h"

#include "gpu_shaders/material.comp.h"

namespace parity::gpu {

namespace {

PathProgram makeProgram(std::uint64_t expectedEntries, const Compilation& compilation) {
  PathProgram program;
  program.name = "materials";
  program.spirv = kMaterialComp;
  program.terms = true; // their buffers take the values
  program.expectedPixels = expectedEntries;
  program.compilation = compilation;
  return program;
}

} // namespace

MaterialPass::MaterialPass(const Device& device, const SceneBuffers& scene, const std::vector<BinKind>& binKinds,
                           std::uint64_t expectedEntries, const Compilation& compilation)
    : m_pass(device, scene, binKinds, makeProgram(expectedEntries, compilation)) {}

std::vector<ResolvedMaterial> MaterialPass::resolve(const Surface& surface, const scenes::Camera& camera) const {
  const ShadedSurface planes = m_pass.shade(surface, camera);
  std::vector<ResolvedMaterial> resolved(surface.size());
  for (std::size_t i = 0; i < resolved.size(); ++i) {
    const auto plane = [&](std::uint32_t k) -> const glm::vec4& { return planes.terms[k][i]; };
    ResolvedMaterial& m = resolved[i];
    m.baseColor = glm::vec3(planes.color[i]);
    m.opacity = planes.color[i].w;
    m.position = glm::vec3(plane(kPlanePosition));
    m.unlit = plane(kPlanePosition).w > 0.5f;
    m.normal = glm::vec3(plane(kPlaneNormal));
    m.metallic = plane(kPlaneNormal).w;
    m.view = glm::vec3(plane(kPlaneView));
    m.roughness = plane(kPlaneView).w;
    m.F0 = glm::vec3(plane(kPlaneF0));
    m.F90 = plane(kPlaneF0).w;
    m.emissive = glm::vec3(plane(kPlaneEmissive));
    m.occlusion = plane(kPlaneEmissive).w;
    m.geometricNormal = glm::vec3(plane(kPlaneGeometricNormal));
  }
  return resolved;
}

} // namespace parity::gpu
