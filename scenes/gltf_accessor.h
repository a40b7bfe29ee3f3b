// Typed, checked reading of accessors: whatever the component type, out come floats or 32-bit indices.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/gltf_document.h"

namespace parity::scenes {

// An accessor whose type, range, alignment and stride have been checked against its buffer view.
class AccessorView {
public:
  // place: who asks, for messages: "meshes[0].primitives[0].attributes.POSITION". Throws Error (exit 4) naming the
  // accessor: sparse, no data, out of range, misaligned, a component type that attributes and indices cannot have.
  AccessorView(const GltfDocument& document, int accessor, std::string place);

  std::size_t count() const { return m_count; }
  int componentCount() const { return m_componentCount; }
  bool isFloat() const;
  bool isNormalized() const { return m_normalized; }
  // The place and the accessor, for messages.
  const std::string& place() const { return m_place; }

  // One component as a float: floats as they are, integers as glTF 2.0 (3.6.2.2) decodes them: normalised ones to
  // [0,1] or [-1,1] by max(c / maximum, -1), others by value.
  float at(std::size_t element, int component) const;

  // All elements. Components beyond componentCount() are `fill`. Throws Error where a value is not finite.
  std::vector<glm::vec2> readVec2() const;
  std::vector<glm::vec3> readVec3() const;
  std::vector<glm::vec4> readVec4(float fill) const;
  // The same without the check, for attributes that are mended where they are not finite.
  std::vector<glm::vec3> readVec3Unchecked() const;
  std::vector<glm::vec4> readVec4Unchecked() const;
  // A scalar of unsigned integers. Throws Error where a value is not below `limit` (the number of vertices).
  std::vector<std::uint32_t> readIndices(std::size_t limit) const;

private:
  template <typename Vec> std::vector<Vec> readVectors(float fill, bool finite) const;

  const GltfDocument* m_document;
  std::string m_place;
  std::span<const std::byte> m_bytes;
  std::size_t m_count = 0, m_stride = 0, m_componentBytes = 0;
  int m_componentType = 0, m_componentCount = 0;
  bool m_normalized = false;
};

} // namespace parity::scenes
