// Images of a glTF file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/gltf/file/document.h"
#include "scenes/scene.h"

namespace parity::scenes {

struct DecodedImages {
  std::vector<TextureImage> images;  // those that could not be read are empty
  std::vector<SourceFile> sources;   // of those that have a file of their own
  std::vector<std::string> warnings; // of damaged JPEGs, parts of which are made up
};

// Decodes those images that `used` lists (indices into document.images), at the same time, each file once. Each that
// is not there, neither PNG, JPEG nor WebP, too large (LoadOptions), truncated or not decodable goes to `problems`.
DecodedImages decodeImages(const GltfDocument& document, const std::vector<int>& used, Problems& problems);

} // namespace parity::scenes
