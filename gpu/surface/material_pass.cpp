#include "gpu/surface/material_pass.h"

#include "gpu_shaders/material.comp.h"
#include "gpu_shaders/material_lobes.comp.h"

namespace parity::gpu {

namespace {

PathProgram makeProgram(std::uint64_t expectedEntries, const Compilation& compilation) {
  PathProgram program;
  program.name = "materials";
  program.spirv = kMaterialComp;
  program.spirvOfLobes = kMaterialLobesComp;
  program.terms = true; // their planes take the values
  program.planesOfLobes = kPlaneCount;
  program.expectedPixels = expectedEntries;
  program.compilation = compilation;
  return program;
}

} // namespace

MaterialPass::MaterialPass(const Device& device, const SceneBuffers& scene, const std::vector<BinKind>& binKinds,
                           std::uint64_t expectedEntries, const Compilation& compilation)
    : m_pass(device, scene, binKinds, makeProgram(expectedEntries, compilation)), m_hasLobes(scene.hasLobes()) {}

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
    if (!m_hasLobes) continue; // nothing has written those planes
    m.coatRoughness = plane(kPlaneGeometricNormal).w;
    m.coatNormal = glm::vec3(plane(kPlaneCoatNormal));
    m.coat = plane(kPlaneCoatNormal).w;
    m.sheenColor = glm::vec3(plane(kPlaneSheen));
    m.sheenRoughness = plane(kPlaneSheen).w;
    m.tangent = glm::vec3(plane(kPlaneTangent));
    m.anisotropy = plane(kPlaneTangent).w;
    m.iridescence = plane(kPlaneFilm).x;
    m.filmIor = plane(kPlaneFilm).y;
    m.filmThickness = plane(kPlaneFilm).z;
    m.dispersion = plane(kPlaneFilm).w;
    m.transmission = plane(kPlaneThrough).x;
    m.ior = plane(kPlaneThrough).y;
    m.thickness = plane(kPlaneThrough).z;
    m.diffuseTransmission = plane(kPlaneThrough).w;
    m.absorption = glm::vec3(plane(kPlaneAbsorption));
    m.diffuseTransmissionColor = glm::vec3(plane(kPlaneDiffuseThrough));
  }
  return resolved;
}

} // namespace parity::gpu
