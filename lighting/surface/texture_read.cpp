#include "lighting/surface/texture_read.h"

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

} // namespace

glm::dvec4 readTexture(const scenes::Scene& scene, const scenes::Mesh& mesh, const scenes::TextureSlot& slot,
                       const TrianglePoint& point) {
  const std::vector<glm::vec2>& uvs = slot.texCoord == 1 ? mesh.uv1 : mesh.uv0;
  glm::dvec2 uv(0);
  for (int k = 0; k < 3 && !uvs.empty(); ++k) uv += point.weights[k] * glm::dvec2(uvs[point.vertices[k]]);
  const std::array<float, 6>& m = slot.uvTransform;
  glm::dvec2 st(m[0] * uv.x + m[1] * uv.y + m[2], m[3] * uv.x + m[4] * uv.y + m[5]);
  for (int c = 0; c < 2; ++c)
    if (!std::isfinite(st[c])) st[c] = 0;

  const base::Image8& image = scene.images[static_cast<std::size_t>(slot.image)].pixels;
  const auto texel = [&](double x, double y) {
    const std::uint8_t* t =
        image.at(wrapIndex(x, image.width, slot.sampler.wrapU), wrapIndex(y, image.height, slot.sampler.wrapV));
    return glm::dvec4(t[0], t[1], t[2], t[3]) / 255.0;
  };
  const double x = st.x * image.width, y = st.y * image.height;
  if (slot.sampler.magFilter == scenes::Filter::nearest) return texel(std::floor(x), std::floor(y));
  const double x0 = std::floor(x - 0.5), y0 = std::floor(y - 0.5), fx = x - 0.5 - x0, fy = y - 0.5 - y0;
  return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
         (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
}

} // namespace parity::lighting
