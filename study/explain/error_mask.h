// Where on a texture of a material its error lies.
#pragma once

#include <span>
#include <string>

#include <glm/vec2.hpp>

#include "base/image/image.h"
#include "scenes/scene.h"

namespace parity::explain {

inline constexpr int kMaskSide = 32; // pixels of the longer side of a mask

// The texture that the mask lies over, and the card's name of what it gives: that of roughness, else of base colour,
// else of normals. The slot is null where the material has none of them.
struct MaskedTexture {
  const char* input = "";
  const scenes::TextureSlot* slot = nullptr;
};
MaskedTexture maskedTexture(const scenes::Material& material);

struct TexelMask {
  base::Image8 picture; // RGBA: opaque where the texels with most error are that together hold half of it
  double texels = 0;    // their share of those that some pixel shows
};

// places: texture coordinates of each pixel. errors: of each pixel, times how much of it shows the material; not
// negative. wraps: how the texture goes on beyond [0, 1]. width, height: of the texture. Of no error nothing is opaque.
TexelMask maskOf(std::span<const glm::vec2> places, std::span<const float> errors, const scenes::Sampler& wraps,
                 int width, int height);

} // namespace parity::explain
