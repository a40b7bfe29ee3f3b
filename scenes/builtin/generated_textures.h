// Small textures made by formula for the built-in scenes. All repeat seamlessly.
#pragma once

#include <functional>
#include <string>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::scenes {

// size x size texels of RGBA in [0,1] at the texel centres, stored as value * 255 rounded. u to the right, v down.
TextureImage makeTexture(std::string name, int size, const std::function<glm::vec4(float u, float v)>& at);

// A tangent-space normal map (+Y up) of a height field that repeats over [0,1]^2; `height` in units of the uv square.
TextureImage makeNormalMap(std::string name, int size, const std::function<float(float u, float v)>& height);

// Smooth noise in [0,1] that repeats after `period` lattice cells in x and y (value noise, quintic fade, PCG hash of
// Jarzynski and Olano 2020).
float periodicNoise(float x, float y, int periodX, int periodY, std::uint32_t seed);

// Checkerboard of cells x cells squares; colours sRGB-encoded.
TextureImage makeChecker(std::string name, int cells, const glm::vec3& even, const glm::vec3& odd);

// Scratches along u, as brushing leaves them: normals, and in the same pattern roughness (G) with metallic 1 (B).
TextureImage makeBrushedNormals(std::string name);
TextureImage makeBrushedRoughness(std::string name);

// Plain weave: threads over and under each other; normals and colour (sRGB).
TextureImage makeWovenNormals(std::string name, int threads);
TextureImage makeWovenColor(std::string name, int threads, const glm::vec3& warp, const glm::vec3& weft);

// White, with round holes in alpha: cells x cells of them.
TextureImage makeHoles(std::string name, int cells);

// Green leaves, cells x cells of them, each turned its own way; alpha is 0 between them.
TextureImage makeLeaves(std::string name, int cells);

} // namespace parity::scenes
