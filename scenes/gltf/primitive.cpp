// The attributes and indices of one primitive, wherever they are stored.
#include "scenes/gltf/primitive.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "scenes/gltf/file/draco.h"
#include "scenes/gltf/mesh_repair.h"

namespace parity::scenes {
namespace {

// A set of component types; each integer one by value and normalised.
using Types = unsigned;
constexpr Types kFloat = 1, kS8 = 2, kS8n = 4, kU8 = 8, kU8n = 16, kS16 = 32, kS16n = 64, kU16 = 128, kU16n = 256;

Types typeOf(const AccessorView& view) {
  switch (view.componentType()) {
  case TINYGLTF_COMPONENT_TYPE_FLOAT:
    return view.isNormalized() ? 0 : kFloat;
  case TINYGLTF_COMPONENT_TYPE_BYTE:
    return view.isNormalized() ? kS8n : kS8;
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return view.isNormalized() ? kU8n : kU8;
  case TINYGLTF_COMPONENT_TYPE_SHORT:
    return view.isNormalized() ? kS16n : kS16;
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return view.isNormalized() ? kU16n : kU16;
  default:
    return 0;
  }
}

// What an attribute may be: in core (glTF 2.0, 3.7.2.1 and 3.7.2.2), and with KHR_mesh_quantization beyond that.
struct Semantic {
  std::string_view name; // without "_0"
  int least, most;       // components
  Types core, quantized;
};
constexpr Types kUnit = kFloat | kU8n | kU16n, kSigned = kS8n | kS16n;
constexpr std::array<Semantic, 7> kAttributes = {
    {{"POSITION", 3, 3, kFloat, kS8 | kS8n | kU8 | kU8n | kS16 | kS16n | kU16 | kU16n},
     {"NORMAL", 3, 3, kFloat, kSigned},
     {"TANGENT", 4, 4, kFloat, kSigned},
     {"TEXCOORD", 2, 2, kUnit, kS8 | kS8n | kU8 | kS16 | kS16n | kU16},
     {"COLOR", 3, 4, kUnit, 0},
     {"JOINTS", 4, 4, kU8 | kU16, 0},
     {"WEIGHTS", 4, 4, kUnit, 0}}};
constexpr std::array<Semantic, 5> kTargets = {{{"POSITION", 3, 3, kFloat, kS8 | kS8n | kS16 | kS16n},
                                               {"NORMAL", 3, 3, kFloat, kSigned},
                                               {"TANGENT", 3, 3, kFloat, kSigned},
                                               {"TEXCOORD", 2, 2, kUnit | kSigned, kS8 | kS16},
                                               {"COLOR", 3, 4, kUnit | kSigned, 0}}};

const Semantic& semanticOf(const std::string& name, bool isTarget) {
  const std::span<const Semantic> all = isTarget ? std::span<const Semantic>(kTargets) : kAttributes;
  return *std::find_if(all.begin(), all.end(), [&](const Semantic& each) { return name.starts_with(each.name); });
}

} // namespace

const tinygltf::Primitive& primitiveOf(const GltfDocument& document, int mesh, int primitive) {
  return document.model.meshes[static_cast<std::size_t>(mesh)].primitives[static_cast<std::size_t>(primitive)];
}

PrimitiveReader::PrimitiveReader(const GltfDocument& document, int mesh, int primitive)
    : m_document(document), m_source(primitiveOf(document, mesh, primitive)),
      m_place(fmt::format("/meshes/{}/primitives/{}", mesh, primitive)) {
  const auto position = m_source.attributes.find("POSITION");
  if (position == m_source.attributes.end()) throw document.error(m_place + "/attributes", "POSITION is missing");
  m_vertexCount = document.model.accessors[static_cast<std::size_t>(position->second)].count;
  if (const auto found = m_source.extensions.find("KHR_draco_mesh_compression"); found != m_source.extensions.end())
    decodeStream(found->second);
}

void PrimitiveReader::decodeStream(const tinygltf::Value& extension) {
  const std::string place = m_place + "/extensions/KHR_draco_mesh_compression";
  if (m_source.mode != TINYGLTF_MODE_TRIANGLES && m_source.mode != TINYGLTF_MODE_TRIANGLE_STRIP)
    throw m_document.error(m_place + "/mode", "expected TRIANGLES or TRIANGLE_STRIP with KHR_draco_mesh_compression");
  const auto accessorAt = [&](int index) -> const tinygltf::Accessor& {
    return m_document.model.accessors[static_cast<std::size_t>(index)];
  };
  DracoExpectation expected;
  expected.vertices = m_vertexCount;
  if (m_source.indices >= 0) expected.indices = accessorAt(m_source.indices).count;
  expected.exactIndices = m_source.mode == TINYGLTF_MODE_TRIANGLES;
  const tinygltf::Value& attributes = extension.Get("attributes");
  std::vector<std::string> names;
  for (const std::string& name : attributes.Keys()) {
    const auto found = m_source.attributes.find(name);
    if (found == m_source.attributes.end())
      throw m_document.error(place + "/attributes", "names an attribute that the primitive does not have");
    const tinygltf::Accessor& accessor = accessorAt(found->second);
    if (accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 ||
        accessor.type == TINYGLTF_TYPE_MAT4)
      continue; // none that we read
    expected.attributes.push_back({static_cast<std::uint32_t>(attributes.Get(name).GetNumberAsInt()),
                                   accessor.componentType,
                                   tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type))});
    names.push_back(name);
  }
  // What libdraco makes of it, attributes among that which we do not ask for; and what we keep of it until the mesh is
  // built.
  constexpr std::size_t kOtherAttributes = 64; // bytes of a vertex
  std::size_t ofVertex = kOtherAttributes, kept = 0;
  for (const DracoAttribute& each : expected.attributes) {
    const auto size =
        static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(each.componentType)));
    ofVertex += dracoBytesOfVertex(each.componentCount, size);
    kept += static_cast<std::size_t>(each.componentCount) * size;
  }
  const std::size_t indexBytes = expected.indices * sizeof(std::uint32_t);
  expected.maxBytes = m_vertexCount * ofVertex + indexBytes;
  m_charge =
      std::make_unique<MemoryCharge>(m_document.memory, expected.maxBytes + m_vertexCount * kept + indexBytes, place);
  const auto stream = m_document.bufferView(extension.Get("bufferView").GetNumberAsInt());
  try {
    DracoMesh mesh = decodeDraco(stream, expected);
    m_triangles = std::move(mesh.indices);
    for (std::size_t i = 0; i < names.size(); ++i)
      m_decoded.emplace(names[i], AccessorView(m_document, m_source.attributes.at(names[i]), place + "/" + names[i],
                                               std::move(mesh.attributes[i])));
  } catch (const std::invalid_argument& reason) {
    throw m_document.error(place, reason.what());
  }
  m_isDraco = true;
}

std::optional<AccessorView> PrimitiveReader::attribute(const std::string& name,
                                                       std::vector<std::string>& warnings) const {
  const auto found = m_source.attributes.find(name);
  if (found == m_source.attributes.end()) return std::nullopt;
  if (const auto decoded = m_decoded.find(name); decoded != m_decoded.end())
    return checked(decoded->second, name, false, warnings);
  return checked(AccessorView(m_document, found->second, m_place + "/attributes/" + name), name, false, warnings);
}

std::optional<AccessorView> PrimitiveReader::target(std::size_t target, const std::string& name,
                                                    std::vector<std::string>& warnings) const {
  const auto found = m_source.targets[target].find(name);
  if (found == m_source.targets[target].end()) return std::nullopt;
  return checked(AccessorView(m_document, found->second, fmt::format("{}/targets/{}/{}", m_place, target, name)), name,
                 true, warnings);
}

std::optional<AccessorView> PrimitiveReader::checked(std::optional<AccessorView> view, const std::string& name,
                                                     bool isTarget, std::vector<std::string>& warnings) const {
  const Semantic& semantic = semanticOf(name, isTarget);
  if (view->isMatrix()) throw view->error("is a matrix, expected a scalar or vector");
  if (view->componentCount() < semantic.least || view->componentCount() > semantic.most)
    throw view->error(fmt::format("has {} components, expected {}", view->componentCount(), semantic.least));
  if (view->count() != m_vertexCount)
    throw view->error(fmt::format("has {} elements, but POSITION has {}", view->count(), m_vertexCount));
  const Types type = typeOf(*view);
  if (type & semantic.core) return view;
  if (!(type & semantic.quantized))
    throw view->error(fmt::format("has the componentType {}{}, which {} cannot have", view->componentType(),
                                  view->isNormalized() ? " (normalized)" : "", name));
  const std::vector<std::string>& declared = m_document.facts.extensionsUsed;
  if (std::find(declared.begin(), declared.end(), "KHR_mesh_quantization") == declared.end())
    warnings.push_back(fmt::format("{}: its componentType needs KHR_mesh_quantization, which the file does not declare",
                                   view->place()));
  return view;
}

std::vector<std::uint32_t> PrimitiveReader::readTriangles(std::vector<std::string>& warnings) const {
  if (m_isDraco) return m_triangles;
  std::vector<std::uint32_t> indices;
  if (m_source.indices >= 0)
    indices = AccessorView(m_document, m_source.indices, m_place + "/indices").readIndices(m_vertexCount);
  else {
    indices.resize(m_vertexCount);
    std::iota(indices.begin(), indices.end(), 0u);
  }
  if (m_source.mode == TINYGLTF_MODE_TRIANGLE_STRIP) return listFromStrip(indices);
  if (m_source.mode == TINYGLTF_MODE_TRIANGLE_FAN) return listFromFan(indices);
  if (indices.size() % 3) {
    warnings.push_back(
        fmt::format("{}: {} indices do not form whole triangles, the rest is ignored", m_place, indices.size()));
    indices.resize(indices.size() / 3 * 3);
  }
  return indices;
}

} // namespace parity::scenes
