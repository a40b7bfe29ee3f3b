#include "lighting/alpha_mask.h"

#include <algorithm>
#include <cmath>

namespace parity::lighting {

namespace {

// A texel's column or row (an integer) wrapped into 0 .. size - 1, as Vulkan does ("Wrapping Operation").
int wrapIndex(double index, int size, scenes::Wrap wrap) {
  const double n = size;
  switch (wrap) {
  case scenes::Wrap::repeat:
    index -= n * std::floor(index / n);
    break;
  case scenes::Wrap::mirroredRepeat:
    index -= 2 * n * std::floor(index / (2 * n));
    if (index >= n) index = 2 * n - 1 - index;
    break;
  case scenes::Wrap::clampToEdge:
    break;
  }
  return static_cast<int>(std::clamp(index, 0.0, n - 1)); // and where a huge uv has lost its integer part
}

double readAlpha(const base::Image8& image, const scenes::Sampler& sampler, const glm::dvec2& uv) {
  const auto texel = [&](double x, double y) {
    return image.at(wrapIndex(x, image.width, sampler.wrapU), wrapIndex(y, image.height, sampler.wrapV))[3] / 255.0;
  };
  const double x = uv.x * image.width, y = uv.y * image.height;
  if (sampler.magFilter == scenes::Filter::nearest) return texel(std::floor(x), std::floor(y));
  const double x0 = std::floor(x - 0.5), y0 = std::floor(y - 0.5), fx = x - 0.5 - x0, fy = y - 0.5 - y0;
  return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
         (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
}

} // namespace

bool isHole(const scenes::Scene& scene, const scenes::Mesh& mesh, const std::array<std::uint32_t, 3>& indices,
            const std::array<double, 3>& weights) {
  const scenes::Material& material = scene.materials[mesh.material];
  double alpha = material.baseColor.a;
  if (!mesh.colors.empty()) {
    double vertexAlpha = 0;
    for (int k = 0; k < 3; ++k) vertexAlpha += weights[k] * mesh.colors[indices[k]].a;
    alpha *= vertexAlpha;
  }
  if (const scenes::TextureSlot& slot = material.baseColorTexture; slot.present()) {
    const std::vector<glm::vec2>& uvs = slot.texCoord == 1 ? mesh.uv1 : mesh.uv0;
    glm::dvec2 uv(0);
    for (int k = 0; k < 3 && !uvs.empty(); ++k) uv += weights[k] * glm::dvec2(uvs[indices[k]]);
    const std::array<float, 6>& m = slot.uvTransform;
    glm::dvec2 st(m[0] * uv.x + m[1] * uv.y + m[2], m[3] * uv.x + m[4] * uv.y + m[5]);
    for (int c = 0; c < 2; ++c)
      if (!std::isfinite(st[c])) st[c] = 0;
    alpha *= readAlpha(scene.images[slot.image].pixels, slot.sampler, st);
  }
  return alpha < material.alphaCutoff;
}

} // namespace parity::lighting
