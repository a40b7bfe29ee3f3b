// EXT_mesh_gpu_instancing: the transforms with which a node shows its mesh several times.
#include "scenes/gltf/instancing.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scenes/gltf/file/accessor.h"

namespace parity::scenes {

bool isInstanced(const GltfDocument& document, int node) {
  return document.model.nodes[static_cast<std::size_t>(node)].extensions.contains("EXT_mesh_gpu_instancing");
}

std::size_t instanceCount(const GltfDocument& document, int node) {
  const auto& extensions = document.model.nodes[static_cast<std::size_t>(node)].extensions;
  const auto found = extensions.find("EXT_mesh_gpu_instancing");
  std::size_t count = 1;
  if (found != extensions.end())
    for (const std::string& name : found->second.Get("attributes").Keys()) {
      const int accessor = found->second.Get("attributes").Get(name).GetNumberAsInt();
      count = std::max(count, document.model.accessors[static_cast<std::size_t>(accessor)].count);
    }
  return count;
}

std::vector<glm::dmat4> readInstances(const GltfDocument& document, int node) {
  const auto& extensions = document.model.nodes[static_cast<std::size_t>(node)].extensions;
  const auto found = extensions.find("EXT_mesh_gpu_instancing");
  if (found == extensions.end()) return {glm::dmat4(1.0)};
  const std::string place = fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing/attributes", node);
  const tinygltf::Value& attributes = found->second.Get("attributes");
  std::optional<std::size_t> count;
  const auto find = [&](const char* name, int components, bool mayBeNormalized) {
    std::optional<AccessorView> view;
    if (!attributes.Has(name)) return view;
    view.emplace(document, attributes.Get(name).GetNumberAsInt(), place + "/" + name);
    if (view->isMatrix() || view->componentCount() != components)
      throw view->error(fmt::format("expected {} components", components));
    const bool isSigned =
        view->componentType() == TINYGLTF_COMPONENT_TYPE_BYTE || view->componentType() == TINYGLTF_COMPONENT_TYPE_SHORT;
    if (!view->isFloat() && !(mayBeNormalized && view->isNormalized() && isSigned))
      throw view->error(mayBeNormalized ? "expected FLOAT, or BYTE or SHORT, normalized" : "expected FLOAT");
    if (count && view->count() != *count)
      throw view->error(fmt::format("has {} elements, but another attribute has {}", view->count(), *count));
    count = view->count();
    return view;
  };
  const auto translations = find("TRANSLATION", 3, false), rotations = find("ROTATION", 4, true),
             scales = find("SCALE", 3, false);
  if (!count) throw document.error(place, "needs TRANSLATION, ROTATION or SCALE");
  const MemoryCharge charge(document.memory, *count * (sizeof(glm::dmat4) + sizeof(glm::vec4)), place);
  std::vector<glm::dmat4> transforms(*count, glm::dmat4(1.0));
  if (translations) {
    const std::vector<glm::vec3> values = translations->readVec3();
    for (std::size_t i = 0; i < *count; ++i) transforms[i] = glm::translate(glm::dmat4(1.0), glm::dvec3(values[i]));
  }
  if (rotations) {
    const std::vector<glm::vec4> values = rotations->readVec4(0.f);
    for (std::size_t i = 0; i < *count; ++i) {
      const glm::dquat rotation(values[i].w, values[i].x, values[i].y, values[i].z);
      if (!(glm::length(rotation) > 0))
        throw rotations->error(fmt::format("element {} is a quaternion of length 0", i));
      transforms[i] *= glm::mat4_cast(glm::normalize(rotation));
    }
  }
  if (scales) {
    const std::vector<glm::vec3> values = scales->readVec3();
    for (std::size_t i = 0; i < *count; ++i) transforms[i] = glm::scale(transforms[i], glm::dvec3(values[i]));
  }
  return transforms;
}

} // namespace parity::scenes
