// EXT_meshopt_compression: the bytes of a compressed buffer view, by meshoptimizer.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace parity::scenes {

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

// "ATTRIBUTES" and so on, "NONE" and so on. Throws std::invalid_argument with the reason for another name.
MeshoptMode meshoptModeOf(std::string_view name);
MeshoptFilter meshoptFilterOf(std::string_view name);

// How a buffer view is compressed: count elements of byteStride bytes each.
struct MeshoptLayout {
  std::size_t count = 0, byteStride = 0;
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;
};

// The reasons why no stream of `compressedBytes` bytes can hold this layout, before any memory is taken: strides and
// counts that the extension forbids, or more data than the densest stream decodes to. Throws std::invalid_argument.
void checkMeshoptLayout(const MeshoptLayout& layout, std::size_t compressedBytes);

// The count * byteStride bytes; checks the layout too. Values are as the stream says: indices may be out of range.
// Throws std::invalid_argument with the reason.
std::vector<std::byte> decodeMeshopt(std::span<const std::byte> compressed, const MeshoptLayout& layout);

} // namespace parity::scenes
