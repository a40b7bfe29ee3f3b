// Textures of a glTF file: slots with sampler, uv set and uv transform.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf/file/document.h"
#include "scenes/scene.h"

namespace parity::scenes {

// A texture reference of a material. `image` of the result counts in document.images, `texCoord` in the file's uv sets.
// Throws Error (exit 4): an unknown filter or wrap mode, a texture without an image that we can read.
TextureSlot readTextureSlot(const GltfDocument& document, int texture, int texCoord,
                            const tinygltf::ExtensionMap& extensions, const std::string& place);

// The same for a textureInfo within an extension, which the parser leaves as a generic value.
TextureSlot readTextureSlot(const GltfDocument& document, const tinygltf::Value& info, const std::string& place);

// uv' = offset + R * (scale * uv) as KHR_texture_transform means it: R turns the image clockwise by `rotation`
// (radians, v down), that is (u, v) -> (cos u + sin v, cos v - sin u). The GLSL in the extension's text has the other
// sign; the Khronos asset TextureTransformTest and every viewer settle it. Row-major 2x3.
std::array<float, 6> uvTransform(glm::dvec2 offset, double rotation, glm::dvec2 scale);

// What KHR_texture_transform says: uvTransform() makes the matrix of it again.
struct UvTransformParts {
  glm::dvec2 offset{0.0}, scale{1.0};
  double rotation = 0; // radians
};
// Nothing for a matrix that is not one of a rotation after a scale: its columns are not at right angles.
std::optional<UvTransformParts> splitUvTransform(const std::array<float, 6>& uvTransform);

} // namespace parity::scenes
