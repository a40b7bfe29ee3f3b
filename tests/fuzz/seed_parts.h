// What the seeds are made of.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/gltf/gltf_writer.h"

namespace parity::tests {

using Bytes = std::vector<std::byte>;

inline Bytes toBytes(const void* data, std::size_t size) {
  const auto* begin = static_cast<const std::byte*>(data);
  return {begin, begin + size};
}

template <typename T> Bytes toBytes(const std::vector<T>& values) {
  return toBytes(values.data(), values.size() * sizeof(T));
}

inline void use(GltfFile& file, std::vector<std::string> extensions, bool required = false) {
  file.json["extensionsUsed"] = extensions;
  if (required) file.json["extensionsRequired"] = extensions;
}

// The quad with an image as its base colour (gltf_seeds.cpp).
GltfFile makeTextured(const Bytes& image, const char* type);

// Geometry in every storage (gltf_geometry_seeds.cpp).
GltfFile makeInterleaved();
GltfFile makeQuantized();
GltfFile makeSparse();
GltfFile makeMorphed();
GltfFile makeSkinned();
GltfFile makeInstanced();
GltfFile makeDraco(bool edgebreaker);
GltfFile makeMeshopt(const char* filter);

} // namespace parity::tests
