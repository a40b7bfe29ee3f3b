// A Scene -> one binary glTF 2.0 file: meshes, and what places them.
#include "scenes/gltf/export_glb.h"

#include <array>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "base/text/text.h"
#include "scenes/gltf/export_light_camera.h"
#include "scenes/gltf/export_material.h"
#include "scenes/gltf/glb_draft.h"

namespace parity::scenes {

namespace {

template <typename T>
int addAccessor(GlbDraft& draft, const std::vector<T>& values, int componentType, int type, int target) {
  tinygltf::Accessor accessor;
  accessor.bufferView = draft.addView(std::as_bytes(std::span(values)), target);
  accessor.componentType = componentType;
  accessor.type = type;
  accessor.count = values.size();
  draft.model.accessors.push_back(std::move(accessor));
  return static_cast<int>(draft.model.accessors.size() - 1);
}

// An attribute of floats.
template <typename Vec> int addAttribute(GlbDraft& draft, const std::vector<Vec>& values) {
  constexpr std::array kTypes = {TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
  return addAccessor(draft, values, TINYGLTF_COMPONENT_TYPE_FLOAT, kTypes[static_cast<std::size_t>(Vec::length() - 2)],
                     TINYGLTF_TARGET_ARRAY_BUFFER);
}

int addPositions(GlbDraft& draft, const std::vector<glm::vec3>& positions) {
  const int index = addAttribute(draft, positions);
  glm::vec3 lower = positions.front(), upper = lower;
  for (const glm::vec3& p : positions) lower = glm::min(lower, p), upper = glm::max(upper, p);
  tinygltf::Accessor& accessor = draft.model.accessors.back();
  accessor.minValues = {lower.x, lower.y, lower.z};
  accessor.maxValues = {upper.x, upper.y, upper.z};
  return index;
}

// The index of each mesh of the scene in the file; -1: it has no triangle.
std::vector<int> addMeshes(GlbDraft& draft, const Scene& scene) {
  std::vector<int> places;
  for (const Mesh& mesh : scene.meshes) {
    places.push_back(mesh.indices.empty() ? -1 : static_cast<int>(draft.model.meshes.size()));
    if (mesh.indices.empty()) continue;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = static_cast<int>(mesh.material);
    auto& attributes = primitive.attributes;
    attributes["POSITION"] = addPositions(draft, mesh.positions);
    attributes["NORMAL"] = addAttribute(draft, mesh.normals);
    if (!mesh.tangents.empty()) attributes["TANGENT"] = addAttribute(draft, mesh.tangents);
    if (!mesh.uv0.empty()) attributes["TEXCOORD_0"] = addAttribute(draft, mesh.uv0);
    if (!mesh.uv1.empty()) {
      if (mesh.uv0.empty()) // sets are numbered without gaps (glTF 2.0, 3.7.2.1); one that is absent is read as 0
        attributes["TEXCOORD_0"] = addAttribute(draft, std::vector<glm::vec2>(mesh.uv1.size()));
      attributes["TEXCOORD_1"] = addAttribute(draft, mesh.uv1);
    }
    if (!mesh.colors.empty()) attributes["COLOR_0"] = addAttribute(draft, mesh.colors);
    primitive.indices = addAccessor(draft, mesh.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                    TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    tinygltf::Mesh& added = draft.model.meshes.emplace_back();
    added.name = base::cleanUtf8(mesh.name);
    added.primitives.push_back(std::move(primitive));
  }
  return places;
}

void addInstances(GlbDraft& draft, const Scene& scene, const std::vector<int>& meshPlaces) {
  for (const Instance& instance : scene.instances) {
    if (meshPlaces[instance.mesh] < 0) continue;
    tinygltf::Node node;
    node.name = base::cleanUtf8(instance.node);
    node.mesh = meshPlaces[instance.mesh];
    node.matrix = gltfMatrix(instance.toWorld);
    draft.addNode(std::move(node));
  }
}

// Whether the axes stand at right angles: glTF asks for matrices that are translation, rotation and scale (3.5.3).
bool isSheared(const glm::mat4& toWorld) {
  constexpr double kRounding = 1e-4;
  const glm::dvec3 axes[] = {glm::dvec3(toWorld[0]), glm::dvec3(toWorld[1]), glm::dvec3(toWorld[2])};
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 &a = axes[i], &b = axes[(i + 1) % 3];
    if (std::abs(glm::dot(a, b)) > kRounding * glm::length(a) * glm::length(b)) return true;
  }
  return false;
}

} // namespace

std::vector<std::byte> toGlb(const Scene& scene) {
  GlbDraft draft;
  draft.label = scene.file.empty() ? scene.name : scene.file.string();
  draft.model.asset.version = "2.0";
  draft.model.asset.generator = "parity";
  draft.model.scenes.emplace_back().name = base::cleanUtf8(scene.name);
  draft.model.defaultScene = 0;
  addMaterials(draft, scene);
  addInstances(draft, scene, addMeshes(draft, scene));
  addLights(draft, scene);
  addCameras(draft, scene);
  return packGlb(draft);
}

std::vector<std::string> listNotInGltf(const Scene& scene) {
  std::vector<std::string> lines;
  for (const Light& light : scene.lights) {
    if (light.falloff == Falloff::exponent)
      lines.push_back(
          fmt::format("light '{}': glTF has no falloff exponent ({}); it is kept as extras.falloffExponent, "
                      "and programs that do not read it take the light's lux for candela",
                      light.name, light.falloffExponent));
    if (light.falloff == Falloff::ue4)
      lines.push_back(fmt::format("light '{}': glTF does not know the falloff of Unreal Engine 4", light.name));
    if (light.specularScale != 1)
      lines.push_back(
          fmt::format("light '{}': glTF has no scale of specular light ({})", light.name, light.specularScale));
  }
  for (const Instance& instance : scene.instances)
    if (isSheared(instance.toWorld))
      lines.push_back(fmt::format("node '{}': its matrix is sheared, which glTF forbids and strict programs refuse",
                                  instance.node));
  if (scene.lightScales != LightScales()) lines.emplace_back("glTF has no scales of light");
  if (scene.fog && scene.fog->isSeen()) lines.emplace_back("glTF has no fog");
  return lines;
}

} // namespace parity::scenes
