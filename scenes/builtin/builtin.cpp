// The names behind "builtin:", and what the built-in scenes are put together with.
#include "scenes/builtin/builtin.h"

#include <array>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "base/text/nearest.h"
#include "scenes/builtin/builtin_scenes.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/gltf/tangents.h"
#include "scenes/texture_slots.h"
#include "scenes/view.h"

namespace parity::scenes {
namespace {

using SceneMaker = Scene (*)();
constexpr std::array<std::pair<std::string_view, SceneMaker>, 9> kScenes = {{{"materials", makeMaterialsScene},
                                                                             {"spheres", makeSpheresScene},
                                                                             {"lobes", makeLobesScene},
                                                                             {"lights", makeLightsScene},
                                                                             {"lamps", makeLampsScene},
                                                                             {"shadows", makeShadowsScene},
                                                                             {"room", makeRoomScene},
                                                                             {"courtyard", makeCourtyardScene},
                                                                             {"furnace", makeFurnaceScene}}};

using EnvironmentMaker = Environment (*)();
constexpr std::array<std::pair<std::string_view, EnvironmentMaker>, 4> kEnvironments = {
    {{"studio", makeStudio}, {"sky", [] { return makeSky(); }}, {"night", makeNight}, {"white", makeWhite}}};

template <typename Table> std::vector<std::string> namesOf(const Table& table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.first);
  return names;
}

template <typename Table> auto makerOf(const Table& table, const std::string& name, const char* what) {
  std::vector<std::string_view> known;
  for (const auto& [key, maker] : table) {
    if (key == name) return maker;
    known.push_back(key);
  }
  throw base::fileError("builtin:" + name, "",
                        fmt::format("unknown {}; {}", what, base::describeNearest(name, known, "builtin:")));
}

} // namespace

std::vector<std::string> builtinSceneNames() { return namesOf(kScenes); }
std::vector<std::string> builtinEnvironmentNames() { return namesOf(kEnvironments); }
Scene makeBuiltinScene(const std::string& name) { return makerOf(kScenes, name, "scene")(); }
Environment makeBuiltinEnvironment(const std::string& name) { return makerOf(kEnvironments, name, "environment")(); }

TextureSlot SceneBuilder::texture(TextureImage image, float repeats) {
  TextureSlot slot;
  slot.image = static_cast<int>(m_scene.images.size());
  slot.uvTransform = {repeats, 0, 0, 0, repeats, 0};
  m_scene.images.push_back(std::move(image));
  return slot;
}

std::uint32_t SceneBuilder::addMesh(Mesh mesh, const Material& material) {
  mesh.name = material.name;
  mesh.material = static_cast<std::uint32_t>(m_scene.materials.size());
  if (const std::optional<int> set = tangentSetOf(material)) makeTangents(mesh, *set);
  m_scene.materials.push_back(material);
  m_scene.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(m_scene.meshes.size() - 1);
}

void SceneBuilder::place(std::uint32_t mesh, const std::string& node, const glm::vec3& position, float turnDeg,
                         float scale) {
  glm::mat4 toWorld = glm::translate(glm::mat4(1.f), position);
  toWorld = glm::rotate(toWorld, glm::radians(turnDeg), glm::vec3(0, 1, 0));
  toWorld = glm::scale(toWorld, glm::vec3(scale));
  m_scene.instances.push_back({mesh, toWorld, node});
}

void SceneBuilder::add(Mesh mesh, const Material& material, const glm::vec3& position, float turnDeg, float scale) {
  place(addMesh(std::move(mesh), material), material.name, position, turnDeg, scale);
}

void SceneBuilder::setOrbitCamera(float thetaDeg, float phiDeg, float fovYDeg) {
  ViewRequest request;
  request.orbit = glm::vec3(thetaDeg, phiDeg, 0.f);
  request.fovYDeg = fovYDeg;
  setCamera(makeCamera(m_scene, request, 1.f));
}

void SceneBuilder::setOrbitCamera(float thetaDeg, float phiDeg, float radius, float fovYDeg, const glm::vec3& target) {
  ViewRequest request;
  request.orbit = glm::vec3(thetaDeg, phiDeg, radius);
  request.target = target;
  request.fovYDeg = fovYDeg;
  setCamera(makeCamera(m_scene, request, 1.f));
}

void SceneBuilder::setCamera(Camera camera) {
  camera.name = "default";
  m_scene.cameras = {std::move(camera)};
  m_scene.defaultCamera = 0;
}

Scene SceneBuilder::finish(Environment environment) {
  m_scene.environment = std::move(environment);
  return std::move(m_scene);
}

Material metal(std::string name, const glm::vec3& f0, float roughness) {
  Material material;
  material.name = std::move(name);
  material.baseColor = glm::vec4(f0, 1.f);
  material.metallic = 1;
  material.roughness = roughness;
  return material;
}

Material plastic(std::string name, const glm::vec3& color, float roughness) {
  Material material = metal(std::move(name), color, roughness);
  material.metallic = 0;
  return material;
}

} // namespace parity::scenes
