// The panorama's own cells, for reflections sharper than any texel of the prefiltered cube.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::lighting {

// What a mirror sees: cells of constant radiance, RGBA with A = 1, linear Rec.709, as they lie in the file. mips[0] has
// width x height of them, row by row, the top first: at least 1024 x 512, a coarser panorama interpolated bilinearly as
// the reference does it. Each further mip halves both sides, rounded down, by exact areas.
struct PanoramaCells {
  int width = 0, height = 0;
  std::vector<std::vector<glm::vec4>> mips;
  float turns = 0; // azimuth in the panorama less that in the world, of a whole turn
};

// A larger panorama is halved until it is no larger: a device holds this one with its mips in 180 MiB.
inline constexpr int kMaxPanoramaWidth = 4096, kMaxPanoramaHeight = 2048;

// Sides of a mip.
int widthOf(const PanoramaCells& cells, int mip);
int heightOf(const PanoramaCells& cells, int mip);

// As many mips as the widest core of sharpLobe (shading/mips.glsl) asks for. Values above 1e30 are taken as 1e30.
// Throws base::Error (exit 4) as resampleEquirect does.
PanoramaCells makePanoramaCells(const scenes::Environment& environment);

// The mean over a box of `boxWidth` radians along each axis around a direction (world, any length but 0): of the mip
// whose cells are just as high or higher, so that at most four share in it, by exact overlaps. Next to the poles, where
// cells are narrow, at most a cell's width along the row. 0: the cell itself. As highend/shaders/sky.glsl reads.
glm::vec3 readCells(const PanoramaCells& cells, const glm::dvec3& direction, double boxWidth);

} // namespace parity::lighting
