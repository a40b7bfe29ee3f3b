// A binary glTF file while it is put together. Private to scenes/gltf/export_*.cpp.
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include "base/error.h"

namespace parity::scenes {

struct GlbDraft {
  std::string label;                // the scene, for messages
  tinygltf::Model model;            // without its one buffer ...
  std::vector<std::byte> binary;    // ... which is this
  std::set<std::string> extensions; // that it uses

  base::Error error(const std::string& place, const std::string& reason) const {
    return base::fileError(label, place, reason);
  }

  // Adds bytes to the buffer, and a view of them, which starts at a multiple of 4; target: glTF's number, 0: none.
  // Returns the view's index. Throws Error (exit 4) where the file would be too long for its length fields.
  int addView(std::span<const std::byte> bytes, int target);

  // Adds a root node to the one scene.
  void addNode(tinygltf::Node node);
};

// The bytes of the file. Throws Error (exit 4): more than the 4 GiB of a .glb.
std::vector<std::byte> packGlb(GlbDraft& draft);

// {"a": ..., "b": ...} and [1, 2] of an extension.
inline tinygltf::Value gltfObject(tinygltf::Value::Object members = {}) { return tinygltf::Value(std::move(members)); }
tinygltf::Value gltfArray(std::span<const double> numbers);

// A node's matrix, columns first; empty for the identity, which is the default.
std::vector<double> gltfMatrix(const glm::dmat4& matrix);

} // namespace parity::scenes
