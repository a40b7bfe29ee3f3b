// Scenes made in code, small enough to know the answer for each pixel.
#pragma once

#include <cmath>

#include "scenes/scene.h"

namespace parity::tests {

// A unit quad in the plane z = 0, from (-1,-1) to (1,1), facing +Z, uv (0,0) at the lower left, tangent +X.
inline scenes::Mesh makeQuad(std::uint32_t material) {
  scenes::Mesh mesh;
  mesh.name = "quad";
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.tangents.assign(4, {1, 0, 0, 1});
  mesh.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.material = material;
  return mesh;
}

inline glm::mat4 translation(float x, float y, float z) {
  glm::mat4 m(1.f);
  m[3] = glm::vec4(x, y, z, 1);
  return m;
}

// One quad with one opaque, double-sided material.
inline scenes::Scene makeQuadScene() {
  scenes::Scene scene;
  scene.name = "quad";
  scene.meshes = {makeQuad(0)};
  scene.instances = {{0, glm::mat4(1.f), "quad"}};
  scene.materials.emplace_back().name = "grey";
  scene.materials[0].doubleSided = true;
  return scene;
}

// Looks along -Z from z = distance; the picture's half height at z = 0 is halfHeight.
inline scenes::Camera makeFrontCamera(float halfHeight, float distance, bool orthographic) {
  scenes::Camera camera;
  camera.name = "front";
  camera.toWorld = translation(0, 0, distance);
  camera.orthographic = orthographic;
  camera.halfHeight = halfHeight;
  camera.fovYDeg = glm::degrees(2 * std::atan(halfHeight / distance));
  camera.zNear = 0.1f;
  camera.zFar = 10 * distance;
  return camera;
}

} // namespace parity::tests
