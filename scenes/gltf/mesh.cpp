// One primitive of a glTF mesh -> one scenes::Mesh.
#include "scenes/gltf/mesh.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenes/gltf/mesh_repair.h"
#include "scenes/gltf/morph.h"
#include "scenes/gltf/primitive.h"
#include "scenes/gltf/tangents.h"
#include "scenes/names.h"
#include "scenes/texture_slots.h"

namespace parity::scenes {
namespace {

std::string placeOf(int mesh, int primitive) { return fmt::format("/meshes/{}/primitives/{}", mesh, primitive); }

std::string nameOf(const GltfDocument& document, int mesh, int primitive) {
  const tinygltf::Mesh& source = document.model.meshes[static_cast<std::size_t>(mesh)];
  std::string name = cleanName(source.name);
  if (name.empty()) name = fmt::format("mesh {}", mesh);
  return source.primitives.size() > 1 ? name + fmt::format(" [{}]", primitive) : name;
}

// Warns where the accessor declares other limits than its numbers have, by more than their digits in the file.
void checkLimits(const GltfDocument& document, const PrimitiveReader& reader, const std::vector<glm::vec3>& positions,
                 std::vector<std::string>& warnings) {
  const int index = reader.source().attributes.at("POSITION");
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(index)];
  if (reader.isDraco() || accessor.normalized || accessor.minValues.size() != 3 || accessor.maxValues.size() != 3)
    return; // a Draco stream moves them, normalised ones are stated before their scaling
  glm::vec3 lower = positions.front(), upper = lower;
  for (const glm::vec3& p : positions) lower = glm::min(lower, p), upper = glm::max(upper, p);
  double largest = 0;
  for (const double v : accessor.minValues) largest = std::max(largest, std::abs(v));
  for (const double v : accessor.maxValues) largest = std::max(largest, std::abs(v));
  for (int i = 0; i < 3; ++i)
    if (const auto c = static_cast<std::size_t>(i);
        lower[i] < accessor.minValues[c] - 1e-4 * largest || upper[i] > accessor.maxValues[c] + 1e-4 * largest) {
      warnings.push_back(fmt::format(
          "{}/attributes/POSITION (/accessors/{}): its values go from {} to {} in {}, outside its "
          "min and max, {} and {}",
          reader.place(), index, lower[i], upper[i], "xyz"[i], accessor.minValues[c], accessor.maxValues[c]));
      return;
    }
}

void readTexCoords(const PrimitiveReader& reader, Mesh& mesh, const Material& material, const UvSets& sets,
                   std::vector<std::string>& warnings) {
  if (const auto view = reader.attribute(fmt::format("TEXCOORD_{}", sets.first), warnings)) mesh.uv0 = view->readVec2();
  if (sets.second != sets.first)
    if (const auto view = reader.attribute(fmt::format("TEXCOORD_{}", sets.second), warnings))
      mesh.uv1 = view->readVec2();
  for (const NamedSlot& each : kTextureSlots)
    if (const TextureSlot& slot = material.*each.slot;
        slot.present() && (slot.texCoord == 0 ? mesh.uv0 : mesh.uv1).empty())
      warnings.push_back(
          fmt::format("{}: the {} of material '{}' needs TEXCOORD_{}, which the mesh lacks; it is read at (0,0)",
                      reader.place(), each.key, material.name, slot.texCoord == 0 ? sets.first : sets.second));
}

std::size_t bytesOfVertex(const Mesh& mesh) {
  return sizeof(glm::vec3) * 2 + sizeof(glm::vec4) * (1 + !mesh.colors.empty()) +
         sizeof(glm::vec2) * (std::size_t{!mesh.uv0.empty()} + !mesh.uv1.empty());
}

// Counts what that takes for its own and what the mesh grows by.
std::size_t makeTangentsCounted(Mesh& mesh, int texCoord, MemoryBudget& memory, const std::string& place) {
  const MemoryCharge working(memory, bytesToMakeTangents(mesh), place);
  const std::size_t ofVertex = bytesOfVertex(mesh);
  return makeTangents(mesh, texCoord, [&](std::size_t vertices) { memory.take(vertices * ofVertex, place); });
}

// Makes the directions of a posed mesh usable, and generates what it lacks and needs.
void finishFrames(Mesh& mesh, const Material& material, const UvSets& sets, MemoryBudget& memory,
                  const std::string& place, std::vector<std::string>& warnings) {
  if (mesh.normals.empty())
    makeFlatNormals(mesh);
  else if (const BrokenDirections broken = mendNormals(mesh); broken.any())
    warnings.push_back(fmt::format("{}: normals of the faces replace {}", place, describe(broken, "normal")));
  if (!mesh.tangents.empty()) {
    if (const BrokenDirections broken = mendTangents(mesh); broken.any())
      warnings.push_back(
          fmt::format("{}: arbitrary perpendicular tangents replace {}", place, describe(broken, "tangent")));
  } else if (const std::optional<int> set = tangentSetOf(material)) {
    const std::size_t count = makeTangentsCounted(mesh, *set, memory, place);
    const bool hasUvs = !(*set == 0 ? mesh.uv0 : mesh.uv1).empty();
    if (material.hasAnisotropy() && !hasUvs)
      warnings.push_back(fmt::format(
          "{}: has neither tangents nor TEXCOORD_{}, so the direction of the anisotropy of material '{}' is "
          "arbitrary",
          place, *set == 0 ? sets.first : sets.second, material.name));
    else if (count > 0)
      warnings.push_back(fmt::format("{}: {} vertices have no uv area, so their tangents are arbitrary", place, count));
  }
}

} // namespace

std::size_t estimateBytes(const GltfDocument& document, int mesh, int primitive) {
  const tinygltf::Primitive& source = primitiveOf(document, mesh, primitive);
  const auto position = source.attributes.find("POSITION");
  if (position == source.attributes.end())
    throw document.error(placeOf(mesh, primitive) + "/attributes", "POSITION is missing");
  const auto countOf = [&](int accessor) { return document.model.accessors[static_cast<std::size_t>(accessor)].count; };
  std::size_t vertices = countOf(position->second);
  std::size_t corners = source.indices >= 0 ? countOf(source.indices) : vertices;
  if (source.mode != TINYGLTF_MODE_TRIANGLES) corners *= 3;
  if (!source.attributes.contains("NORMAL")) vertices = corners; // flat normals split them
  std::size_t bytes =
      2 * sizeof(glm::vec3) + sizeof(glm::vec4) +
      sizeof(glm::vec2) * (source.attributes.contains("TEXCOORD_0") + source.attributes.contains("TEXCOORD_1")) +
      sizeof(glm::vec4) * source.attributes.contains("COLOR_0");
  for (int n = 0; source.attributes.contains(fmt::format("JOINTS_{}", n)); ++n) // held while the mesh is posed
    bytes += sizeof(glm::u16vec4) + sizeof(glm::vec4);
  if (!source.targets.empty()) bytes += sizeof(glm::vec4);
  return vertices * bytes + corners * sizeof(std::uint32_t);
}

GltfPrimitive buildPrimitive(const GltfDocument& document, int meshIndex, int primitiveIndex,
                             std::uint32_t materialIndex, const Material& material, const UvSets& uvSets,
                             const MeshPose& pose) {
  GltfPrimitive result;
  const std::string place = placeOf(meshIndex, primitiveIndex);
  if (primitiveOf(document, meshIndex, primitiveIndex).mode < TINYGLTF_MODE_TRIANGLES) {
    result.warnings.push_back(place + ": points and lines are not drawn");
    return result;
  }
  const PrimitiveReader reader(document, meshIndex, primitiveIndex);
  std::vector<std::string>& warnings = result.warnings;
  Mesh mesh;
  mesh.name = nameOf(document, meshIndex, primitiveIndex);
  mesh.material = materialIndex;
  mesh.positions = reader.attribute("POSITION", warnings)->readVec3();
  checkLimits(document, reader, mesh.positions, warnings);
  mesh.indices = reader.readTriangles(warnings);
  if (mesh.indices.empty()) {
    warnings.push_back(place + ": holds no whole triangle");
    return result;
  }
  readTexCoords(reader, mesh, material, uvSets, warnings);
  if (const auto view = reader.attribute("COLOR_0", warnings)) mesh.colors = view->readVec4(1.f);
  const auto normals = reader.attribute("NORMAL", warnings), tangents = reader.attribute("TANGENT", warnings);
  if (normals) mesh.normals = normals->readVec3Unchecked();
  // Without normals in the file its tangents have no meaning (glTF 2.0, 3.7.2.1).
  if (normals && tangents && tangentSetOf(material)) mesh.tangents = tangents->readVec4Unchecked();

  applyMorphTargets(reader, pose.weights, uvSets, mesh, warnings);
  result.isSkinned = pose.skin && applySkin(reader, *pose.skin, mesh, warnings);
  finishFrames(mesh, material, uvSets, document.memory, place, warnings);
  result.mesh = std::move(mesh);
  return result;
}

} // namespace parity::scenes
