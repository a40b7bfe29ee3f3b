// Every material of a scene on a sphere of its own.
#include "scenes/builtin/material_balls.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "scenes/builtin/shapes.h"
#include "scenes/gltf/tangents.h"
#include "scenes/texture_slots.h"

namespace parity::scenes {
namespace {

constexpr double kRadius = 0.46;
constexpr std::size_t kMaxBalls = 10000;
constexpr float kQuarterTurn = glm::half_pi<float>();       // the middle of a half faces the camera
constexpr std::size_t kVertexBudget = std::size_t{1} << 22; // for all spheres together

// As fine as the number of spheres allows.
Mesh makeBall(std::size_t count) {
  int segments = 96;
  while (segments > 12 &&
         count * static_cast<std::size_t>(segments) * static_cast<std::size_t>(segments) / 2 > kVertexBudget)
    segments /= 2;
  const Mesh sphere = makeSphere(kRadius, segments, segments / 2);
  // The uv begin anew on the second half, so that a texture that is clamped shows on both.
  Mesh ball = sphere;
  appendMesh(ball, sphere);
  const std::size_t vertices = sphere.positions.size();
  for (std::size_t v = 0; v < ball.uv0.size(); ++v) ball.uv0[v].x = 2 * ball.uv0[v].x - (v < vertices ? 0.f : 1.f);
  ball.indices.clear();
  for (std::size_t i = 0; i < sphere.indices.size(); i += 3) {
    float u = 0;
    for (std::size_t c = 0; c < 3; ++c) u += sphere.uv0[sphere.indices[i + c]].x / 3;
    for (std::size_t c = 0; c < 3; ++c)
      ball.indices.push_back(sphere.indices[i + c] + (u < 0.5f ? 0u : static_cast<std::uint32_t>(vertices)));
  }
  ball.uv1 = ball.uv0;
  return ball;
}

} // namespace

namespace {

// A body is as thick as its ball, and absorbs as much along that as along the thickness of its own mesh.
void fillBall(Material& material) {
  if (!material.hasVolume()) return;
  constexpr auto kDiameter = static_cast<float>(2 * kRadius);
  material.attenuationDistance = std::min(material.attenuationDistance * (kDiameter / material.thickness), 1e18f);
  material.thickness = kDiameter;
}

} // namespace

Scene makeMaterialBalls(Scene scene) {
  const std::size_t count = scene.materials.size();
  if (count == 0) throw base::fileError(scene.name, "/materials", "the file has none, so --subject ball shows nothing");
  if (count > kMaxBalls)
    throw base::fileError(scene.name, "/materials",
                          fmt::format("{} are too many for --subject ball, expected at most {}", count, kMaxBalls));
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const std::size_t rows = (count + columns - 1) / columns;
  const Mesh ball = makeBall(count);
  scene.meshes.clear();
  scene.instances.clear();
  for (std::size_t m = 0; m < count; ++m) {
    Mesh mesh = ball;
    mesh.name = fmt::format("ball {}", m);
    mesh.material = static_cast<std::uint32_t>(m);
    if (const std::optional<int> set = tangentSetOf(scene.materials[m])) makeTangents(mesh, *set);
    fillBall(scene.materials[m]);
    const std::size_t column = m % columns, row = m / columns;
    const glm::vec3 center(static_cast<float>(column) - 0.5f * static_cast<float>(columns - 1),
                           0.5f * static_cast<float>(rows - 1) - static_cast<float>(row), 0.f);
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1.f), center), kQuarterTurn, {0.f, 1.f, 0.f});
    scene.instances.push_back({static_cast<std::uint32_t>(m), turned, mesh.name});
    scene.meshes.push_back(std::move(mesh));
  }

  const auto isLocal = [](const Light& light) { return light.kind != LightKind::directional; };
  if (const auto local = std::count_if(scene.lights.begin(), scene.lights.end(), isLocal)) {
    scene.warnings.push_back(fmt::format("{} point and spot lights do not light the balls: they belong to the scene's "
                                         "own geometry",
                                         local));
    std::erase_if(scene.lights, isLocal);
  }
  Camera camera;
  camera.name = "balls";
  camera.orthographic = true;
  camera.halfHeight = 0.5f * static_cast<float>(std::max(rows, columns)); // a square holds all
  camera.toWorld = glm::translate(glm::mat4(1.f), {0.f, 0.f, 2.f});
  scene.cameras = {camera};
  scene.defaultCamera = 0;
  return scene;
}

} // namespace parity::scenes
