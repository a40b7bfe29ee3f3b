// Typed, checked reading of accessors: whatever the component type, out come floats or integers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/gltf/file/document.h"

namespace parity::scenes {

// An accessor whose type and ranges have been checked (gltf_structure.h). Sparse ones, and those without a buffer view
// (all zeros), are put together here; that memory is charged to the document's budget while the view lives.
class AccessorView {
public:
  // place: who asks, for messages: "/meshes/0/primitives/0/attributes/POSITION". Throws Error (exit 4) naming the
  // accessor: its buffer cannot be read, the indices of a sparse one do not increase or leave it.
  AccessorView(const GltfDocument& document, int accessor, std::string place);
  // The accessor with data from elsewhere (a Draco stream): its elements, tightly packed.
  AccessorView(const GltfDocument& document, int accessor, std::string place, std::vector<std::byte> packed);

  std::size_t count() const { return m_count; }
  int componentCount() const { return m_componentCount; }
  int componentType() const { return m_componentType; } // glTF's: 5126 is FLOAT
  bool isMatrix() const { return m_isMatrix; }
  bool isFloat() const { return m_componentType == 5126; }
  bool isNormalized() const { return m_normalized; }
  // The place and the accessor, for messages.
  const std::string& place() const { return m_place; }
  base::Error error(const std::string& reason) const { return m_document->error(m_place, reason); }

  // All elements as floats: floats as they are, integers as glTF 2.0 (3.6.2.2) decodes them: normalised ones to [0,1]
  // or [-1,1] by max(c / maximum, -1), others by value. Components beyond componentCount() are `fill`. Throws Error
  // where a value is not finite, or the accessor is of matrices.
  std::vector<glm::vec2> readVec2() const;
  std::vector<glm::vec3> readVec3() const;
  std::vector<glm::vec4> readVec4(float fill) const;
  // The same without the check, for attributes that are mended where they are not finite.
  std::vector<glm::vec3> readVec3Unchecked() const;
  std::vector<glm::vec4> readVec4Unchecked() const;
  // Of SCALAR: count() numbers. Throws Error where one is not finite.
  std::vector<float> readScalars() const;
  // Of MAT4 of floats, columns first. Throws Error for another type, and where a number is not finite.
  std::vector<glm::mat4> readMat4() const;
  // Of VEC4 of unsigned integers of 8 or 16 bits. Throws Error for another type.
  std::vector<glm::u16vec4> readJoints() const;
  // A scalar of unsigned integers. Throws Error where a value is not below `limit` (the number of vertices) or is the
  // largest of its type, which graphics interfaces take for a restart and glTF (3.7.2.1) forbids.
  std::vector<std::uint32_t> readIndices(std::size_t limit) const;

private:
  struct Owned;
  void describe(int accessor);
  void assemble(int accessor);
  void applySparse(const tinygltf::Accessor& source, std::vector<std::byte>& packed) const;
  void own(std::shared_ptr<const Owned> owned);
  template <typename Vec> std::vector<Vec> readVectors(float fill, bool finite) const;

  const GltfDocument* m_document;
  std::string m_place;
  std::shared_ptr<const Owned> m_owned; // what m_bytes looks at, where that is not a buffer view
  std::span<const std::byte> m_bytes;
  std::size_t m_count = 0, m_stride = 0, m_elementBytes = 0;
  int m_componentType = 0, m_componentCount = 0;
  bool m_normalized = false, m_isMatrix = false;
};

} // namespace parity::scenes
