// One primitive of a glTF mesh -> one scenes::Mesh.
#include "scenes/gltf_mesh.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "scenes/gltf_accessor.h"
#include "scenes/mesh_repair.h"
#include "scenes/names.h"
#include "scenes/tangents.h"

namespace parity::scenes {
namespace {

const tinygltf::Primitive& primitiveOf(const GltfDocument& document, int mesh, int primitive) {
  return document.model.meshes[static_cast<std::size_t>(mesh)].primitives[static_cast<std::size_t>(primitive)];
}

std::string placeOf(int mesh, int primitive) { return fmt::format("meshes[{}].primitives[{}]", mesh, primitive); }

// Reads one attribute after another, all of the same count.
class AttributeReader {
public:
  AttributeReader(const GltfDocument& document, const tinygltf::Primitive& primitive, std::string place)
      : m_document(document), m_primitive(primitive), m_place(std::move(place)) {}

  // The accessor of an attribute with `least` to `most` components; nothing where it is absent.
  std::optional<AccessorView> find(const std::string& name, int least, int most) {
    const auto found = m_primitive.attributes.find(name);
    if (found == m_primitive.attributes.end()) return std::nullopt;
    AccessorView view(m_document, found->second, m_place + ".attributes." + name);
    if (view.componentCount() < least || view.componentCount() > most)
      throw m_document.error(view.place(), fmt::format("has {} components", view.componentCount()));
    if (m_count && view.count() != m_count)
      throw m_document.error(view.place(), fmt::format("has {} elements where POSITION has {}", view.count(), m_count));
    m_count = view.count();
    return view;
  }
  std::size_t count() const { return m_count; }

private:
  const GltfDocument& m_document;
  const tinygltf::Primitive& m_primitive;
  std::string m_place;
  std::size_t m_count = 0;
};

// The triangle list of a primitive, whatever its mode. An incomplete last triangle is dropped with a warning.
std::vector<std::uint32_t> readTriangles(const GltfDocument& document, const tinygltf::Primitive& primitive,
                                         const std::string& place, std::size_t vertexCount,
                                         std::vector<std::string>& warnings) {
  std::vector<std::uint32_t> indices;
  if (primitive.indices >= 0)
    indices = AccessorView(document, primitive.indices, place + ".indices").readIndices(vertexCount);
  else {
    indices.resize(vertexCount);
    std::iota(indices.begin(), indices.end(), 0u);
  }
  if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) return listFromStrip(indices);
  if (primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) return listFromFan(indices);
  if (indices.size() % 3) {
    warnings.push_back(
        fmt::format("{}: {} indices are no whole number of triangles, the rest is dropped", place, indices.size()));
    indices.resize(indices.size() / 3 * 3);
  }
  return indices;
}

void readTexCoords(AttributeReader& reader, Mesh& mesh, const Material& material, const std::string& place,
                   std::vector<std::string>& warnings) {
  if (const auto view = reader.find("TEXCOORD_0", 2, 2)) mesh.uv0 = view->readVec2();
  if (const auto view = reader.find("TEXCOORD_1", 2, 2)) mesh.uv1 = view->readVec2();
  bool missing = false;
  for (const TextureSlot* slot : {&material.baseColorTexture, &material.metallicRoughnessTexture,
                                  &material.normalTexture, &material.occlusionTexture, &material.emissiveTexture,
                                  &material.specularTexture, &material.specularColorTexture})
    missing |= slot->present() && (slot->texCoord == 0 ? mesh.uv0 : mesh.uv1).empty();
  if (missing)
    warnings.push_back(fmt::format("{}: material '{}' has a texture whose TEXCOORD this mesh lacks, read at (0,0)",
                                   place, material.name));
}

// Normals, and tangents where a normal map needs them.
void readFrames(AttributeReader& reader, Mesh& mesh, const Material& material, const std::string& place,
                std::vector<std::string>& warnings) {
  const auto normals = reader.find("NORMAL", 3, 3);
  const auto tangents = reader.find("TANGENT", 4, 4);
  if (normals) {
    mesh.normals = normals->readVec3Unchecked();
    if (const std::size_t count = mendNormals(mesh))
      warnings.push_back(fmt::format("{}: {} normals of no length are replaced by those of their faces", place, count));
  } else
    makeFlatNormals(mesh);
  if (!material.normalTexture.present()) return;
  if (normals && tangents) {
    mesh.tangents = tangents->readVec4Unchecked();
    if (const std::size_t count = mendTangents(mesh))
      warnings.push_back(fmt::format("{}: {} tangents of no length are replaced by some right angle", place, count));
  } else if (const std::size_t count = makeTangents(mesh, material.normalTexture.texCoord))
    warnings.push_back(fmt::format("{}: {} vertices have no area in uv, their tangents are arbitrary", place, count));
}

} // namespace

std::size_t estimateBytes(const GltfDocument& document, int mesh, int primitive) {
  const tinygltf::Primitive& source = primitiveOf(document, mesh, primitive);
  const auto position = source.attributes.find("POSITION");
  if (position == source.attributes.end())
    throw document.error(placeOf(mesh, primitive) + ".attributes", "POSITION is missing");
  const auto countOf = [&](int accessor) { return document.model.accessors[static_cast<std::size_t>(accessor)].count; };
  std::size_t vertices = countOf(position->second);
  std::size_t corners = source.indices >= 0 ? countOf(source.indices) : vertices;
  if (source.mode != TINYGLTF_MODE_TRIANGLES) corners *= 3;
  if (!source.attributes.contains("NORMAL")) vertices = corners; // flat normals split them
  const std::size_t bytes =
      2 * sizeof(glm::vec3) + sizeof(glm::vec4) +
      sizeof(glm::vec2) * (source.attributes.contains("TEXCOORD_0") + source.attributes.contains("TEXCOORD_1")) +
      sizeof(glm::vec4) * source.attributes.contains("COLOR_0");
  return vertices * bytes + corners * sizeof(std::uint32_t);
}

GltfPrimitive buildPrimitive(const GltfDocument& document, int meshIndex, int primitiveIndex,
                             std::uint32_t materialIndex, const Material& material) {
  const tinygltf::Primitive& source = primitiveOf(document, meshIndex, primitiveIndex);
  const std::string place = placeOf(meshIndex, primitiveIndex);
  GltfPrimitive result;
  if (source.mode < TINYGLTF_MODE_POINTS || source.mode > TINYGLTF_MODE_TRIANGLE_FAN)
    throw document.error(place + ".mode", fmt::format("{} is not a mode", source.mode));
  if (source.mode < TINYGLTF_MODE_TRIANGLES) {
    result.warnings.push_back(place + ": points and lines are not drawn");
    return result;
  }
  if (!source.targets.empty())
    result.warnings.push_back(place + ": morph targets are not supported, ignored: shown as it is stored");

  Mesh mesh;
  mesh.name = cleanName(document.model.meshes[static_cast<std::size_t>(meshIndex)].name);
  if (mesh.name.empty()) mesh.name = fmt::format("mesh {}", meshIndex);
  if (document.model.meshes[static_cast<std::size_t>(meshIndex)].primitives.size() > 1)
    mesh.name += fmt::format(" [{}]", primitiveIndex);
  mesh.material = materialIndex;

  AttributeReader reader(document, source, place);
  mesh.positions = reader.find("POSITION", 3, 3)->readVec3();
  mesh.indices = readTriangles(document, source, place, reader.count(), result.warnings);
  if (mesh.indices.empty()) {
    result.warnings.push_back(place + ": holds no whole triangle");
    return result;
  }
  readTexCoords(reader, mesh, material, place, result.warnings);
  if (const auto view = reader.find("COLOR_0", 3, 4)) mesh.colors = view->readVec4(1.f);
  readFrames(reader, mesh, material, place, result.warnings);
  result.mesh = std::move(mesh);
  return result;
}

} // namespace parity::scenes
