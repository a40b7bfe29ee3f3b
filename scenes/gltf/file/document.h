// A glTF file as read: its JSON as a checked tinygltf model, its buffers read on first use, its images not yet decoded.
// Private to scenes/gltf_*.cpp and scenes/gltf/load_gltf.cpp.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "base/error.h"
#include "scenes/gltf/file/buffers.h"
#include "scenes/gltf/file/memory_budget.h"
#include "scenes/load_options.h"
#include "scenes/problems.h"
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

struct GltfDocument {
  GltfDocument(std::string file, const LoadOptions& loadOptions)
      : label(std::move(file)), options(loadOptions), memory(label, loadOptions.maxMemoryBytes) {}

  std::string label; // the file as the user wrote it, for messages
  LoadOptions options;
  mutable MemoryBudget memory;
  tinygltf::Model model;        // without buffers and images
  std::vector<std::byte> bytes; // of the file, as long as something looks at them
  std::unique_ptr<GltfBuffers> buffers;
  std::vector<GltfImageSource> images;
  std::vector<int> firstOfImage; // the first image with the same file or buffer view: each is decoded once
  SourceFile source;
  SourceFacts facts;
  std::vector<std::string> warnings;

  // An error of this file (exit 4); place: "/accessors/3".
  base::Error error(const std::string& place, const std::string& reason) const {
    return base::fileError(label, place, reason);
  }
  // The bytes of a buffer view, whose index and range have been checked. Throws Error (exit 4): GltfBuffers::view.
  std::span<const std::byte> bufferView(int index) const { return buffers->view(index); }
};

// Reads .gltf or .glb, told apart by content. Checks the JSON's types, indices, ranges, the forest of nodes, uris, and
// extensions (scenes/gltf/file/json.h, gltf_structure.h). tinygltf is given neither buffers nor images: it opens no
// file. Throws Error or ErrorList (exit 4).
std::unique_ptr<GltfDocument> readGltfDocument(const std::string& file, const LoadOptions& options);

} // namespace parity::scenes
