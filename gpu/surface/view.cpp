#include "gpu/surface/view.h"

#include <algorithm>
#include <cmath>

namespace parity::gpu {

std::vector<Tile> makeTiles(std::uint32_t width, std::uint32_t height) {
  const std::uint32_t rows = std::max(1u, kMaxTilePixels / width);
  std::vector<Tile> tiles;
  for (std::uint32_t row = 0; row < height; row += rows) tiles.push_back({row, std::min(rows, height - row)});
  return tiles;
}

std::vector<glm::vec2> samplePositions(int count, float width) {
  std::vector<glm::vec2> positions;
  const double half = 0.5 / count;
  for (int i = 0; i < count; ++i) {
    double radicalInverse = 0, digit = 0.5;
    for (int bits = i; bits > 0; bits >>= 1, digit /= 2) radicalInverse += digit * (bits & 1);
    positions.emplace_back(i * 2 * half + half, std::fmod(radicalInverse + half, 1.0));
    if (width != 1) positions.back() = 0.5f + width * (positions.back() - 0.5f);
  }
  return positions;
}

glm::mat4 makeWorldToClip(const scenes::Camera& camera, float aspect) {
  const float n = camera.zNear, f = camera.zFar;
  glm::mat4 projection(0.f);
  if (camera.orthographic) {
    projection[0][0] = 1 / (camera.halfHeight * aspect);
    projection[1][1] = 1 / camera.halfHeight;
    projection[2][2] = 1 / (n - f);
    projection[3][2] = n / (n - f);
    projection[3][3] = 1;
  } else {
    const float tangent = std::tan(glm::radians(camera.fovYDeg) / 2);
    projection[0][0] = 1 / (tangent * aspect);
    projection[1][1] = 1 / tangent;
    projection[2][2] = f / (n - f);
    projection[3][2] = n * f / (n - f);
    projection[2][3] = -1;
  }
  return projection * glm::inverse(camera.toWorld);
}

GpuView makeView(const scenes::Scene& scene, const scenes::Camera& camera, std::uint32_t width, std::uint32_t height) {
  const glm::vec3 right(camera.toWorld[0]), up(camera.toWorld[1]), back(camera.toWorld[2]), eye(camera.toWorld[3]);
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const float halfHeight = camera.orthographic ? camera.halfHeight : std::tan(glm::radians(camera.fovYDeg) / 2);
  const float halfWidth = halfHeight * aspect;
  // The picture plane from its top left corner, a pixel to the right, a pixel down.
  const glm::vec3 corner = halfHeight * up - halfWidth * right;
  const glm::vec3 stepX = 2 * halfWidth / static_cast<float>(width) * right,
                  stepY = -2 * halfHeight / static_cast<float>(height) * up;
  GpuView view{};
  const bool o = camera.orthographic;
  view.eye = vec4(eye, o ? 1.f : 0.f);
  view.viewer = o ? vec4(back, 0) : vec4(eye, 1);
  view.origin = o ? vec4(corner, 0) : vec4(0.f);
  view.originX = o ? vec4(stepX, 0) : vec4(0.f);
  view.originY = o ? vec4(stepY, 0) : vec4(0.f);
  view.direction = vec4(o ? -back : corner - back, 0);
  view.directionX = o ? vec4(0.f) : vec4(stepX, 0);
  view.directionY = o ? vec4(0.f) : vec4(stepY, 0);
  view.forward = vec4(-back, glm::dot(-back, eye));
  view.skyLightColor = vec4(scene.lightScales.skyLightColor, 0);
  view.indirectColorScale = vec4(scene.lightScales.indirectColorScale, 0);
  if (const auto& fog = scene.fog) {
    view.fog = vec4(fog->density, fog->heightFalloff, fog->height, fog->startDistance);
    view.fogColor = vec4(fog->color, fog->maxOpacity);
  }
  const glm::mat4 rows = glm::transpose(makeWorldToClip(camera, aspect));
  view.picture[0] = 0.5f * (rows[3] + rows[0]);
  view.picture[1] = 0.5f * (rows[3] - rows[1]); // down
  view.picture[2] = rows[3];
  view.pictureScale = vec4(0.5f * static_cast<float>(height) / halfHeight, 0, 0, 0);
  return view;
}

} // namespace parity::gpu
