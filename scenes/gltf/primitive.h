// The attributes and indices of one primitive, wherever they are stored: accessors, or a Draco stream.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf/file/accessor.h"
#include "scenes/gltf/file/memory_budget.h"

namespace parity::scenes {

const tinygltf::Primitive& primitiveOf(const GltfDocument& document, int mesh, int primitive);

class PrimitiveReader {
public:
  // Decodes the Draco stream if the primitive has one: it is preferred to what the accessors hold themselves. Throws
  // Error (exit 4) with the place, "/meshes/0/primitives/1/...".
  PrimitiveReader(const GltfDocument& document, int mesh, int primitive);

  const GltfDocument& document() const { return m_document; }
  const tinygltf::Primitive& source() const { return m_source; }
  const std::string& place() const { return m_place; }
  bool isDraco() const { return m_isDraco; }
  std::size_t vertexCount() const { return m_vertexCount; }

  // An attribute; nothing where there is none. Its type must be one that glTF 2.0 (3.7.2.1) or KHR_mesh_quantization
  // allows for the name, its count that of POSITION. A type that only the extension allows, in a file that does not
  // declare it, is a warning: exporters do so, and the meaning is plain. Throws Error (exit 4).
  std::optional<AccessorView> attribute(const std::string& name, std::vector<std::string>& warnings) const;
  // The same for the displacements of a morph target.
  std::optional<AccessorView> target(std::size_t target, const std::string& name,
                                     std::vector<std::string>& warnings) const;

  // The triangle list, whatever the mode. An incomplete last triangle is dropped with a warning. Throws Error (exit 4).
  std::vector<std::uint32_t> readTriangles(std::vector<std::string>& warnings) const;

private:
  void decodeStream(const tinygltf::Value& extension);
  std::optional<AccessorView> checked(std::optional<AccessorView> view, const std::string& name, bool isTarget,
                                      std::vector<std::string>& warnings) const;

  const GltfDocument& m_document;
  const tinygltf::Primitive& m_source;
  std::string m_place;
  std::size_t m_vertexCount = 0;
  bool m_isDraco = false;
  std::map<std::string, AccessorView> m_decoded; // attributes of the stream
  std::vector<std::uint32_t> m_triangles;        // of the stream
  std::unique_ptr<MemoryCharge> m_charge;        // of what is decoded
};

} // namespace parity::scenes
