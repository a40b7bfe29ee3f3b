// KHR_draco_mesh_compression: the arrays of a compressed primitive, by libdraco.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace parity::scenes {

// An attribute as the primitive's accessor declares it. componentType: glTF's (5120 ... 5126).
struct DracoAttribute {
  std::uint32_t id = 0; // the stream's unique id
  int componentType = 0;
  int componentCount = 0; // 1 to 4
};

// What the accessors say is in the stream; memory is taken for no more than that.
struct DracoExpectation {
  std::size_t vertices = 0;
  std::size_t indices = 0;  // 0: the primitive has no accessor for indices, any number
  bool exactIndices = true; // false: at most that many (a strip's, which the stream stores as a list)
  std::size_t maxBytes = 0; // for all that libdraco decodes; without an accessor for indices, for the triangles alone
  std::vector<DracoAttribute> attributes;
};

struct DracoMesh {
  std::vector<std::uint32_t> indices;             // of triangles, all below the number of vertices
  std::vector<std::vector<std::byte>> attributes; // as asked for, tightly packed: vertices x components
};

// What libdraco holds of an attribute for each vertex: its values, their quantised form, the map to them.
constexpr std::size_t dracoBytesOfVertex(int componentCount, std::size_t componentBytes) {
  return static_cast<std::size_t>(componentCount) * (componentBytes + 4) + 8;
}

// Decodes a stream (bitstream 2.2, as the extension asks for). Throws std::invalid_argument with the reason: not a
// triangle mesh, damaged, other counts, component counts or ids than expected, too much memory.
DracoMesh decodeDraco(std::span<const std::byte> compressed, const DracoExpectation& expected);

} // namespace parity::scenes
