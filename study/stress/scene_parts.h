// What the generated scenes are put together with. Private to study/stress/*_scenes.cpp and random_scene.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "scenes/builtin/shapes.h"
#include "shading/terms.h"
#include "study/stress/stress_scene.h"

namespace parity::stress::parts {

using shading::Term;

inline constexpr float kNan32 = std::numeric_limits<float>::quiet_NaN(),
                       kInf32 = std::numeric_limits<float>::infinity();

// A square of side 2 in z = 0 that faces +Z.
inline scenes::Mesh makeQuad(const glm::vec3& normal = {0, 0, 1}) {
  scenes::Mesh mesh;
  mesh.name = "quad";
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.normals.assign(4, normal);
  mesh.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

inline scenes::Mesh makeBall() { return scenes::makeSphere(1, 32, 16); }

// Looks along -Z from z = 3, or along +Z from z = -3; orthographic: V is the same everywhere.
inline scenes::Camera makeCamera(bool fromBehind = false) {
  scenes::Camera camera;
  camera.name = "stress";
  if (fromBehind) camera.toWorld = glm::mat4({-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, 1});
  camera.toWorld[3] = glm::vec4(0, 0, fromBehind ? -3 : 3, 1);
  camera.orthographic = true;
  camera.halfHeight = 1.1f;
  camera.zNear = 0.1f;
  camera.zFar = 10;
  return camera;
}

inline scenes::Material makeMaterial(float roughness, float metallic = 0, const glm::vec3& color = glm::vec3(0.6f)) {
  scenes::Material material;
  material.name = "material";
  material.baseColor = glm::vec4(color, 1);
  material.roughness = roughness;
  material.metallic = metallic;
  return material;
}

inline scenes::Light makeSun(const glm::vec3& towards, float lux) {
  scenes::Light light;
  light.name = "sun";
  light.kind = scenes::LightKind::directional;
  light.direction = -glm::normalize(towards);
  light.color = glm::vec3(lux);
  return light;
}

inline scenes::Light makePoint(const glm::vec3& position, float candela, float range = 0) {
  scenes::Light light;
  light.name = "point";
  light.position = position;
  light.color = glm::vec3(candela);
  light.range = range;
  return light;
}

// Equirectangular, of one radiance but for what `paint` changes.
template <typename Paint> scenes::Environment makeEnvironment(const std::string& name, float radiance, Paint paint) {
  scenes::Environment environment;
  environment.name = name;
  environment.radiance = base::Image(32, 16, 3);
  std::fill(environment.radiance.pixels.begin(), environment.radiance.pixels.end(), radiance);
  paint(environment.radiance);
  return environment;
}
inline scenes::Environment makeEnvironment(const std::string& name, float radiance) {
  return makeEnvironment(name, radiance, [](base::Image&) {});
}

// One mesh of one material.
inline StressScene makeScene(std::string name, std::string wants, scenes::Mesh mesh, const scenes::Material& material) {
  StressScene s;
  s.name = std::move(name);
  s.wants = std::move(wants);
  s.scene.name = s.name;
  s.scene.meshes = {std::move(mesh)};
  s.scene.instances = {{0, glm::mat4(1.f), "object"}};
  s.scene.materials = {material};
  s.leastRoughness = {material.roughness};
  s.camera = makeCamera();
  s.reproduce = "--only renders --renders " + s.name;
  return s;
}

inline const base::Image& termOf(const PathFrame& path, Term term) {
  return path.frame.terms[static_cast<std::size_t>(term)];
}

inline float greatest(const base::Image& image) {
  float most = 0;
  for (const float value : image.pixels) most = std::max(most, std::fabs(value));
  return most;
}

// "" or what is wrong: each of these terms must be exactly 0.
std::vector<std::string> requireZero(const PathFrame& path, const std::vector<Term>& terms);
// No colour beyond what a half target holds.
std::vector<std::string> requireWithinHalf(const SceneFrames& frames);
// The same bits in every path.
std::vector<std::string> requireSame(const SceneFrames& frames, const SceneFrames* twin, const std::string& as);

inline void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

} // namespace parity::stress::parts
