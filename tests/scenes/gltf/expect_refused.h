// Files that are to be refused.
#pragma once

#include <string>
#include <vector>

#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"

namespace parity::tests {

// The load is to fail with a line that holds `parts`.
inline void expectRefused(const GltfFile& file, const std::vector<std::string>& parts) {
  const TempFolder folder;
  expectError([&] { scenes::loadScene(writeGlb(folder, file)); }, parts);
}

} // namespace parity::tests
