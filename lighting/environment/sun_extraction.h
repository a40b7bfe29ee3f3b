// Bright compact sources of a panorama, the sun above all, taken out of it as directional lights.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::lighting {

// Each one costs shading time in every pixel of the high-end path (docs/environments.md).
inline constexpr int kMaxExtractedSuns = 8;

struct ExtractedSun {
  // Directional; named "sun 1 of <environment>" and so on. Its colour is the illuminance (lux, linear Rec.709) of what
  // was taken out on a surface that faces it, its direction their centroid weighted by luminance; world space: the
  // environment's rotation is applied.
  scenes::Light light;

  struct Cell {
    std::uint32_t index;           // y * width + x
    glm::vec3 radiance, remainder; // before, and what is left
  };
  std::vector<Cell> cells; // no cell belongs to two suns
};

struct SunExtraction {
  scenes::Environment environment; // without them
  std::vector<ExtractedSun> suns;  // the brightest first (by luminance), kMaxExtractedSuns at most
};

// What counts as a source, in terms of the map's mean luminance M over solid angle: cells that hang together (by edge
// or corner, around the seam) above a level of at least 10 M, all within 3 degrees of their centre, with a peak of at
// least 8 times that level; of the levels 10 M, 20 M, 40 M.. the lowest that so holds. And it gives at least 1/50 of
// all the light of the map. So a softbox, a window or a white sky is no source, whatever its radiance, nor is a glint.
// The source and a cell's width around it (which may share its edge) are filled with what is around, and where that is
// darker than before the difference becomes the light: the sum of radiance times solid angle and light is kept, per
// channel. Deterministic. Values above 1e30 count as 1e30; a map that is no radiance (not finite, negative, not of 3
// channels) is left as it is.
SunExtraction extractSuns(scenes::Environment environment);

// The environment with its sources but `without` (an index into suns) back in place; none: all of them.
scenes::Environment putBackSuns(const SunExtraction& extraction, std::optional<std::size_t> without);

} // namespace parity::lighting
