#include "lighting/surface/alpha_mask.h"

#include "lighting/surface/texture_read.h"

namespace parity::lighting {

bool isHole(const scenes::Scene& scene, const scenes::Mesh& mesh, const std::array<std::uint32_t, 3>& indices,
            const std::array<double, 3>& weights) {
  const scenes::Material& material = scene.materials[mesh.material];
  double alpha = material.baseColor.a;
  if (!mesh.colors.empty()) {
    double vertexAlpha = 0;
    for (int k = 0; k < 3; ++k) vertexAlpha += weights[k] * mesh.colors[indices[k]].a;
    alpha *= vertexAlpha;
  }
  if (const scenes::TextureSlot& slot = material.baseColorTexture; slot.present())
    alpha *= readTexture(scene, mesh, slot, {indices, weights}).a;
  return alpha < material.alphaCutoff;
}

} // namespace parity::lighting
