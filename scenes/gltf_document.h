// A glTF file as read: its JSON as a checked tinygltf model, its buffers as bytes, its images not yet decoded.
// Private to scenes/gltf_*.cpp and scenes/load.cpp.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "base/error.h"
#include "base/hash.h"
#include "scenes/scene.h"

namespace parity::scenes {

// Where an image's file lies: one of the three.
struct GltfImageSource {
  std::string name;
  std::filesystem::path file;      // an external file, within the asset's folder
  std::filesystem::path named;     // the same, links not resolved
  int bufferView = -1;             // part of a buffer
  std::vector<std::byte> embedded; // a data uri
};

inline SourceFile sourceFile(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  return {file, base::Hasher().add(bytes).hex()};
}

struct GltfDocument {
  std::string label;                               // the file as the user wrote it, for messages
  tinygltf::Model model;                           // without buffers and images
  std::vector<std::vector<std::byte>> storage;     // what the spans of `buffers` look at
  std::vector<std::span<const std::byte>> buffers; // each of exactly its byteLength
  std::vector<GltfImageSource> images;
  std::vector<SourceFile> sources; // the file and its buffers
  std::vector<std::string> warnings;

  // An error of this file (exit 4); place: "accessors[3]".
  base::Error error(const std::string& place, const std::string& reason) const {
    return base::fileError(label, place, reason);
  }
  // The bytes of a buffer view, whose index and range have been checked.
  std::span<const std::byte> bufferView(int index) const;
};

// Reads .gltf or .glb, told apart by content. Checks the JSON's types, all indices, uris, buffer and buffer view
// ranges, and extensions. tinygltf is given neither buffers nor images: it opens no file. Throws Error (exit 4).
GltfDocument readGltfDocument(const std::string& file);

} // namespace parity::scenes
