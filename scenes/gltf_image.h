// Images of a glTF file.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scenes/gltf_document.h"
#include "scenes/scene.h"

namespace parity::scenes {

// Most texels that the images of one scene may have together: 1 GiB of RGBA.
inline constexpr std::size_t kMaxTexels = std::size_t{1} << 28;

// Width and height by the header of a PNG or JPEG file, before memory is taken. {0, 0}: neither format.
struct ImageSize {
  std::size_t width = 0, height = 0;
};
ImageSize sniffImageSize(std::span<const std::byte> bytes);

struct DecodedImages {
  std::vector<TextureImage> images;
  std::vector<SourceFile> sources; // of those that have a file of their own
};

// Decodes those images that `used` lists (indices into document.images), at the same time. Throws Error (exit 4): not
// there, neither PNG nor JPEG, too large, truncated, not decodable.
DecodedImages decodeImages(const GltfDocument& document, const std::vector<int>& used);

} // namespace parity::scenes
