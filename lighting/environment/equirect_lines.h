// The inner loops of resampling a panorama: along a meridian, texels of a cube's face and cells of a panorama.
#pragma once

#include <span>

#include <glm/glm.hpp>

namespace parity::lighting {

// The weighted sum of what falls into a cube texel.
struct Gathered {
  glm::dvec3 sum{0.0};
  double weight = 0;
  glm::vec4 mean() const { return {glm::vec3(sum / weight), 1.f}; }
};

// A column of a panorama from one pole to the other.
struct CellLine {
  const glm::vec3* first;
  int step; // to the next cell: 1 or -1
};

// At most this many lines are read side by side: two panoramas, from both poles.
inline constexpr int kMaxCellLines = 4;

// Buffers that vectors write to have room for this many doubles more.
inline constexpr int kLinePadding = 8;

// What all lines have in common.
struct LineShape {
  std::span<const double> rowY;  // bounds of the cells, cos(theta): 1 .. -1
  std::span<const double> steps; // of texels, and kLinePadding more
  std::span<double> borders;     // for own use: twice the texels, and twice kLinePadding more
  int texels;
};

// Of a column of a side face, along a meridian at azimuth a from its middle: cosine = cos(a), weight: of a unit of
// height. steps[i]: t of the border below texel i. gathered: of texel after texel those of all lines.
void gatherMeridian(const LineShape& shape, double cosine, double weight, std::span<const CellLine> lines,
                    Gathered* gathered);

// Of a quarter of a polar face, along the ray of an azimuth. stepX, stepZ: tan(theta) from one border to the next along
// each side. steps[i]: i + 1. gathered: row after row of texels, of each those of all lines.
void gatherRay(const LineShape& shape, double stepX, double stepZ, double weight, std::span<const CellLine> lines,
               Gathered* gathered);

} // namespace parity::lighting
