// A picture's parts and the camera's rays through it.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/shaders/interface.h"
#include "scenes/scene.h"

namespace parity::gpu {

// A view of width x height pixels. Large pictures are made in bands of whole rows, each a surface of its own, since a
// storage buffer ends at 128 MiB on many devices.
struct Tile {
  std::uint32_t firstRow = 0, rows = 0;
};
inline constexpr std::uint32_t kMaxTilePixels = 1u << 20;
std::vector<Tile> makeTiles(std::uint32_t width, std::uint32_t height);

// Sample positions of a pixel, count >= 1, in a square of that width in pixels around its middle, which is (0.5, 0.5):
// Hammersley points, each in the middle of its stratum; the middle for one sample.
std::vector<glm::vec2> samplePositions(int count, float width = 1);

// The rays of a camera in a picture of this size, and what the scene says about its light (interface.h, without sh).
GpuView makeView(const scenes::Scene& scene, const scenes::Camera& camera, std::uint32_t width, std::uint32_t height);

// World to clip space (Vulkan: depth 0..1; +Y up in clip space, for a viewport of negative height).
glm::mat4 makeWorldToClip(const scenes::Camera& camera, float aspect);

} // namespace parity::gpu
