// The buffers of a glTF file, read on first use.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "scenes/gltf/file/memory_budget.h"
#include "scenes/scene.h"

namespace parity::scenes {

inline SourceFile sourceFile(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  return {file, base::Hasher().add(bytes).hex()};
}

// Where uris lead. label: the file as the user wrote it, for messages; folder: its folder, canonical.
struct GltfPlace {
  std::string label;
  std::filesystem::path folder;
};

// A uri's file, links not followed in `named`, and its place in messages. Throws Error (exit 4) at `place` for what
// resolveUri refuses.
struct GltfFileUri {
  std::filesystem::path file, named;
};
GltfFileUri resolveFileUri(const GltfPlace& where, const std::string& uri, const std::string& place);
// Throws Error (exit 4) at `place`.
std::vector<std::byte> decodeDataUriAt(const GltfPlace& where, const std::string& uri, const std::string& place);

class GltfBuffers {
public:
  // The document's types and ranges have been checked; it and `binary`, the container's chunk, must outlive this. What
  // is read is charged to the budget. Throws Error (exit 4) for a uri that may not be read.
  GltfBuffers(const nlohmann::json& document, const GltfPlace& where, std::span<const std::byte> binary, bool hasBinary,
              MemoryBudget& budget);
  ~GltfBuffers();

  // The bytes of a buffer view, those of EXT_meshopt_compression decoded on first use; any thread may ask. Throws Error
  // (exit 4) where its buffer cannot be read or is too short, or the stream is damaged.
  std::span<const std::byte> view(int index) const;

  // The files read so far, in the order of the buffers.
  std::vector<SourceFile> sources() const;

private:
  struct Buffer;
  struct View;
  std::span<const std::byte> buffer(std::size_t index) const;
  void read(Buffer& buffer, const std::string& place) const;
  void decode(std::size_t view) const;

  GltfPlace m_where;
  std::span<const std::byte> m_binary;
  bool m_hasBinary;
  MemoryBudget& m_budget;
  std::vector<std::unique_ptr<Buffer>> m_buffers; // their flags cannot be moved
  std::vector<std::unique_ptr<View>> m_views;
};

} // namespace parity::scenes
